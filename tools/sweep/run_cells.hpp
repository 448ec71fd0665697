// Runs the cells of a sweep that are not done yet, each in a process of its own.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/child_process.hpp"
#include "tools/sweep/sweep.hpp"

namespace gnbv {

enum class CellStatus { done, failed, locked, missing };
constexpr std::array<std::string_view, 4> kCellStatusNames = {"done", "failed", "running",
                                                              "missing"};

struct CellOutcome {
  CellStatus status = CellStatus::missing;
  std::filesystem::path run;  // the run directory, when done
  std::string failure;        // one line, when failed
};

struct RunCellsOptions {
  std::filesystem::path folder{};  // of the sweep; FOLDER/cells/ID/ are the run directories
  int jobs = 1;                    // processes at a time
  int threads = 0;                 // of each; 0 shares the machine's among the jobs
  bool retry_failed = false;       // failed cells are run again
  bool wait_for_locked = true;     // cells that another process runs: wait for them, or leave them
  bool quiet = false;
  std::filesystem::path program{};           // that flies them; empty: this one
  std::vector<std::string> run_arguments{};  // of `gnbv run` beside its own, such as --frames
  std::function<void(std::size_t cell, const CellOutcome&)> on_done{};  // as soon as it is done
};

/// What is known of the cell on disk.
CellOutcome look_up(const std::filesystem::path& folder, const Cell& cell);

/// Runs what is missing and returns an outcome a cell, in their order. A cell's run directory
/// appears by rename when it is complete; one that fails is recorded beside it and does not stop
/// the others. Ctrl-C ends the missions at hand, which a later call resumes; then the outcomes hold
/// `missing` ones. A mission that ends in a collision is done: that is a result.
std::vector<CellOutcome> run_cells(std::span<const Cell> cells, const RunCellsOptions& options);

// ---- cell_files.cpp: where a cell lies in the folder of a sweep, who has it, and how it failed

constexpr const char* kCellsFolder = "cells";  // of a sweep's folder

struct CellFiles {
  std::filesystem::path run;     // the run directory; there as soon as, and only when, it is done
  std::filesystem::path part;    // the run directory of a mission that is not done
  std::filesystem::path log;     // what the mission printed
  std::filesystem::path lock;    // held while it is flown
  std::filesystem::path failed;  // how it ended, when it failed
};

CellFiles cell_files(const std::filesystem::path& folder, const std::string& id);

/// The mission's termination as its summary.json has it; nothing when there is none.
std::optional<std::string> termination_of(const std::filesystem::path& run);

/// Writes ID.failed.json: how the process ended, the last lines it printed after the first
/// `log_begin` bytes of its log, the command, the host.
std::string record_failure(const Cell& cell, const CellFiles& files, const ChildEnd& end,
                           const std::vector<std::string>& command, std::uintmax_t log_begin);

/// The failure in one line, from ID.failed.json; nothing without such a file, which whoever runs
/// the cell again removes at any time.
std::optional<std::string> failure_of(const std::filesystem::path& failed);

}  // namespace gnbv
