// Which pictures show a face of a surface, and how well.
#pragma once

#include <vector>

#include "tools/surface/texture_views.hpp"

namespace gnbv {

struct ViewCandidate {
  std::uint32_t view = 0;
  float quality = 0.0F;
};

/// The views that show each face, at least 0.6 as good as its best one, best first, as
/// texture_views says.
std::vector<std::vector<ViewCandidate>> view_candidates(const TriangleMesh& mesh,
                                                        const RayScene& scene,
                                                        std::span<const TextureView> views,
                                                        const ViewChoiceSettings& settings,
                                                        int threads);

}  // namespace gnbv
