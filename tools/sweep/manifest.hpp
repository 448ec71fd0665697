// What a sweep's folder is the folder of: DIR/sweep.json.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "tools/sweep/run_cells.hpp"
#include "tools/sweep/sweep.hpp"

namespace gnbv {

/// Writes DIR/sweep.json, by rename: version and source_id(), the sweep file's path and text, and
/// the cells.
void write_manifest(const std::filesystem::path& folder, const std::filesystem::path& yaml,
                    std::span<const Cell> cells);

/// The id of the cell there, with this index; nothing when there is no manifest or no such cell.
std::optional<std::string> manifest_id(const std::filesystem::path& folder, std::size_t index);

/// One row a cell: what it is, its status, and the key figures of those that are done.
std::string results_csv(std::span<const Cell> cells, std::span<const CellOutcome> outcomes);

/// The cells as a JSON list, each with its status, run directory or failure.
std::string cells_json(std::span<const Cell> cells, std::span<const CellOutcome> outcomes);

std::string_view name_of(CellStatus status);

}  // namespace gnbv
