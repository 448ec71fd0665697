// What a view sees against brute force: sets of voxels, float64, ray by ray.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "bench/reference/octomap_twin.hpp"
#include "bench/reference/view_twins.hpp"
#include "tests/planner/view/view_scene.hpp"
#include "tests/support/at_simd_level.hpp"

namespace gnbv {
namespace {

/// Every number of a ViewStats with its name.
std::vector<std::pair<const char*, double>> numbers(const ViewStats& s) {
  return {{"free_voxels", s.free_voxels},
          {"unknown_voxels", s.unknown_voxels},
          {"occupied_voxels", s.occupied_voxels},
          {"predicted_voxels", s.predicted_voxels},
          {"sparse_voxels", s.sparse_voxels},
          {"entropy_nat", s.entropy_nat},
          {"density_sum", s.density_sum},
          {"entropy_per_ray_nat", s.entropy_per_ray_nat},
          {"voxel_m3", s.voxel_m3},
          {"rays", s.rays},
          {"rays_occupied", s.rays_occupied},
          {"occlusion_aware_nat", s.occlusion_aware_nat},
          {"unobserved_nat", s.unobserved_nat},
          {"rear_side_rays", s.rear_side_rays},
          {"rear_side_nat", s.rear_side_nat},
          {"crossed_by_occupied", static_cast<double>(s.crossed_by_occupied)},
          {"entropy_of_occupied_nat", s.entropy_of_occupied_nat},
          {"unknown_volume_m3", s.unknown_volume_m3},
          {"proximity_sum", s.proximity_sum},
          {"shadow_rays", s.shadow_rays},
          {"front_rays", s.front_rays}};
}

/// Where the ray leaves the voxel, as a share of its length.
double exit_share(const GridGeometry& grid, const Vec3& from_m, const Vec3& to_m, const Key& key) {
  double share = 1e9;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const double along_m = to_m[axis] - from_m[axis];
    if (along_m == 0.0) continue;
    const double border_m = (key[a] + (along_m > 0.0 ? 1 : 0)) * grid.resolution_m();
    share = std::min(share, (border_m - from_m[axis]) / along_m);
  }
  return share;
}

struct Seen {
  std::set<VoxelIndex> voxels;
  std::set<VoxelIndex> predicted;
};

void look_along(const RandomScene& scene, const Vec3& from_m, const Vec3& to_m, double pyramid_m3,
                bool legacy, Seen& seen, ViewStats& s) {
  const OccupancyGrid& grid = scene.grid;
  double visibility = 1.0, run_nat = 0.0, entropy_nat = 0.0, enter = 0.0;
  bool after_unknown = false, after_free = false, in_shadow = false, predicted = false;
  std::uint64_t crossed = 0;
  bool is_over = false;
  walk_ray(grid.geometry(), from_m.cast<float>(), to_m.cast<float>(), [&](const Key& key) {
    if (is_over || !grid.geometry().contains(key)) return false;
    const VoxelIndex v = grid.geometry().index_of(key);
    const bool counts = scene.object_bounds_m.contains(grid.geometry().center_m(key));
    const bool is_unknown = counts && grid.state(v) == VoxelState::unknown;
    const double h_nat = counts ? static_cast<double>(grid.entropy_nat(v)) : 0.0;
    const double exit = exit_share(grid.geometry(), from_m, to_m, key);
    ++crossed;
    seen.voxels.insert(v);
    entropy_nat += h_nat;
    s.occlusion_aware_nat += visibility * h_nat;
    const bool is_predicted = counts && grid.is_predicted(v);
    if (is_predicted && !predicted) seen.predicted.insert(v);
    predicted = predicted || is_predicted;
    in_shadow = in_shadow || (counts && grid.is_shaded(v));
    if (grid.state(v) == VoxelState::occupied) {
      is_over = true;
      if (!counts) return true;
      ++s.rays_occupied;
      s.rear_side_rays += after_unknown ? 1 : 0;
      s.rear_side_nat += after_unknown ? run_nat + visibility * h_nat : 0.0;
      s.front_rays += after_free && !in_shadow ? 1 : 0;
      s.crossed_by_occupied += crossed;
      s.entropy_of_occupied_nat += entropy_nat;
    } else if (is_unknown) {
      s.unobserved_nat += visibility * h_nat;
      run_nat += visibility * h_nat;
      s.unknown_volume_m3 += pyramid_m3 * (std::pow(exit, 3) - std::pow(enter, 3));
    } else {
      run_nat = 0.0;
    }
    after_unknown = is_unknown;
    after_free = !is_unknown;
    visibility *= legacy ? probability(grid, v) : 1.0 - probability(grid, v);
    enter = exit;
    return true;
  });
  s.entropy_per_ray_nat += entropy_nat;
  s.rays += crossed > 0 ? 1 : 0;
  s.shadow_rays += in_shadow ? 1 : 0;
}

ViewStats brute_force(const RandomScene& scene, const ViewRays& rays, const ViewPose& pose,
                      const ViewOptions& options) {
  const OccupancyGrid& grid = scene.grid;
  ViewStats s;
  Seen seen;
  const Isometry T = T_world_body(pose);
  for (const ViewRays::Camera& camera : rays.cameras) {
    for (std::size_t i = camera.first; i < camera.first + camera.count; ++i) {
      const Vec3 end_m(rays.end_body_m[0][i], rays.end_body_m[1][i], rays.end_body_m[2][i]);
      look_along(scene, T * camera.origin_body_m, T * end_m, camera.pyramid_m3,
                 options.legacy_visibility, seen, s);
    }
  }
  s.voxel_m3 = 0.2 * 0.2 * 0.2;
  s.predicted_voxels = static_cast<std::uint32_t>(seen.predicted.size());
  for (const VoxelIndex v : seen.voxels) {
    if (!scene.object_bounds_m.contains(grid.geometry().center_m(grid.geometry().key_at(v)))) {
      continue;
    }
    s.entropy_nat += static_cast<double>(grid.entropy_nat(v));
    s.free_voxels += grid.state(v) == VoxelState::free ? 1 : 0;
    s.unknown_voxels += grid.state(v) == VoxelState::unknown ? 1 : 0;
    if (grid.is_shaded(v)) {
      s.proximity_sum += scene.shadow.steps_max() - scene.shadow.steps_behind(v);
    }
    if (grid.state(v) != VoxelState::occupied) continue;
    ++s.occupied_voxels;
    const double density = scene.cloud.density(v);
    s.density_sum += density;
    s.sparse_voxels += density > 0.0 && density < options.sparse_below ? 1 : 0;
  }
  return s;
}

class EvaluateView : public AtSimdLevel {
 protected:
  ViewStats look(const ViewPose& pose, const ViewOptions& options) {
    return evaluate_view(scene_.grid, scene_.cloud, rays_, pose, marks_, options);
  }
  ViewOptions full() const {
    return {.detail = ViewDetail::rays, .sparse_below = 1.5, .shadow = &scene_.shadow};
  }

  RandomScene scene_;
  std::vector<CameraModel> cameras_ = {
      make_camera_model({.range_max_m = 4.0, .pitch_rad = 0.3}),
      make_camera_model({.range_max_m = 3.0, .p_body_m = Vec3(0.1, 0, -0.1), .pitch_rad = -0.3})};
  ViewRays rays_ = make_view_rays(cameras_, 0.2);
  VisitMarks marks_{scene_.grid.geometry().voxel_count()};
};

TEST_P(EvaluateView, EqualsBruteForceInEveryNumberAndCountsNothingOutsideTheObjectBounds) {
  const RandomScene bounded(Box3(Vec3(-3.0, -4.0, 0.5), Vec3(4.0, 2.1, 3.0)));
  ViewStats least{};  // that every number was put to the test
  std::vector<double> largest(numbers(least).size(), 0.0);
  for (std::uint64_t i = 0; i < 40; ++i) {
    const RandomScene& scene = i < 20 ? scene_ : bounded;
    for (const bool legacy : {false, true}) {
      ViewOptions options = full();
      options.legacy_visibility = legacy;
      options.shadow = &scene.shadow;
      const ViewPose pose = RandomScene::pose(i % 20);
      const auto fast =
          numbers(evaluate_view(scene.grid, scene.cloud, rays_, pose, marks_, options));
      const auto slow = numbers(brute_force(scene, rays_, pose, options));
      for (std::size_t n = 0; n < slow.size(); ++n) {
        const bool is_count = slow[n].second == std::floor(slow[n].second);
        // float32 along a ray, and a rounding to 2^-25 for each
        const double rounding = 0x1p-25 * static_cast<double>(rays_.count());
        const double tolerance = is_count ? 1e-6 : 1e-5 * slow[n].second + rounding;
        EXPECT_NEAR(fast[n].second, slow[n].second, tolerance) << slow[n].first << " " << i;
        largest[n] = std::max(largest[n], slow[n].second);
      }
    }
  }
  for (std::size_t n = 0; n < largest.size(); ++n) {
    EXPECT_GT(largest[n], 0.0) << numbers(least)[n].first;
  }
}

TEST_P(EvaluateView, CheapDetailAgreesWithTheFullOneAndNoViewLeavesATraceInTheMarks) {
  const auto first = numbers(look(RandomScene::pose(0), full()));
  ViewOptions cheap = full();
  cheap.detail = ViewDetail::voxels;
  for (std::uint64_t i = 0; i < 10; ++i) {
    const ViewStats full_stats = look(RandomScene::pose(i), full());
    const ViewStats stats = look(RandomScene::pose(i), cheap);
    EXPECT_EQ(stats.unknown_voxels, full_stats.unknown_voxels);
    EXPECT_EQ(stats.entropy_nat, full_stats.entropy_nat);
    EXPECT_EQ(stats.entropy_per_ray_nat, full_stats.entropy_per_ray_nat);
    EXPECT_EQ(stats.predicted_voxels, full_stats.predicted_voxels);
    EXPECT_EQ(stats.rays, 0U);
    look(RandomScene::pose(i), {});
  }
  EXPECT_EQ(numbers(look(RandomScene::pose(0), full())), first);
  const std::size_t voxels = scene_.grid.geometry().voxel_count();
  for (std::size_t v = 0; v < voxels; ++v) ASSERT_EQ(marks_.marks[v], 0) << v;
}

TEST_P(EvaluateView, CountsTheVoxelsOfTheExactWalkFromPosesOnTheLatticeToo) {
  // rays along the axes and diagonals, cameras on borders: every tie there is
  std::int64_t difference = 0;
  std::int64_t voxels = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const auto on_lattice = [&](std::uint64_t at, int steps) {
      return 0.2 * std::floor(scene_draw(at, i) * steps);
    };
    const ViewPose pose = {
        Vec3(on_lattice(60, 40) - 4, on_lattice(61, 40) - 4, on_lattice(62, 20) + 0.4),
        kPi / 4 * std::floor(scene_draw(63, i) * 8)};
    const ViewStats fast = look(pose, {});
    const ViewCounts exact = exact_view_counts(scene_.grid, rays_, pose);
    difference += std::abs(exact.free - fast.free_voxels) +
                  std::abs(exact.unknown - fast.unknown_voxels) +
                  std::abs(exact.occupied - fast.occupied_voxels);
    voxels += exact.free + exact.unknown + exact.occupied;
  }
  EXPECT_GT(voxels, 100000);
  EXPECT_LE(static_cast<double>(difference), 1e-4 * static_cast<double>(voxels));
}

TEST(RaysThatEndOnABorder, StopWhereTheExactWalkStops) {
  Corridor corridor(16);
  for (int steps = 1; steps <= 28; ++steps) {
    const ViewRays rays = Corridor::one_ray(0.1 * steps);
    for (const ViewPose& pose :
         {ViewPose{Vec3(0.1, 0.1, 0.1), 0.0}, ViewPose{Vec3(3.1, 0.1, 0.1), kPi},
          ViewPose{Vec3(0.2, 0.1, 0.1), 0.0}, ViewPose{Vec3(3.0, 0.1, 0.1), kPi}}) {
      const ViewStats fast =
          evaluate_view(corridor.grid, corridor.cloud, rays, pose, corridor.marks);
      EXPECT_EQ(fast.unknown_voxels, exact_view_counts(corridor.grid, rays, pose).unknown)
          << steps << " from " << pose.p_world_m.x();
    }
  }
}

TEST_P(EvaluateView, SeesWhatThePapersWaySees) {
  const PaperViewTwin twin(scene_.grid);
  for (std::uint64_t i = 0; i < 5; ++i) {
    const ViewStats ours = look(RandomScene::pose(i), {});
    const ViewCounts theirs = twin.evaluate(rays_, RandomScene::pose(i));
    // rays listed towards the centre of the voxel they hit clip other neighbours
    EXPECT_NEAR(static_cast<double>(theirs.free), ours.free_voxels, 0.05 * ours.free_voxels);
    EXPECT_NEAR(static_cast<double>(theirs.unknown), ours.unknown_voxels,
                0.05 * ours.unknown_voxels);
    EXPECT_NEAR(static_cast<double>(theirs.occupied), ours.occupied_voxels,
                0.15 * ours.occupied_voxels);
  }
}

GNBV_AT_EVERY_SIMD_LEVEL(EvaluateView);

TEST(ViewRays, AreTheLatticeOfTheReleasedCode) {
  const CameraModel camera = make_camera_model({});
  const ViewRays rays = make_view_rays({&camera, 1}, 0.2);
  EXPECT_EQ(rays.count(), 47U * 34U);
  std::set<std::pair<double, double>> ends;
  for (std::size_t i = 0; i < rays.count(); ++i) {
    EXPECT_NEAR(rays.end_body_m[0][i], 8.0, 1e-12);  // the plane at maximum range
    EXPECT_LE(std::fabs(rays.end_body_m[1][i]), 8 * std::tan(deg_to_rad(30)) + 1e-12);
    EXPECT_LE(std::fabs(rays.end_body_m[2][i]), 8 * std::tan(deg_to_rad(22.5)) + 1e-12);
    ends.emplace(rays.end_body_m[1][i], rays.end_body_m[2][i]);
  }
  EXPECT_EQ(ends.size(), rays.count());
  // the pyramids of all rays fill the camera's, but for the rim the lattice leaves
  const double whole_m3 =
      4.0 / 3.0 * std::tan(deg_to_rad(30)) * std::tan(deg_to_rad(22.5)) * std::pow(8.0, 3);
  EXPECT_NEAR(static_cast<double>(rays.count()) * rays.cameras[0].pyramid_m3, whole_m3,
              0.05 * whole_m3);
}

TEST(EvaluateViewFromTheWorkspacesFaces, SeesInside) {
  const OccupancyGrid grid(OccupancyConfig{}, Box3(Vec3(-5, -5, 0), Vec3(5, 5, 5)));
  const SurfaceCloud cloud(CloudConfig{}, grid.geometry());
  const CameraModel camera = make_camera_model({.range_max_m = 4.0});
  const ViewRays rays = make_view_rays({&camera, 1}, 0.2);
  VisitMarks marks(grid.geometry().voxel_count());
  for (const ViewPose& pose : {ViewPose{Vec3(5, 0, 2), kPi}, ViewPose{Vec3(-5, 0, 2), 0.0},
                               ViewPose{Vec3(0, 5, 2), -kPi / 2}, ViewPose{Vec3(0, -5, 2), kPi / 2},
                               ViewPose{Vec3(0, 0, 5), 0.0}, ViewPose{Vec3(0, 0, 0), 0.0}}) {
    EXPECT_GT(evaluate_view(grid, cloud, rays, pose, marks).unknown_voxels, 1000U)
        << pose.p_world_m.transpose();
  }
}

/// P of the first voxel is 1 - P_v of the second, an unknown one of ln 2.
TEST(VisibilityProbability, IsThatOfTheMapWithin1e5) {
  OccupancyConfig config;
  config.clamp_min = 1e-4;
  config.clamp_max = 0.9999;
  config.occupied_min = 0.9998;  // so that nearly all may be looked through
  for (const double prob_hit : {0.51, 0.6, 0.7, 0.97}) {
    config.prob_hit = prob_hit;
    for (int misses = 0; misses < 12; ++misses) {
      for (int hits = 0; hits < 6; ++hits) {
        Corridor corridor(8, config);
        for (int i = 0; i < misses; ++i) corridor.miss(0);
        for (int i = 0; i < hits; ++i) corridor.hit(0);
        if (corridor.grid.state(0) == VoxelState::occupied) continue;
        const double first_nat = static_cast<double>(corridor.grid.entropy_nat(0));
        const double seen_nat = corridor.look(0.3).occlusion_aware_nat - first_nat;
        EXPECT_NEAR(1.0 - seen_nat / std::numbers::ln2, probability(corridor.grid, 0), 1e-5)
            << prob_hit << " " << misses << " " << hits;
      }
    }
  }
}

TEST(EvaluateViewAtAFineResolution, SumsLongRaysWithoutOverflow) {
  // 700 unknown voxels of ln 2 are more than 32 bits hold
  Corridor corridor(800);
  const ViewStats stats = corridor.look(0.2 * 700);
  EXPECT_EQ(stats.unknown_voxels, 700U);
  EXPECT_NEAR(stats.entropy_per_ray_nat, 700 * std::numbers::ln2, 1e-4);
  for (VoxelIndex v = 0; v < 600; ++v) {
    for (int i = 0; i < 6; ++i) corridor.miss(v);  // clamped: no entropy
  }
  corridor.hit(699);
  const ViewStats known = corridor.look(0.2 * 750);
  EXPECT_EQ(known.crossed_by_occupied, 700U);
  const double end_nat = static_cast<double>(corridor.grid.entropy_nat(699));
  EXPECT_NEAR(known.entropy_of_occupied_nat, 99 * std::numbers::ln2 + end_nat, 1e-4);
}

}  // namespace
}  // namespace gnbv
