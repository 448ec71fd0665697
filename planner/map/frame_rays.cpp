#include "planner/map/frame_rays.hpp"

#include "sim/core/error.hpp"

namespace gnbv {

void compute_frame_rays(const DepthFrame& frame, const CameraModel& camera, double floor_z_m,
                        FrameRays& rays) {
  const auto width = static_cast<std::size_t>(camera.config.width_px);
  const auto height = static_cast<std::size_t>(camera.config.height_px);
  const std::size_t pixels = width * height;
  GNBV_CHECK(frame.depth_m.size() == pixels, "{} depths for {} x {} pixels", frame.depth_m.size(),
             width, height);
  const auto range_min_m = static_cast<float>(camera.config.range_min_m);
  const auto range_max_m = static_cast<float>(camera.config.range_max_m);
  const Eigen::Matrix3d R = frame.T_world_camera.linear();
  const Vec3 origin_m = frame.T_world_camera.translation();
  rays.origin_world_m = origin_m.cast<float>();
  for (std::vector<float>* column : {&rays.x_m, &rays.y_m, &rays.z_m}) column->resize(pixels);
  rays.kind.resize(pixels);
  std::size_t i = 0;
  for (std::size_t v = 0; v < height; ++v) {
    const Vec3 down =
        R.col(1) * static_cast<double>(camera.ray_camera(0, static_cast<int>(v)).y()) + R.col(2);
    for (std::size_t u = 0; u < width; ++u, ++i) {
      const float d_m = frame.depth_m[i];
      const Vec3 across =
          R.col(0) * static_cast<double>(camera.ray_camera(static_cast<int>(u), 0).x());
      const bool has_return = d_m <= range_max_m;
      const double along_m = has_return ? static_cast<double>(d_m) : camera.config.range_max_m;
      const Vec3 end_m = origin_m + along_m * (across + down);
      rays.x_m[i] = static_cast<float>(end_m.x());
      rays.y_m[i] = static_cast<float>(end_m.y());
      rays.z_m[i] = static_cast<float>(end_m.z());
      rays.kind[i] = !(d_m >= range_min_m)                  ? PixelRay::none
                     : has_return && end_m.z() >= floor_z_m ? PixelRay::hits
                                                            : PixelRay::clears;
    }
  }
}

}  // namespace gnbv
