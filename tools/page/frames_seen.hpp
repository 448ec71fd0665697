// What the cameras of a run saw, small enough for a page: thumbnails, colours of points, and of a
// run that still flies the points themselves. Each image is read once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/image.hpp"
#include "tools/frames/frame_sight.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

struct Thumbnail {
  std::size_t frame = 0;  // into FrameRecord::frames
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> jpeg;
  std::vector<std::uint8_t> depth_jpeg = {};  // of the same size, see depth_picture()

  bool operator==(const Thumbnail&) const = default;
};

struct FramesSeen {
  std::vector<Thumbnail> thumbnails;  // of all frames, in their order
  std::vector<Rgb8> colour;           // of each point; may be empty

  bool operator==(const FramesSeen&) const = default;
};

/// As far as any camera of the scenario sees.
double depth_range_m(const Scenario& scenario);

/// Depth along the optical axis as colours of amounts, from 0 to `far_m`; grey where there is none.
/// Every `factor`-th pixel of every `factor`-th row.
Image depth_picture(const GreyImage16& depth, double step_m, double far_m, int factor);

/// Points of the cloud (`points`, ascending) are coloured as CloudColours says; a grey where no
/// frame shows them. The same at any number of threads. Throws BadInput naming an image that cannot
/// be read, or is not of its camera's size.
FramesSeen look_at_frames(const RunRecord& record, const FrameRecord& frames, const RunCloud& cloud,
                          std::span<const std::size_t> points, int threads,
                          const ShareDone& progress);

/// Of a run that has no cloud yet, since one is written when its mission ends: `cloud` becomes what
/// some pixels of the depth images show above the floor, the first point in each leaf, about what
/// the mission's cloud holds by then without the profile's points; a point has its pixel's colour.
FramesSeen look_at_growing_frames(const RunRecord& record, const FrameRecord& frames, int threads,
                                  const ShareDone& progress, RunCloud& cloud);

}  // namespace gnbv
