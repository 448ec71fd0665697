// Points of a run that has no cloud yet: a cloud is written when its mission ends.
#pragma once

#include "tools/frames/frame_sight.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// What the depth images of the views show above the floor, the first point in each leaf of the
/// cloud, of some of their pixels: about what the mission's cloud holds by then, without the
/// profile's points. The same at any number of threads. Throws BadInput naming an image that is
/// damaged.
RunCloud cloud_of_frames(const RunRecord& record, const FrameRecord& frames, int threads);

}  // namespace gnbv
