#include "tools/report/frame_cloud.hpp"

#include <algorithm>
#include <cmath>

#include "tools/report/thinning.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kMostPixels = 4'000'000;  // of all images
constexpr std::size_t kMostOfImage = 10'000;

/// Every so many pixels of a row, and every so many rows, are looked at.
int step_px(const FrameRecord& frames, const FrameCamera& camera) {
  const std::size_t most = std::min(kMostOfImage, kMostPixels / frames.frames.size());
  const auto pixels = static_cast<double>(camera.width_px) * camera.height_px;
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / static_cast<double>(most)))));
}

std::vector<Vec3f> points_of(const RecordedFrame& frame, const FrameCamera& camera,
                             const GreyImage16& depth, int step, double floor_z_m) {
  std::vector<Vec3f> points_world_m;
  for (int y = step / 2; y < depth.height_px; y += step) {
    for (int x = step / 2; x < depth.width_px; x += step) {
      const std::uint16_t steps = depth.values[static_cast<std::size_t>(y * depth.width_px + x)];
      if (steps == 0) continue;
      const double z_m = camera.depth_scale_m * steps;
      const Vec3 p_camera_m = {(x + 0.5 - camera.cx_px) / camera.fx_px * z_m,
                               (y + 0.5 - camera.cy_px) / camera.fy_px * z_m, z_m};
      const Vec3 p_world_m = frame.T_world_camera * p_camera_m;
      if (p_world_m.z() >= floor_z_m) points_world_m.push_back(p_world_m.cast<float>());
    }
  }
  return points_world_m;
}

}  // namespace

RunCloud cloud_of_frames(const RunRecord& record, const FrameRecord& frames, int threads) {
  std::vector<std::vector<Vec3f>> of_frame(frames.frames.size());
  for_each_frame(
      frames, threads, [](double) {},
      [&](std::size_t i, const FrameSight& sight) {
        const FrameCamera& camera = frames.cameras[frames.frames[i].camera];
        of_frame[i] = points_of(frames.frames[i], camera, sight.depth(), step_px(frames, camera),
                                record.scenario.planner.floor_z_m);
      });
  std::vector<Vec3f> all;
  std::vector<std::size_t> ends;  // in `all`, after each view
  std::size_t frame = 0;          // they come by iteration, as the views do
  for (const ViewRecord& view : record.views) {
    for (; frame < of_frame.size() && frames.frames[frame].iteration <= view.iteration; ++frame) {
      all.insert(all.end(), of_frame[frame].begin(), of_frame[frame].end());
    }
    ends.push_back(all.size());
  }
  RunCloud cloud;
  const std::vector<std::size_t> kept =
      first_points(all, std::max(record.scenario.planner.cloud.leaf_m, 1e-3));
  for (const std::size_t i : kept) cloud.points_world_m.push_back(all[i]);
  for (const std::size_t end : ends) {
    const auto after = std::lower_bound(kept.begin(), kept.end(), end);
    cloud.view_points.push_back(static_cast<std::size_t>(after - kept.begin()));
  }
  return cloud;
}

}  // namespace gnbv
