#include "tools/run_files/frame_files.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/image.hpp"

namespace gnbv {
namespace {

std::uint16_t millimetres(float depth_m) {
  constexpr float kMax_mm = 65535.0F;
  const float depth_mm = std::round(1000.0F * depth_m);
  return depth_mm > 0.0F && depth_mm <= kMax_mm ? static_cast<std::uint16_t>(depth_mm) : 0;
}

GreyImage16 image_of(const DepthFrame& frame, const CameraConfig& camera) {
  GreyImage16 image{camera.width_px, camera.height_px, {}};
  image.values.resize(frame.depth_m.size());
  std::transform(frame.depth_m.begin(), frame.depth_m.end(), image.values.begin(), millimetres);
  return image;
}

Image image_of(const ColourFrame& frame, const CameraConfig& camera) {
  Image image{camera.width_px, camera.height_px, {}};
  image.rgb.reserve(3 * frame.rgb.size());
  for (const auto& pixel : frame.rgb) image.rgb.insert(image.rgb.end(), pixel.begin(), pixel.end());
  return image;
}

}  // namespace

FrameFiles::FrameFiles(std::filesystem::path folder, std::vector<CameraModel> cameras)
    : folder_(std::move(folder)),
      cameras_(std::move(cameras)),
      poses_("iteration,camera,time_s,x_m,y_m,z_m,qx,qy,qz,qw,rgb,depth\n") {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) {
    throw BadInput(
        fmt::format("{}: cannot make the folder: {}", folder_.string(), error.message()));
  }
  nlohmann::ordered_json intrinsics = nlohmann::ordered_json::array();
  for (const CameraModel& camera : cameras_) {
    intrinsics.push_back({{"name", camera.config.name},
                          {"width_px", camera.config.width_px},
                          {"height_px", camera.config.height_px},
                          {"fx_px", camera.fx_px},
                          {"fy_px", camera.fy_px},
                          {"cx_px", camera.cx_px},
                          {"cy_px", camera.cy_px},
                          {"depth_scale_m", 0.001}});
  }
  write_file_atomically(folder_ / "cameras.json", intrinsics.dump(2) + "\n");
}

void FrameFiles::write(std::size_t iteration, double time_s, std::span<const DepthFrame> depth,
                       std::span<const ColourFrame> colour) {
  GNBV_CHECK(depth.size() == colour.size(), "{} depth frames, {} colour frames", depth.size(),
             colour.size());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const CameraConfig& camera = cameras_[static_cast<std::size_t>(depth[i].camera)].config;
    const std::string stem = fmt::format("{:04}_{}", iteration, camera.name);
    write_png(image_of(colour[i], camera), folder_ / (stem + ".rgb.png"));
    write_png(image_of(depth[i], camera), folder_ / (stem + ".depth.png"));
    const Vec3 p = depth[i].T_world_camera.translation();
    const Eigen::Quaterniond q(depth[i].T_world_camera.linear());
    poses_ += fmt::format(
        "{},{},{:.3f},{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},{:.9f},{:.9f},{}.rgb.png,{}.depth.png\n",
        iteration, camera.name, time_s, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(), stem,
        stem);
  }
  write_file_atomically(folder_ / "poses.csv", poses_);
}

}  // namespace gnbv
