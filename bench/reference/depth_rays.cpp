#include "bench/reference/analytic_scans.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

std::vector<ScanRay> rays_of(const DepthFrame& frame, const CameraModel& camera, double floor_z_m,
                             NoReturn no_return) {
  const int width_px = camera.config.width_px;
  const int height_px = camera.config.height_px;
  GNBV_CHECK(frame.depth_m.size() ==
                 static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px),
             "{} depths for {} x {} pixels", frame.depth_m.size(), width_px, height_px);
  const auto range_min_m = static_cast<float>(camera.config.range_min_m);
  const auto range_max_m = static_cast<float>(camera.config.range_max_m);
  const Eigen::Matrix3d R = frame.T_world_camera.linear();
  const Vec3 origin_m = frame.T_world_camera.translation();
  std::vector<Vec3> across(static_cast<std::size_t>(width_px));  // world part of each column
  for (int u = 0; u < width_px; ++u) {
    across[static_cast<std::size_t>(u)] =
        R.col(0) * static_cast<double>(camera.ray_camera(u, 0).x());
  }
  std::vector<ScanRay> rays;
  rays.reserve(frame.depth_m.size());
  const float* depth_m = frame.depth_m.data();
  for (int v = 0; v < height_px; ++v) {
    const Vec3 down = R.col(1) * static_cast<double>(camera.ray_camera(0, v).y()) + R.col(2);
    for (const Vec3& column : across) {
      const float d_m = *depth_m++;
      if (!(d_m >= range_min_m)) continue;
      const bool has_return = d_m <= range_max_m;
      if (!has_return && no_return == NoReturn::unknown) continue;
      const double along_m = has_return ? static_cast<double>(d_m) : camera.config.range_max_m;
      const Vec3 end_m = origin_m + along_m * (column + down);
      rays.push_back({end_m.cast<float>(), has_return && end_m.z() >= floor_z_m});
    }
  }
  return rays;
}

}  // namespace gnbv
