#include "tools/page/frames_seen.hpp"

#include <algorithm>
#include <cmath>

#include "tools/frames/frame_sight.hpp"
#include "tools/page/jpeg.hpp"
#include "tools/page/packs.hpp"
#include "tools/scene/colour.hpp"

namespace gnbv {
namespace {

constexpr int kThumbnailWidth_px = 320;
constexpr int kJpegQuality = 72;
constexpr Rgb8 kNotSeen = {150, 156, 164};
constexpr std::size_t kMostPixels = 4'000'000;  // of all images that become points
constexpr std::size_t kMostOfImage = 10'000;

Thumbnail thumbnail_of(const RunRecord& record, const FrameRecord& frames, std::size_t frame,
                       const FrameSight& sight) {
  const int factor = std::max(1, sight.colour().width_px / kThumbnailWidth_px);
  const Image small = shrunk(sight.colour(), factor);
  const double step_m = frames.cameras[frames.frames[frame].camera].depth_scale_m;
  const Image depth = depth_picture(sight.depth(), step_m, depth_range_m(record.scenario), factor);
  return {frame, small.width_px, small.height_px, jpeg_bytes(small, kJpegQuality),
          jpeg_bytes(depth, kJpegQuality)};
}

/// Every so many pixels of a row, and every so many rows, become points.
int step_px(const FrameRecord& frames, const FrameCamera& camera) {
  const std::size_t most = std::min(kMostOfImage, kMostPixels / frames.frames.size());
  const auto pixels = static_cast<double>(camera.width_px) * camera.height_px;
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / static_cast<double>(most)))));
}

struct ColouredPoints {
  std::vector<Vec3f> points_world_m;
  std::vector<Rgb8> colour;
};

void add_points(const RecordedFrame& frame, const FrameCamera& camera, const FrameSight& sight,
                int step, double floor_z_m, ColouredPoints& out) {
  const GreyImage16& depth = sight.depth();
  for (int y = step / 2; y < depth.height_px; y += step) {
    for (int x = step / 2; x < depth.width_px; x += step) {
      const std::uint16_t steps = depth.values[static_cast<std::size_t>(y * depth.width_px + x)];
      if (steps == 0) continue;
      const double z_m = camera.depth_scale_m * steps;
      Eigen::Vector2d xy((x + 0.5 - camera.cx_px) / camera.fx_px,
                         (y + 0.5 - camera.cy_px) / camera.fy_px);
      if (camera.lens) xy = camera.lens->direction_at(x + 0.5, y + 0.5).value_or(xy);
      const Vec3 p_camera_m = z_m * xy.homogeneous();
      const Vec3 p_world_m = frame.T_world_camera * p_camera_m;
      if (p_world_m.z() < floor_z_m) continue;
      out.points_world_m.push_back(p_world_m.cast<float>());
      out.colour.push_back(sight.colour().at(x, y));
    }
  }
}

}  // namespace

double depth_range_m(const Scenario& scenario) {
  double range_m = 0.0;
  for (const CameraConfig& camera : scenario.cameras) {
    range_m = std::max(range_m, return_end_m(camera));
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

FramesSeen look_at_frames(const RunRecord& record, const FrameRecord& frames, const RunCloud& cloud,
                          std::span<const std::size_t> points, int threads,
                          const ShareDone& progress) {
  CloudColours colours(record, cloud, frames, points);
  std::vector<Thumbnail> thumbnails(frames.frames.size());
  for_each_frame(frames, threads, progress, [&](std::size_t frame, const FrameSight& sight) {
    colours.look(frame, sight);
    thumbnails[frame] = thumbnail_of(record, frames, frame, sight);
  });
  return {std::move(thumbnails), colours.colours(kNotSeen)};
}

FramesSeen look_at_growing_frames(const RunRecord& record, const FrameRecord& frames, int threads,
                                  const ShareDone& progress, RunCloud& cloud) {
  FramesSeen out{.thumbnails = std::vector<Thumbnail>(frames.frames.size()), .colour = {}};
  std::vector<ColouredPoints> of_frame(frames.frames.size());
  for_each_frame(frames, threads, progress, [&](std::size_t i, const FrameSight& sight) {
    const FrameCamera& camera = frames.cameras[frames.frames[i].camera];
    add_points(frames.frames[i], camera, sight, step_px(frames, camera),
               record.scenario.planner.floor_z_m, of_frame[i]);
    out.thumbnails[i] = thumbnail_of(record, frames, i, sight);
  });
  ColouredPoints all;
  std::vector<std::size_t> ends;  // in `all`, after each view
  std::size_t frame = 0;          // they come by iteration, as the views do
  for (const ViewRecord& view : record.views) {
    for (; frame < of_frame.size() && frames.frames[frame].iteration <= view.iteration; ++frame) {
      const auto& [points, colour] = of_frame[frame];
      all.points_world_m.insert(all.points_world_m.end(), points.begin(), points.end());
      all.colour.insert(all.colour.end(), colour.begin(), colour.end());
    }
    ends.push_back(all.points_world_m.size());
  }
  cloud = {};
  const std::vector<std::size_t> kept =
      first_points(all.points_world_m, std::max(record.scenario.planner.cloud.leaf_m, 1e-3));
  for (const std::size_t i : kept) {
    cloud.points_world_m.push_back(all.points_world_m[i]);
    out.colour.push_back(all.colour[i]);
  }
  for (const std::size_t end : ends) {
    const auto after = std::lower_bound(kept.begin(), kept.end(), end);
    cloud.view_points.push_back(static_cast<std::size_t>(after - kept.begin()));
  }
  return out;
}

}  // namespace gnbv
