// From where the picture of a decision is seen.
#pragma once

#include "tools/render/picture.hpp"

namespace gnbv {

/// The decision that a picture is about: half way, unless another is asked for. Throws BadInput for
/// view 0, which nothing chose.
std::size_t decision_asked(const RunRecord& record, const PictureOptions& options);

/// The structure and what could be chosen from, not the pyramid: it reaches far beyond both.
void frame_candidates(RunSource& run, const PictureOptions& options,
                      std::vector<Vec3>& points_world_m);

/// Of eight directions around, the one that shows the most of the runs' candidates: those chosen
/// count the most, then those that were valid; those out of bounds lie anywhere.
ViewAngles angles_to_candidates(std::span<RunSource* const> runs, const PictureOptions& options);

/// The view before, the chosen one, and where the rays of `chosen` end; from behind the chosen view
/// and beside it, on the side of the whole picture's camera.
RenderView near_view(const RunRecord& record, std::size_t iteration, const RenderScene& chosen,
                     const RenderView& whole);

}  // namespace gnbv
