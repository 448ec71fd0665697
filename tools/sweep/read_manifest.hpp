// The cells of a folder that a sweep was flown in.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/sweep/sweep.hpp"

namespace gnbv {

/// From DIR/sweep.json, in its order; their scenarios are not resolved. Throws BadInput naming the
/// file for a folder that is none of a sweep, or whose manifest is damaged.
std::vector<Cell> cells_of_manifest(const std::filesystem::path& folder);

}  // namespace gnbv
