#include <bit>
#include <cmath>

#include "bench/reference/analytic_scans.hpp"
#include "bench/reference/octomap_twin.hpp"
#include "bench/speed/speed_rows.hpp"
#include "planner/map/scan_insertion.hpp"
#include "sim/core/simd.hpp"

namespace gnbv {
namespace {

constexpr double kNoFloor_m = -1e9;

/// Ours at one SIMD level: a map of the frames, and one of the same frames with all rays hits.
struct Ours {
  explicit Ours(SimdLevel at_level) : level(at_level) {}

  void insert(const DepthFrame& frame, double floor_z_m, OccupancyGrid& to) {
    set_simd_level(level);
    compute_frame_rays(frame, circle_camera(), floor_z_m, rays);
    to.apply(inserter.compute_update(rays, frame, circle_camera(), to, 1));
  }

  SimdLevel level;
  OccupancyGrid grid{OccupancyConfig{}, kWorkspace_m};
  OccupancyGrid grid_of_hits{OccupancyConfig{}, kWorkspace_m};
  ScanInserter inserter{grid.geometry()};
  FrameRays rays;
  std::vector<double> times_ms;
};

bool is_identical(const OccupancyGrid& grid, const OctomapTwin& twin) {
  const auto voxels = static_cast<VoxelIndex>(grid.geometry().voxel_count());
  for (VoxelIndex v = 0; v < voxels; ++v) {
    const std::optional<float> expected = twin.log_odds(grid.geometry().key_at(v));
    if (grid.is_measured(v) != expected.has_value()) return false;
    if (std::bit_cast<std::uint32_t>(grid.log_odds(v)) !=
        std::bit_cast<std::uint32_t>(expected.value_or(0.0F))) {
      return false;
    }
  }
  return true;
}

DepthFrame with_hits_only(DepthFrame frame) {
  for (float& depth_m : frame.depth_m) {
    if (depth_m == kNoReturn) depth_m = static_cast<float>(circle_camera().config.range_max_m);
  }
  return frame;
}

}  // namespace

const CameraModel& circle_camera() {
  static const CameraModel camera = [] {
    CameraConfig config;
    config.pitch_rad = deg_to_rad(20.0);
    return make_camera_model(config);
  }();
  return camera;
}

const std::vector<DepthFrame>& circle_frames() {
  static const std::vector<DepthFrame> frames = [] {
    constexpr int kViews = 16;
    std::vector<DepthFrame> made;
    for (int view = 0; view < kViews; ++view) {
      const double angle_rad = view * 2.0 * kPi / kViews;
      const ViewPose pose = {Vec3(9.0 * std::cos(angle_rad), 9.0 * std::sin(angle_rad), 4.5),
                             angle_rad + kPi};
      made.push_back(analytic_depth(example_scene(), circle_camera(), T_world_body(pose)));
    }
    return made;
  }();
  return frames;
}

std::vector<SpeedRow> map_speed() {
  const SimdLevel level_before = simd_level();
  constexpr std::array kLevels = {SimdLevel::avx512, SimdLevel::avx2, SimdLevel::baseline};
  std::vector<Ours> ours;
  for (const SimdLevel level : kLevels) ours.emplace_back(level);
  OctomapTwin ray_by_ray{OccupancyConfig{}};
  OctomapTwin point_clouds{OccupancyConfig{}};
  OctomapTwin discretised{OccupancyConfig{}};
  std::vector<double> reference_ms;
  std::vector<double> competent_ms;
  for (const DepthFrame& frame : circle_frames()) {
    const Vec3f origin_m = frame.T_world_camera.translation().cast<float>();
    const std::vector<ScanRay> rays = rays_of(frame, circle_camera(), kFloor_m);
    std::vector<Vec3f> ends_m;
    for (const ScanRay& ray : rays) ends_m.push_back(ray.end_world_m);
    const OctomapScan scan(origin_m, ends_m);
    reference_ms.push_back(
        time_ms([&] { point_clouds.insert_point_cloud(scan, /*lazy=*/false, false); }));
    competent_ms.push_back(
        time_ms([&] { discretised.insert_point_cloud(scan, /*lazy=*/true, true); }));
    ray_by_ray.insert(origin_m, rays);
    const DepthFrame hits = with_hits_only(frame);  // what insertPointCloud makes of it
    for (Ours& each : ours) {
      each.times_ms.push_back(time_ms([&] { each.insert(hits, kNoFloor_m, each.grid_of_hits); }));
      each.insert(frame, kFloor_m, each.grid);
    }
  }
  set_simd_level(level_before);

  constexpr std::array kNames = {"depth_frame_into_map", "depth_frame_into_map_avx2",
                                 "depth_frame_into_map_baseline"};
  constexpr std::array kTargets = {150.0, 10.0, 10.0};
  std::vector<SpeedRow> rows;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    if (i > 0 && kLevels[i] > level_before) continue;  // this machine, or GNBV_SIMD, has it not
    rows.push_back({.name = kNames[i],
                    .ours = median(ours[i].times_ms),
                    .reference = median(reference_ms),
                    .competent = median(competent_ms),
                    .unit = "ms",
                    .identical = is_identical(ours[i].grid, ray_by_ray) &&
                                 is_identical(ours[i].grid_of_hits, point_clouds),
                    .target = kTargets[i]});
  }
  return rows;
}

}  // namespace gnbv
