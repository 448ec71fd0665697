// What the cameras of a run saw, small enough for a page: thumbnails, and the colours of points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sim/core/image.hpp"
#include "tools/run/frames_folder.hpp"
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

struct CameraFrames {
  std::vector<Thumbnail> thumbnails;  // in the order of the frames
  std::vector<Rgb8> colour;           // of each point asked for; may be empty

  bool operator==(const CameraFrames&) const = default;
};

/// As far as any camera of the scenario sees.
double depth_range_m(const Scenario& scenario);

/// Depth along the optical axis as colours of amounts, from 0 to `far_m`; grey where there is none.
/// Every `factor`-th pixel of every `factor`-th row.
Image depth_picture(const GreyImage16& depth, double step_m, double far_m, int factor);

/// What is done of 1.0.
using ReportProgress = std::function<void(double)>;

/// Reads every frame once. Thumbnails are of every view, or of every second, third ... one, so that
/// together they stay within `max_bytes`. Points of the cloud (`points`, ascending) are coloured as
/// CloudColours says; a grey where no frame shows them. The same at any number of threads. Throws
/// BadInput naming an image that cannot be read, or is not of its camera's size.
CameraFrames read_camera_frames(const RunRecord& record, const FrameRecord& frames,
                                const RunCloud& cloud, std::span<const std::size_t> points,
                                std::size_t max_bytes, int threads, const ReportProgress& progress);

}  // namespace gnbv
