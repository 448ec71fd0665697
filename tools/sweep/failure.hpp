// A cell whose mission ended without a result, on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/child_process.hpp"
#include "tools/sweep/cell_files.hpp"
#include "tools/sweep/run_cells.hpp"

namespace gnbv {

/// Writes ID.failed.json: how the process ended, the last lines it printed after the first
/// `log_begin` bytes of its log, the command, the host.
CellOutcome record_failure(const Cell& cell, const CellFiles& files, const ChildEnd& end,
                           const std::vector<std::string>& command, std::uintmax_t log_begin);

/// The failure in one line, from ID.failed.json; nothing without such a file, which whoever runs
/// the cell again removes at any time.
std::optional<std::string> failure_of(const std::filesystem::path& failed);

}  // namespace gnbv
