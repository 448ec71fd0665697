#include "tools/render/grid_samples.hpp"

namespace gnbv {
namespace {

const Rgb kSample = srgb(0x0072b2);
const Rgb kVehicle = srgb(0x15151a);

Vec3 ahead_of(const ViewPose& view) {
  return {std::cos(view.yaw_rad), std::sin(view.yaw_rad), 0.0};
}

}  // namespace

void add_grid_samples(const AgvsConfig& config, const ViewPose& from, double scale, double unit_m,
                      RenderScene& scene) {
  for (const ViewPose& view : sample_agvs(config, from, scale)) {
    const Vec3 tip_m = view.p_world_m + 26.0 * unit_m * ahead_of(view);
    scene.add_ball(view.p_world_m, 7.0 * unit_m, kSample, true);
    scene.add_line(view.p_world_m, tip_m, 2.4 * unit_m, kSample);
  }
  scene.add_ball(from.p_world_m, 11.0 * unit_m, kVehicle, true);
}

RenderView view_of_grid_samples(const AgvsConfig& config, const ViewPose& from, double largest,
                                const ViewAngles& angles, int width_px, int height_px) {
  std::vector<Vec3> points_m;
  for (const ViewPose& view : sample_agvs(config, from, largest)) {
    points_m.push_back(view.p_world_m);
    points_m.push_back(view.p_world_m + 0.5 * config.step_m * ahead_of(view));
  }
  return frame_points(points_m, angles, width_px, height_px);
}

}  // namespace gnbv
