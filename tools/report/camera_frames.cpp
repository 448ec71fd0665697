#include "tools/report/camera_frames.hpp"

#include <algorithm>
#include <utility>

#include "tools/report/jpeg.hpp"
#include "tools/run_files/cloud_colours.hpp"

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
      if (is_kept(t)) bytes += (t.jpeg.size() + 3) / 4 * 4;  // as BytePack aligns them
    }
    if (bytes > max_bytes) continue;
    std::erase_if(all, [&](const Thumbnail& t) { return !is_kept(t); });
    return all;
  }
  return {};
}

}  // namespace

CameraFrames read_camera_frames(const RunRecord& record, const FrameRecord& frames,
                                const RunCloud& cloud, std::span<const std::size_t> points,
                                std::size_t max_bytes, int threads,
                                const ReportProgress& progress) {
  CloudColours colours(record, cloud, frames, points);
  std::vector<Thumbnail> thumbnails(frames.frames.size());
  for_each_frame(frames, threads, progress, [&](std::size_t frame, const FrameSight& sight) {
    colours.look(frame, sight);
    const Image small =
        shrunk(sight.colour(), std::max(1, sight.colour().width_px / kThumbnailWidth_px));
    thumbnails[frame] = {frame, small.width_px, small.height_px, jpeg_bytes(small, kJpegQuality)};
  });
  return {within(std::move(thumbnails), frames, max_bytes), colours.colours(kNotSeen)};
}

}  // namespace gnbv
