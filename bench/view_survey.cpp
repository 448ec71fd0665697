#include "bench/view_survey.hpp"

#include <algorithm>
#include <cmath>

#include "planner/map/surface_cloud.hpp"
#include "sensors/capture.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr int kYaws = 8;
constexpr double kFewestPixels = 0.05;  // share of the images that has to show structure
constexpr std::size_t kViewsAtOnce = 16;

/// The scenario's cameras without noise, and coarse ones that look the same way.
struct SurveyCameras {
  std::vector<CameraModel> exact, quick;
  double reach_m = 0.0;

  explicit SurveyCameras(const Scenario& scenario) {
    for (CameraConfig config : scenario.cameras) {
      config.noise.model = DepthNoise::none;
      exact.push_back(make_camera_model(config));
      reach_m = std::max(reach_m, config.p_body_m.norm() +
                                      config.range_max_m *
                                          std::hypot(1.0, std::tan(0.5 * config.fov_x_rad),
                                                     std::tan(0.5 * config.fov_y_rad)));
      config.width_px = 40;
      config.height_px = 32;
      quick.push_back(make_camera_model(config));
    }
  }
};

/// One view through all cameras, as the mission takes it.
void take(const RayScene& scene, std::span<const CameraModel> cameras, const ViewPose& pose,
          double floor_z_m, std::vector<FrameRays>& rays) {
  rays.resize(cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const DepthFrame frame =
        capture_depth(scene, cameras[i], static_cast<int>(i), T_world_body(pose), {}, 1);
    compute_frame_rays(frame, cameras[i], floor_z_m, rays[i]);
  }
}

double share_of_hits(std::span<const FrameRays> rays) {
  std::size_t hits = 0;
  std::size_t pixels = 0;
  for (const FrameRays& frame : rays) {
    hits += static_cast<std::size_t>(
        std::count(frame.kind.begin(), frame.kind.end(), PixelRay::hits));
    pixels += frame.kind.size();
  }
  return static_cast<double>(hits) / static_cast<double>(std::max<std::size_t>(pixels, 1));
}

ViewPose pose_of(const LegalViewpoints& legal, const SurveyedView& view) {
  return {legal.p_world_m[view.position], view.yaw_rad};
}

std::vector<SurveyedView> worthwhile_views(const Scenario& scenario, const RayScene& scene,
                                           const LegalViewpoints& legal,
                                           const SurveyCameras& cameras, int threads) {
  std::vector<std::vector<SurveyedView>> at(legal.size());
  parallel_for(threads, legal.size(), [&](std::size_t i) {
    const auto& cell = legal.cell[i];
    if (cell[0] % 2 != 0 || cell[1] % 2 != 0 || cell[2] % 2 != 0) return;
    if (std::isinf(scene.distance_to_structure_m(legal.p_world_m[i], cameras.reach_m))) return;
    std::vector<FrameRays> rays;
    for (int k = 0; k < kYaws; ++k) {
      SurveyedView view{.position = static_cast<std::uint32_t>(i),
                        .yaw_rad = wrap_angle_rad(2.0 * kPi * k / kYaws)};
      take(scene, cameras.quick, pose_of(legal, view), scenario.planner.floor_z_m, rays);
      if (share_of_hits(rays) >= kFewestPixels) at[i].push_back(std::move(view));
    }
  });
  std::vector<SurveyedView> views;
  for (auto& some : at) std::move(some.begin(), some.end(), std::back_inserter(views));
  return views;
}

/// Indices into `reference` of the voxels that hold one of the points.
std::vector<std::uint32_t> voxels_found(const VoxelSet& reference,
                                        std::span<const Vec3f> points_world_m) {
  std::vector<std::uint32_t> found;
  auto from = reference.begin();
  for (const std::uint64_t code : voxels_of(points_world_m, kCoverageSizes_m[0])) {
    from = std::lower_bound(from, reference.end(), code);
    if (from == reference.end()) break;
    if (*from == code) found.push_back(static_cast<std::uint32_t>(from - reference.begin()));
  }
  return found;
}

/// Like SurfaceCloud's filter on an empty cloud.
std::vector<Vec3f> leaf_points(std::span<const FrameRays> rays, double leaf_m, LeafSums& sums) {
  const LeafLattice lattice(leaf_m);
  sums.reset();
  for (const FrameRays& frame : rays) {
    for (std::size_t i = 0; i < frame.kind.size(); ++i) {
      if (frame.kind[i] != PixelRay::hits) continue;
      const Vec3f p_m(frame.x_m[i], frame.y_m[i], frame.z_m[i]);
      sums.add(lattice.key_of(p_m), p_m);
    }
  }
  std::vector<Vec3f> points_m(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) points_m[i] = sums.centroid_m(i);
  return points_m;
}

}  // namespace

ViewSurvey survey_views(const Scenario& scenario, const World& world, const RayScene& scene,
                        const LegalViewpoints& legal, const SurfaceReference& reference,
                        int threads) {
  (void)world;
  const SurveyCameras cameras(scenario);
  const PlannerConfig& planner = scenario.planner;
  ViewSurvey survey{.views = worthwhile_views(scenario, scene, legal, cameras, threads)};
  SurfaceCloud cloud(planner.cloud, GridGeometry(scenario.workspace_m, planner.map.resolution_m));
  std::vector<std::vector<FrameRays>> rays(kViewsAtOnce);
  std::vector<LeafSums> sums(kViewsAtOnce);
  for (std::size_t begin = 0; begin < survey.views.size(); begin += kViewsAtOnce) {
    const std::size_t count = std::min(kViewsAtOnce, survey.views.size() - begin);
    parallel_for(threads, count, [&](std::size_t i) {
      SurveyedView& view = survey.views[begin + i];
      take(scene, cameras.exact, pose_of(legal, view), planner.floor_z_m, rays[i]);
      view.finds = voxels_found(reference.outside[0],
                                leaf_points(rays[i], planner.cloud.leaf_m, sums[i]));
    });
    for (std::size_t i = 0; i < count; ++i) cloud.add(rays[i], planner.cloud.leaf_m);
  }
  survey.leaf_raw = coverage_at_all_sizes(reference.raw, cloud.points_world_m());
  survey.leaf_outside = coverage_at_all_sizes(reference.outside, cloud.points_world_m());
  survey.found = voxels_found(reference.outside[0], cloud.points_world_m());
  return survey;
}

}  // namespace gnbv
