#include "planner/map/frame_rays.hpp"

#include <algorithm>
#include <array>

#include "planner/map/frame_kernels.hpp"
#include "planner/map/frame_view.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

void compute_frame_rays(const DepthFrame& frame, const CameraModel& camera, double floor_z_m,
                        FrameRays& rays) {
  const auto width = static_cast<std::size_t>(camera.config.width_px);
  const auto height = static_cast<std::size_t>(camera.config.height_px);
  const std::size_t pixels = width * height;
  GNBV_CHECK(frame.depth_m.size() == pixels, "{} depths for {} x {} pixels", frame.depth_m.size(),
             width, height);
  const Eigen::Matrix3d R = frame.T_world_camera.linear();
  const Vec3 origin_m = frame.T_world_camera.translation();
  rays.origin_world_m = origin_m.cast<float>();
  const std::array<std::vector<float>*, 3> end_m = {&rays.x_m, &rays.y_m, &rays.z_m};
  for (std::vector<float>* const column : end_m) column->resize(pixels);
  rays.kind.resize(pixels);

  PixelRow row{};
  row.width = camera.config.width_px;
  row.floor_z_m = floor_z_m;
  set_ranges(camera, row);
  std::array<std::vector<double>, 3> across;  // world part of each column
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    across[a].resize(width + kPadding);
    for (std::size_t u = 0; u < width; ++u) {
      across[a][u] =
          R(axis, 0) * static_cast<double>(camera.ray_camera(static_cast<int>(u), 0).x());
    }
    row.across[a] = across[a].data();
    row.origin_m[a] = origin_m[axis];
  }
  const FrameKernels& kernels = frame_kernels();
  for (std::size_t v = 0; v < height; ++v) {
    const Vec3 down =
        R.col(1) * static_cast<double>(camera.ray_camera(0, static_cast<int>(v)).y()) + R.col(2);
    for (std::size_t a = 0; a < 3; ++a) {
      row.down[a] = down[static_cast<Eigen::Index>(a)];
      row.end_m[a] = end_m[a]->data() + v * width;
    }
    row.depth_m = frame.depth_m.data() + v * width;
    row.kind = reinterpret_cast<std::uint8_t*>(rays.kind.data() + v * width);
    kernels.rays_of_row(row);
  }
}

}  // namespace gnbv
