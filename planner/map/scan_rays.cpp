#include "planner/map/scan_rays.hpp"

#include <algorithm>
#include <limits>

#include "sim/core/error.hpp"

namespace gnbv {

std::vector<ScanRay> rays_of(const LidarScan& scan, const LidarModel& lidar, double floor_z_m,
                             NoReturn no_return) {
  std::vector<Vec3f> memory;
  const std::span<const Vec3f> beams = lidar.beams_at(scan.begin_s, memory);
  GNBV_CHECK(scan.range_m.size() == beams.size(), "{} ranges for {} beams", scan.range_m.size(),
             beams.size());
  const auto range_min_m = static_cast<float>(lidar.config.range_min_m);
  const auto range_max_m = static_cast<float>(lidar.config.range_max_m);
  std::vector<ScanRay> rays;
  rays.reserve(beams.size());
  for (std::size_t b = 0; b < beams.size(); ++b) {
    const float range_m = scan.range_m[b];
    if (!(range_m >= range_min_m)) continue;
    const bool has_return = range_m <= range_max_m;
    if (!has_return && no_return == NoReturn::unknown) continue;
    const double along_m = has_return ? range_m : lidar.config.range_max_m;
    const Vec3 end_m = scan.T_world_lidar * (along_m * beams[b].cast<double>());
    rays.push_back({end_m.cast<float>(), has_return && end_m.z() >= floor_z_m});
  }
  return rays;
}

void compute_sweep_rays(const LidarScan& scan, const LidarModel& lidar, double floor_z_m,
                        FrameRays& rays, NoReturn no_return) {
  const std::vector<ScanRay> each = rays_of(scan, lidar, floor_z_m, no_return);
  rays.origin_world_m = scan.T_world_lidar.translation().cast<float>();
  rays.kind.clear();
  for (std::vector<float>& column : rays.end_m) column.clear();
  for (const ScanRay& ray : each) {
    rays.kind.push_back(ray.hit ? PixelRay::hits : PixelRay::clears);
    for (int a = 0; a < 3; ++a) rays.end_m[a].push_back(ray.end_world_m[a]);
  }
}

std::vector<Vec3f> surface_points_world_m(std::span<const ScanRay> rays) {
  std::vector<Vec3f> points;
  for (const ScanRay& ray : rays) {
    if (ray.hit) points.push_back(ray.end_world_m);
  }
  return points;
}

namespace {

/// The whole directions of a row whose rays part into no rows and columns, and the range along each
/// for a depth of 1. Of pixels without a ray: none.
void set_lens_row(const Lens& lens, const Eigen::Matrix3d& R, std::ptrdiff_t first,
                  Eigen::MatrixX3d& across, Eigen::VectorXf& range) {
  for (Eigen::Index u = 0; u < range.size(); ++u) {
    const Eigen::Vector2f& xy = lens.directions()[static_cast<std::size_t>(first + u)];
    Vec3 along = xy.cast<double>().homogeneous();
    range[u] = lens.is_radial() ? static_cast<float>(along.norm()) : 1.0F;
    if (lens.is_radial()) along.normalize();
    if (std::isnan(xy.x())) {
      along.setZero();
      range[u] = std::numeric_limits<float>::quiet_NaN();
    }
    across.row(u) = R * along;
  }
}

}  // namespace

void compute_frame_rays(const DepthFrame& frame, const CameraModel& camera, double floor_z_m,
                        FrameRays& rays, NoReturn no_return) {
  constexpr float kNone = std::numeric_limits<float>::infinity();
  const int width = camera.config.width_px;
  const int height = camera.config.height_px;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  GNBV_CHECK(frame.depth_m.size() == pixels, "{} depths for {} x {} pixels", frame.depth_m.size(),
             width, height);
  const Eigen::Matrix3d R = frame.T_world_camera.linear();
  const Vec3 origin_m = frame.T_world_camera.translation();
  rays.origin_world_m = origin_m.cast<float>();
  rays.kind.resize(pixels);
  rays.row_stride = (width + kPadding - 1) / kPadding * kPadding + kPadding;
  rays.inverse_depth.resize(static_cast<std::size_t>(rays.row_stride) * height);
  PixelRow row{};
  row.width = width;
  row.range_max_m = camera.config.range_max_m;
  row.range_min_m = static_cast<float>(camera.config.range_min_m);
  row.range_max_compared_m = static_cast<float>(camera.config.range_max_m);
  row.says_until_m = no_return == NoReturn::free ? kNone : row.range_max_compared_m;
  row.floor_z_m = floor_z_m;
  Eigen::MatrixX3d across(width + kPadding, 3);  // world part of each column
  for (int a = 0; a < 3; ++a) {
    rays.end_m[a].resize(pixels);
    for (int u = 0; u < width && !camera.lens; ++u) {
      across(u, a) = R(a, 0) * camera.ray_camera(u, 0).x();
    }
    row.across[a] = across.col(a).data();
    row.origin_m[a] = origin_m[a];
  }
  Eigen::VectorXf range_m(width);  // of a row, along a lens's rays
  for (int v = 0; v < height; ++v) {
    const std::ptrdiff_t first = std::ptrdiff_t{v} * width;
    const Vec3 down =
        camera.lens ? Vec3::Zero()
                    : Vec3(R.col(1) * static_cast<double>(camera.ray_camera(0, v).y()) + R.col(2));
    for (int a = 0; a < 3; ++a) {
      row.down[a] = down[a];
      row.end_m[a] = rays.end_m[a].data() + first;
    }
    row.depth_m = frame.depth_m.data() + first;
    if (camera.lens) {
      set_lens_row(*camera.lens, R, first, across, range_m);
      for (int u = 0; u < width; ++u) range_m[u] *= row.depth_m[u];
      row.depth_m = range_m.data();
    }
    row.kind = rays.kind.data() + first;
    row.inverse_depth = rays.inverse_depth.data() + std::ptrdiff_t{v} * rays.row_stride;
    frame_kernels().rays_of_row(row);
    std::fill(row.inverse_depth + width, row.inverse_depth + rays.row_stride, kNone);
  }
}

}  // namespace gnbv
