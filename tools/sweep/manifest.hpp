// What a sweep's folder is the folder of: DIR/sweep.json.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/sweep/run_cells.hpp"
#include "tools/sweep/sweep.hpp"

namespace gnbv {

/// Writes DIR/sweep.json, by rename: version and flying_source_id(), the sweep file's path and
/// text, and the cells.
void write_manifest(const std::filesystem::path& folder, const std::filesystem::path& yaml,
                    std::span<const Cell> cells);

/// Of which sweep a folder is.
struct Manifest {
  std::string file = {};         // absolute path of the sweep file
  std::vector<Cell> cells = {};  // by index; their scenarios are not resolved
};

/// Nothing when there is none; throws BadInput naming one that is no manifest, or damaged.
std::optional<Manifest> read_manifest(const std::filesystem::path& folder);

/// The cells of a folder that has to be one of a sweep: throws BadInput when it is none.
std::vector<Cell> cells_of_manifest(const std::filesystem::path& folder);

/// Throws BadInput naming both files when the folder is that of another sweep file.
void require_folder_of(const std::filesystem::path& folder, const std::filesystem::path& yaml);

/// One row a cell: what it is, its status, and the key figures of those that are done.
std::string results_csv(std::span<const Cell> cells, std::span<const CellOutcome> outcomes);

/// The cells as a JSON list, each with its status, run directory or failure.
std::string cells_json(std::span<const Cell> cells, std::span<const CellOutcome> outcomes);

}  // namespace gnbv
