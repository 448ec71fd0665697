#include "planner/map/frame_insertion.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "bench/reference/analytic_scans.hpp"
#include "bench/reference/octomap_twin.hpp"
#include "planner/map/ray_walk.hpp"
#include "planner/map/scan_insertion.hpp"
#include "planner/planners.hpp"
#include "tests/planner/map/frames.hpp"
#include "tests/support/at_simd_level.hpp"

namespace gnbv {
namespace {

constexpr double kFloor_m = 0.3;
const Box3 kBox_m(Vec3(-6, -5, 0), Vec3(6.1, 5, 6));

/// Octomap's rule ray by ray, with its own ray keys.
ScanUpdate expected_update(const GridGeometry& grid, const OctomapTwin& twin,
                           const DepthFrame& frame, const CameraModel& camera,
                           NoReturn no_return = NoReturn::free) {
  const Vec3f origin_m = frame.T_world_camera.translation().cast<float>();
  std::vector<char> is_free(grid.voxel_count(), 0);
  std::vector<char> is_occupied(grid.voxel_count(), 0);
  for (const ScanRay& ray : rays_of(frame, camera, kFloor_m, no_return)) {
    for (const Key& key : twin.ray_keys(origin_m, ray.end_world_m)) {
      if (grid.contains(key)) is_free[grid.index_of(key)] = 1;
    }
    const Key end = grid.key_of(ray.end_world_m);
    if (ray.hit && grid.contains(end)) is_occupied[grid.index_of(end)] = 1;
  }
  ScanUpdate update;
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    if (is_occupied[v] != 0) {
      update.occupied.push_back(v);
    } else if (is_free[v] != 0) {
      update.free.push_back(v);
    }
  }
  return update;
}

/// The first voxel that only one of the lists has.
std::string difference(const std::vector<VoxelIndex>& ours, const std::vector<VoxelIndex>& theirs) {
  const auto [mine, other] = std::ranges::mismatch(ours, theirs);
  if (mine == ours.end() && other == theirs.end()) return "";
  const bool is_extra = other == theirs.end() || (mine != ours.end() && *mine < *other);
  return is_extra ? fmt::format("voxel {} too much", *mine)
                  : fmt::format("voxel {} missing", *other);
}

class FrameInsertion : public AtSimdLevel {
 protected:
  /// On some numbers of threads, with memory used before.
  void expect_equal(const DepthFrame& frame, const CameraModel& camera, const char* what,
                    NoReturn no_return = NoReturn::free) {
    const ScanUpdate expected = expected_update(grid_, twin_, frame, camera, no_return);
    touched_ += expected.free.size() + expected.occupied.size();
    FrameRays rays;
    const auto expect = [&](const ScanUpdate& update, int threads) {
      ASSERT_EQ(difference(update.free, expected.free), "")
          << what << ", " << threads << " threads";
      ASSERT_EQ(difference(update.occupied, expected.occupied), "")
          << what << ", " << threads << " threads";
    };
    const bool is_projected = can_project(grid_, frame, camera);
    compute_frame_rays(frame, camera, kFloor_m, rays, no_return);
    for (const int threads : {1, 2, 5}) {
      if (is_projected) expect(frames_.compute_update(rays, frame, camera, map_, threads), threads);
    }
    expect(inserter_.compute_update(rays, frame, camera, map_, 2), 2);
  }
  void use_resolution(double resolution_m) {
    config_.resolution_m = resolution_m;
    map_ = OccupancyGrid(config_, kBox_m);
    grid_ = map_.geometry();
    inserter_ = ScanInserter(grid_);
    frames_ = FrameInserter(grid_);
    twin_ = OctomapTwin(config_);
  }

  OccupancyConfig config_;
  OccupancyGrid map_ = OccupancyGrid(config_, kBox_m);  // nothing is settled there
  GridGeometry grid_ = map_.geometry();
  ScanInserter inserter_ = ScanInserter(grid_);
  FrameInserter frames_ = FrameInserter(grid_);
  OctomapTwin twin_ = OctomapTwin(config_);
  std::size_t touched_ = 0;
};

const std::vector<CameraModel>& cameras() {
  static const std::vector<CameraModel> all = {
      camera_of(160, 120, 60.0, 45.0), camera_of(96, 64, 90.0, 60.0),
      camera_of(101, 33, 60.0, 45.0),  camera_of(16, 12, 60.0, 45.0),
      camera_of(5, 3, 90.0, 60.0),     camera_of(1, 1, 60.0, 45.0)};
  return all;
}

TEST_P(FrameInsertion, EqualsOctomapForScenesPlanesAndNoiseSeenFromAnyPose) {
  const AnalyticScene scene = {.spheres = {{Vec3(0.5, 0.2, 2.0), 1.5}, {Vec3(-3.0, 3.0, 1.0), 1.0}},
                               .ground_z_m = 0.0,
                               .wall_x_m = 5.0};
  for (const double resolution_m : {0.2, 0.07, 0.05}) {
    use_resolution(resolution_m);
    Random random(41);
    for (int view = 0; view < (resolution_m < 0.1 ? 1 : 10); ++view) {
      for (const CameraModel& camera : cameras()) {
        const ViewPose pose = {random.point_in(kBox_m).cast<double>(), random.uniform(-kPi, kPi)};
        expect_equal(analytic_depth(scene, camera, T_world_body(pose)), camera, "scene");
        DepthFrame frame;
        frame.T_world_camera = random_pose(random, kBox_m);
        frame.depth_m = plane_depths(camera, random.uniform(0.3, 8.5), random.uniform(-1.5, 1.5));
        expect_equal(frame, camera, "plane");
        for (float& d_m : frame.depth_m) {
          if (random.chance(0.5)) d_m = kInvalidRange;
        }
        expect_equal(frame, camera, "half a plane");
        frame.depth_m = noise_depths(random, camera);
        expect_equal(frame, camera, "noise");
        expect_equal(frame, camera, "noise, no return unknown", NoReturn::unknown);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(touched_, 100000U);
}

TEST_P(FrameInsertion, EqualsOctomapWhereEverythingLiesOnVoxelBorders) {
  const std::array<Vec3, 4> directions = {Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ(),
                                          Vec3(1, 1, 0).normalized()};
  for (const double resolution_m : {0.2, 0.1, 0.25}) {
    use_resolution(resolution_m);
    Random random(47);
    for (const CameraModel& camera : cameras()) {
      for (const Vec3& forward : directions) {
        const Vec3 right = forward.cross(Vec3(-forward.y(), forward.z(), forward.x() + 0.5));
        DepthFrame frame;
        Eigen::Matrix3d R;
        R.col(2) = forward;
        R.col(0) = right.normalized();
        if (forward.z() == 0.0) R.col(0) = forward.cross(Vec3::UnitZ());
        R.col(1) = forward.cross(R.col(0));
        frame.T_world_camera.linear() = R;
        frame.T_world_camera.translation() = Vec3(-1.0, 0.4, 2.0);
        frame.depth_m = plane_depths(camera, 3.0, 0.0);
        expect_equal(frame, camera, "a border");
        frame.depth_m.assign(frame.depth_m.size(), kNoReturn);
        expect_equal(frame, camera, "nothing");
        for (float& d_m : frame.depth_m) {
          d_m = static_cast<float>(std::round(random.uniform(1.0, 20.0)) * 0.2);
        }
        expect_equal(frame, camera, "borders");
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST_P(FrameInsertion, EqualsOctomapForCamerasAtTheBorderAndOutside) {
  Random random(53);
  const CameraModel& camera = cameras()[1];
  const std::array<Vec3, 6> positions = {Vec3(-6.0, 0.0, 2.0), Vec3(-5.99995, 0.0, 2.0),
                                         Vec3(-6.5, 0.1, 2.0), Vec3(6.19999, 4.99999, 5.99999),
                                         Vec3(0.0, 0.0, 0.0),  Vec3(1.0, 1.0, 7.0)};
  for (const Vec3& position_m : positions) {
    for (int view = 0; view < 12; ++view) {
      DepthFrame frame;
      frame.T_world_camera = random_pose(random, kBox_m);
      frame.T_world_camera.translation() = position_m;
      frame.depth_m = view % 2 == 0 ? noise_depths(random, camera)
                                    : plane_depths(camera, random.uniform(0.3, 8.5), 0.2);
      expect_equal(frame, camera, "border");
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(touched_, 10000U);
}

/// A camera on an edge of its voxel, as far as float32 can tell, whose rays leave by both faces of
/// that edge at once: which comes first is decided by OctoMap's distances of nanometres.
TEST_P(FrameInsertion, EqualsOctomapForCamerasOnAnEdgeWhoseRaysLeaveByBothFaces) {
  Random random(61);
  const std::vector<CameraModel> narrow = {camera_of(1, 1, 0.1, 0.1), camera_of(5, 3, 0.1, 0.1),
                                           camera_of(20, 1, 90.0, 0.1)};
  for (int view = 0; view < 100; ++view) {
    for (const CameraModel& camera : narrow) {
      const std::array<double, 3> on_border_m = {1.0, 0.4, 0.6};
      const Vec3 position_m(on_border_m[static_cast<std::size_t>(view % 3)],
                            on_border_m[static_cast<std::size_t>(view / 3 % 3)], 2.13);
      const RayOrigin origin = make_ray_origin(grid_, position_m.cast<float>());
      ASSERT_LT(origin.to_lower_border_m[0], 0.0);
      ASSERT_LT(origin.to_lower_border_m[1], 0.0);
      const double yaw_rad = std::atan2(origin.to_lower_border_m[1], origin.to_lower_border_m[0]) +
                             random.uniform(-1e-3, 1e-3);
      DepthFrame frame;
      frame.T_world_camera = T_world_body({position_m, yaw_rad}) * camera.T_body_camera;
      frame.depth_m.assign(
          static_cast<std::size_t>(camera.config.width_px * camera.config.height_px), 3.0F);
      expect_equal(frame, camera, "edge");
      if (HasFatalFailure()) return;
    }
  }
}

TEST_P(FrameInsertion, AFullFrameEqualsOctomapAndWalksFewRays) {
  const CameraModel camera = camera_of(640, 480, 60.0, 45.0);
  const AnalyticScene scene = {
      .spheres = {{Vec3(0.5, 0.2, 2.0), 1.5}}, .ground_z_m = 0.0, .wall_x_m = 5.0};
  const DepthFrame frame =
      analytic_depth(scene, camera, T_world_body({Vec3(-5.13, 0.31, 2.43), 0.1}));
  expect_equal(frame, camera, "full");
  FrameRays rays;
  compute_frame_rays(frame, camera, kFloor_m, rays);
  FrameInserter frames(grid_);
  ASSERT_TRUE(can_project(grid_, frame, camera));
  frames.compute_update(rays, frame, camera, map_, 1);
  EXPECT_LT(frames.walked_count(), 3072U);  // a hundredth of them
}

TEST_P(FrameInsertion, LeavesOutSettledVoxelsAloneAndTheMapIsOctomapsAllTheSame) {
  const CameraModel camera = camera_of(160, 120, 60.0, 45.0);
  // what stands there comes and goes, so that settled space is hit again
  const AnalyticScene scenes[2] = {{.spheres = {{Vec3(0.5, 0.2, 2.0), 1.5}}, .wall_x_m = 5.0},
                                   {.spheres = {{Vec3(-2.0, 0.5, 2.0), 1.0}}, .wall_x_m = 5.0}};
  FrameRays rays;
  std::size_t left_out = 0;
  for (int view = 0; view < 40; ++view) {
    const ViewPose pose = {Vec3(-5.13, 0.31 + 0.1 * (view % 5), 2.43), 0.1};
    const DepthFrame frame = analytic_depth(scenes[view / 10 % 2], camera, T_world_body(pose));
    compute_frame_rays(frame, camera, kFloor_m, rays);
    const ScanUpdate expected = expected_update(grid_, twin_, frame, camera);
    const ScanUpdate update = frames_.compute_update(rays, frame, camera, map_, 2);
    EXPECT_EQ(difference(update.occupied, expected.occupied), "");
    std::vector<VoxelIndex> missing;
    std::ranges::set_difference(expected.free, update.free, std::back_inserter(missing));
    for (const VoxelIndex v : missing) EXPECT_EQ(map_.words()[v], map_.settled_word()) << v;
    EXPECT_EQ(update.free.size() + missing.size(), expected.free.size());
    left_out += missing.size();
    map_.apply(update);
    twin_.insert(rays.origin_world_m, rays_of(frame, camera, kFloor_m));
  }
  EXPECT_GT(left_out, 10'000U);
  for (VoxelIndex v = 0; v < grid_.voxel_count(); ++v) {
    EXPECT_EQ(map_.log_odds(v), twin_.log_odds(grid_.key_at(v)).value_or(0.0F)) << v;
  }
}

TEST_P(FrameInsertion, FramesThatCannotBeProjectedEqualOctomapToo) {
  Random random(59);
  DepthFrame frame;
  frame.T_world_camera = random_pose(random, Box3(Vec3(-1, -1, 2), Vec3(1, 1, 3)));
  CameraModel camera = cameras()[1];
  frame.depth_m = noise_depths(random, camera);
  EXPECT_TRUE(can_project(grid_, frame, camera));
  camera.config.range_min_m = 0.0;
  EXPECT_FALSE(can_project(grid_, frame, camera));
  expect_equal(frame, camera, "no minimum range");
  camera.config.range_min_m = 0.3;
  frame.T_world_camera.linear() *= 1.01;
  EXPECT_FALSE(can_project(grid_, frame, camera));
  expect_equal(frame, camera, "no rotation");
}

GNBV_AT_EVERY_SIMD_LEVEL(FrameInsertion);

/// A ball, whose returns count, before a wall that is too deep for any.
constexpr double kReturnMax_m = 5.0;
const AnalyticScene kDeepWall = {
    .spheres = {{Vec3(-1.0, 0.0, 2.0), 0.7}}, .ground_z_m = -50.0, .wall_x_m = 2.05};

/// What a voxel is after one frame, walked in steps of a millimetre; -1: met by no step.
std::vector<int> walked_states(const GridGeometry& grid, const DepthFrame& frame,
                               const CameraModel& camera, NoReturn no_return) {
  std::vector<int> states(grid.voxel_count(), -1);
  const auto mark = [&](const Key& key, VoxelState state) {
    if (!grid.contains(key)) return;
    int& is = states[grid.index_of(key)];
    is = std::max(is, static_cast<int>(state));  // what is hit is not freed
  };
  const auto is_within = [&](const Vec3& p_m, const Key& key) {  // by more than floats round
    return (p_m - grid.center_m(key)).cwiseAbs().maxCoeff() < 0.5 * grid.resolution_m() - 1e-4;
  };
  const Vec3 eye_m = frame.T_world_camera.translation();
  for (int v = 0; v < camera.config.height_px; ++v) {
    for (int u = 0; u < camera.config.width_px; ++u) {
      const Vec3 direction = frame.T_world_camera.linear() * camera.ray_camera(u, v).cast<double>();
      const double depth_m = first_hit(kDeepWall, eye_m, direction);
      const bool returns = depth_m <= kReturnMax_m;
      if (!returns && no_return == NoReturn::unknown) continue;
      const double end_m = returns ? depth_m : camera.config.range_max_m;
      const Key end = grid.key_of(Vec3f((eye_m + end_m * direction).cast<float>()));
      for (double z_m = 0.0; z_m < end_m; z_m += 1e-3 / direction.norm()) {
        const Vec3 p_m = eye_m + z_m * direction;
        const Key key = grid.key_of(Vec3f(p_m.cast<float>()));
        if (key != end && is_within(p_m, key)) mark(key, VoxelState::free);
      }
      if (returns) mark(end, VoxelState::occupied);
    }
  }
  return states;
}

TEST(NoReturn, FreeClearsThroughADeepWallUnknownLeavesItAsAWalkOfEachRaySays) {
  CameraModel camera = camera_of(61, 47, 40.0, 30.0);
  camera.config.return_max_m = kReturnMax_m;
  const DepthFrame frame =
      analytic_depth(kDeepWall, camera, T_world_body({Vec3(-5.13, 0.02, 2.03), 0.0}));
  for (const NoReturn no_return : {NoReturn::free, NoReturn::unknown}) {
    PlannerConfig config;
    config.map.no_return = no_return;
    const PlannerModel model = make_model(config, kBox_m, {&camera.config, 1}, {});
    Scratch scratch(model, 2);
    Belief belief(model);
    integrate_view(model, {&frame, 1}, scratch, belief);
    const GridGeometry& grid = belief.grid.geometry();
    const std::vector<int> walked = walked_states(grid, frame, camera, no_return);
    std::size_t grazed = 0;  // for less than a step
    for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
      const auto is = static_cast<int>(belief.grid.state(v));
      if (walked[v] >= 0) {
        ASSERT_EQ(is, walked[v]) << v;
      }
      grazed += walked[v] < 0 && is != 0 ? 1 : 0;
    }
    EXPECT_LE(grazed, grid.voxel_count() / 1000);
    const auto state_at = [&](double x_m, double y_m) {
      return belief.grid.state(
          grid.index_of(grid.key_of(Vec3f(Vec3(x_m, y_m, 2.1).cast<float>()))));
    };
    EXPECT_EQ(state_at(-1.65, 0.1), VoxelState::occupied) << "the ball";
    EXPECT_EQ(state_at(-0.5, 0.1), VoxelState::unknown) << "behind it";
    const VoxelState beside = no_return == NoReturn::free ? VoxelState::free : VoxelState::unknown;
    for (const double x_m : {0.1, 1.9, 2.1, 2.3, 2.7}) EXPECT_EQ(state_at(x_m, 1.7), beside) << x_m;
    EXPECT_EQ(state_at(3.1, 1.7), VoxelState::unknown) << "beyond range_max_m";
  }
}

}  // namespace
}  // namespace gnbv
