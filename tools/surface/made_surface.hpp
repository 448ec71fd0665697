// The surface of a run and its score, written.
#pragma once

#include <filesystem>

#include "tools/surface/surface.hpp"
#include "tools/surface/surface_score.hpp"

namespace gnbv {

struct MadeSurface {
  std::vector<std::filesystem::path> files;
  std::optional<SurfaceScore> score;  // none where the true structure cannot be loaded
  std::vector<std::string> notes;
};

/// Reconstructs, scores and writes into the folder, which is made if need be. Throws BadInput as
/// reconstruct_surface(), for a folder that cannot be written to before any work, and without a
/// score when that is needed.
MadeSurface make_surface(const RunRecord& record, const SurfaceSettings& settings,
                         const std::filesystem::path& folder, bool needs_score, int threads,
                         const SurfaceProgress& progress);

}  // namespace gnbv
