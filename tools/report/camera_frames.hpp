// What the cameras of a run saw, small enough for a page: thumbnails, and the colours of points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tools/run_files/frame_record.hpp"
#include "tools/run_files/run_record.hpp"

namespace gnbv {

struct Thumbnail {
  std::size_t frame = 0;  // into FrameRecord::frames
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> jpeg;

  bool operator==(const Thumbnail&) const = default;
};

struct CameraFrames {
  std::vector<Thumbnail> thumbnails;                // in the order of the frames
  std::vector<std::array<std::uint8_t, 3>> colour;  // sRGB, of each point asked for; may be empty

  bool operator==(const CameraFrames&) const = default;
};

/// What is done of 1.0.
using ReportProgress = std::function<void(double)>;

/// Reads every colour frame once. Thumbnails are of every view, or of every second, third ... one,
/// so that together they stay within `max_bytes`. A point of the cloud (`points`, ascending) has
/// the colour of the pixel it falls on in the frames of the view that brought it; one of the
/// profile has that of the nearest such point within 0.2 m or so, else a grey. The same at any
/// number of threads. Throws BadInput naming an image that cannot be read, or is not of its
/// camera's size.
CameraFrames read_camera_frames(const FrameRecord& frames, const RunCloud& cloud,
                                std::span<const std::size_t> points, std::size_t max_bytes,
                                int threads, const ReportProgress& progress);

}  // namespace gnbv
