// The colours of a run's cloud, from the frames that brought its points.
#pragma once

#include <vector>

#include "tools/run_files/frame_sight.hpp"
#include "tools/run_files/run_record.hpp"

namespace gnbv {

/// Of a point that no frame shows, as of a run without frames.
constexpr Rgb8 kNoColour = {128, 128, 128};

/// A colour a point. A point that a view brought has that of the nearest frame of this view, a
/// point of the profile, or from after the last view, that of the nearest frame of all. `blur_m` as
/// for FrameSight::sees(). No result depends on `threads`.
std::vector<Rgb8> colours_of_cloud(const RunRecord& record, const RunCloud& cloud,
                                   const FrameRecord& frames, double blur_m, int threads,
                                   const ShareDone& progress);

}  // namespace gnbv
