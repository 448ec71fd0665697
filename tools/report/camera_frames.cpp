#include "tools/report/camera_frames.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/frames/frame_sight.hpp"
#include "tools/render/colour.hpp"
#include "tools/report/jpeg.hpp"

namespace gnbv {
namespace {

constexpr int kThumbnailWidth_px = 320;
constexpr int kJpegQuality = 72;
constexpr Rgb8 kNotSeen = {150, 156, 164};

/// Keeps the thumbnails of every n-th view, with the least n that fits; none if none fit.
std::vector<Thumbnail> within(std::vector<Thumbnail> all, const FrameRecord& frames,
                              std::size_t max_bytes) {
  const auto most = static_cast<int>(frames.frames.size());
  for (int every = 1; every <= most; ++every) {
    std::size_t bytes = 0;
    const auto is_kept = [&](const Thumbnail& t) {
      return frames.frames[t.frame].iteration % every == 0;
    };
    for (const Thumbnail& t : all) {
      if (!is_kept(t)) continue;
      for (const auto* jpeg : {&t.jpeg, &t.depth_jpeg}) {
        bytes += (jpeg->size() + 3) / 4 * 4;  // as BytePack aligns them
      }
    }
    if (bytes > max_bytes) continue;
    std::erase_if(all, [&](const Thumbnail& t) { return !is_kept(t); });
    return all;
  }
  return {};
}

double step_m(const FrameRecord& frames, std::size_t frame) {
  return frames.cameras[frames.frames[frame].camera].depth_scale_m;
}

}  // namespace

double depth_range_m(const Scenario& scenario) {
  double range_m = 0.0;
  for (const CameraConfig& camera : scenario.cameras) {
    range_m = std::max(range_m, camera.range_max_m);
  }
  return range_m;
}

Image depth_picture(const GreyImage16& depth, double step_m, double far_m, int factor) {
  Image out{depth.width_px / factor, depth.height_px / factor, {}};
  for (int y = 0; y < out.height_px; ++y) {
    for (int x = 0; x < out.width_px; ++x) {
      const std::uint16_t steps =
          depth.values[static_cast<std::size_t>(y * factor * depth.width_px + x * factor)];
      const Rgb colour = amount_ramp(step_m * steps / far_m);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto channel = std::lround(255.0F * linear_to_srgb(colour[k]));
        out.rgb.push_back(steps == 0 ? kNotSeen[k] : static_cast<std::uint8_t>(channel));
      }
    }
  }
  return out;
}

CameraFrames read_camera_frames(const RunRecord& record, const FrameRecord& frames,
                                const RunCloud& cloud, std::span<const std::size_t> points,
                                std::size_t max_bytes, int threads,
                                const ReportProgress& progress) {
  CloudColours colours(record, cloud, frames, points);
  std::vector<Thumbnail> thumbnails(frames.frames.size());
  for_each_frame(frames, threads, progress, [&](std::size_t frame, const FrameSight& sight) {
    colours.look(frame, sight);
    const int factor = std::max(1, sight.colour().width_px / kThumbnailWidth_px);
    const Image small = shrunk(sight.colour(), factor);
    const Image depth =
        depth_picture(sight.depth(), step_m(frames, frame), depth_range_m(record.scenario), factor);
    thumbnails[frame] = {frame, small.width_px, small.height_px, jpeg_bytes(small, kJpegQuality),
                         jpeg_bytes(depth, kJpegQuality)};
  });
  return {within(std::move(thumbnails), frames, max_bytes), colours.colours(kNotSeen)};
}

}  // namespace gnbv
