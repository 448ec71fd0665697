// Where a cell lies in the folder of a sweep, who has it, and how it failed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/child_process.hpp"
#include "tools/sweep/sweep.hpp"

namespace gnbv {

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
