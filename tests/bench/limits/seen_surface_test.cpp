#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "bench/limits/ceiling.hpp"
#include "bench/limits/cloud_of_views.hpp"
#include "bench/limits/free_yaw_camera.hpp"
#include "bench/limits/lidar_sight.hpp"
#include "bench/limits/sight_search.hpp"
#include "sim/core/rng.hpp"
#include "tests/bench/limits/limits_setting.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/flown.hpp"

namespace gnbv {
namespace {

CameraModel camera(double pitch_rad, const Vec3& p_body_m = Vec3::Zero()) {
  CameraConfig config;
  config.pitch_rad = pitch_rad;
  config.p_body_m = p_body_m;
  config.range_max_m = 5.0;
  return make_camera_model(config);
}

/// The nodes of a lattice from `corner` on, all legal and connected.
LegalViewpoints lattice_of(const Vec3& corner, double step_m, const std::array<int, 3>& nodes) {
  LegalViewpoints legal{.step_m = step_m, .start_world_m = corner};
  for (int z = 0; z < nodes[2]; ++z) {
    for (int y = 0; y < nodes[1]; ++y) {
      for (int x = 0; x < nodes[0]; ++x) {
        legal.p_world_m.push_back(corner + step_m * Vec3(x, y, z));
        legal.cell.push_back({x, y, z});
        legal.neighbours.emplace_back();
      }
    }
  }
  return legal;
}

/// A wall of 2 x 2 m at x = 2, and the same behind it at x = 2.5.
TriangleMesh two_walls() {
  TriangleMesh mesh;
  for (const double x : {2.025, 2.525}) {
    test::add_sheet(mesh, Vec3(x, -1.0, 1.0), Vec3(0, 2, 0), Vec3(0, 0, 2));
  }
  return mesh;
}

struct Sight {
  Sight(const TriangleMesh& mesh, const LegalViewpoints& positions, double pitch_rad)
      : Sight(World{mesh, true}, positions, pitch_rad) {}
  Sight(World made, const LegalViewpoints& positions, double pitch_rad)
      : world(std::move(made)),
        scene(world),
        legal(positions),
        cameras{camera(pitch_rad)},
        search(scene, cameras, legal, Box3(Vec3(-9, -9, 0), Vec3(9, 9, 9)), 0.2) {}

  bool from_lattice(const Vec3& point_m, SightSearch::Positions which) const {
    const std::vector<Vec3f> points = {point_m.cast<float>()};
    std::vector<SightItem> items = {{.points_world_m = points}};
    const Eigen::AlignedBox3d box_m(point_m);
    search.look_from_lattice(search.positions_near(box_m), which, items);
    return items[0].is_seen();
  }

  World world;
  RayScene scene;
  LegalViewpoints legal;
  std::vector<CameraModel> cameras;
  SightSearch search;
};

constexpr auto kFew = SightSearch::Positions::first_few;

TEST(SightSearch, SeesTheNearerOfTwoWalls) {
  const Sight sight(two_walls(), lattice_of(Vec3(-1, 0, 2), 1.0, {1, 1, 1}), 0.0);
  for (double y = -0.9; y < 1.0; y += 0.3) {
    EXPECT_TRUE(sight.from_lattice(Vec3(2.025, y, 2.1), kFew)) << y;
    EXPECT_FALSE(sight.from_lattice(Vec3(2.525, y, 2.1), kFew)) << y;
    EXPECT_NE(sight.search.look_out(Vec3f(2.525F, static_cast<float>(y), 2.1F), 0),
              SightSearch::Look::seen);
  }
}

TEST(SightSearch, AGimbalSeesWhatSomePitchOfItDoes) {
  CameraConfig config = camera(0.0).config;
  config.gimbal = GimbalConfig{.min_rad = -0.6, .max_rad = 0.6, .step_rad = 0.6};
  const std::vector<CameraModel> on_gimbal = {make_camera_model(config)};
  const LegalViewpoints one = lattice_of(Vec3(1.025, 0, 2), 1.0, {1, 1, 1});
  Sight any(two_walls(), one, 0.0);
  const SightSearch gimbal(any.scene, on_gimbal, any.legal, Box3(Vec3(-9, -9, 0), Vec3(9, 9, 9)),
                           0.2);
  int of_one_pitch = 0;
  for (double z = 1.05; z < 3.0; z += 0.1) {
    const Vec3 point_m(2.025, 0.1, z);
    const std::vector<Vec3f> points = {point_m.cast<float>()};
    std::vector<SightItem> items = {{.points_world_m = points}};
    gimbal.look_from_lattice(gimbal.positions_near(Eigen::AlignedBox3d(point_m)), kFew, items);
    int pitches = 0;
    for (const double pitch_rad : {-0.6, 0.0, 0.6}) {
      pitches += Sight(two_walls(), one, pitch_rad).from_lattice(point_m, kFew) ? 1 : 0;
    }
    EXPECT_EQ(items[0].is_seen(), pitches > 0) << z;
    of_one_pitch += pitches == 1 ? 1 : 0;
  }
  EXPECT_GT(of_one_pitch, 5);
}

TEST(SightSearch, AllPositionsTogetherSeeWhatEachDoes) {
  TriangleMesh mesh = two_walls();
  test::add_box(mesh, Vec3(0.3, -2.2, 0.6), Vec3(0.7, 0.8, 1.9));
  const LegalViewpoints many = lattice_of(Vec3(-3, -3, 0.5), 0.9, {7, 8, 4});
  ASSERT_GT(many.size(), 200U);
  const Sight all(mesh, many, 0.35);
  std::deque<Sight> each;
  for (const Vec3& p : many.p_world_m) each.emplace_back(mesh, lattice_of(p, 1.0, {1, 1, 1}), 0.35);
  int seen = 0;
  for (double z = 1.1; z < 3.0; z += 0.4) {
    for (double y = -0.9; y < 1.0; y += 0.4) {
      for (const double x : {2.025, 2.525}) {
        const Vec3 point_m(x, y, z);
        const bool any = std::any_of(each.begin(), each.end(), [&](const Sight& one) {
          return one.from_lattice(point_m, kFew);
        });
        EXPECT_EQ(all.from_lattice(point_m, kFew) ||
                      all.from_lattice(point_m, SightSearch::Positions::others),
                  any);
        seen += any ? 1 : 0;
      }
    }
  }
  EXPECT_GT(seen, 10);
}

TEST(SightSearch, FindsPlacesBetweenThePositionsOfTheLattice) {
  // a slit of 0.1 m in a wall in front of a plate: the nodes, 2 m apart, look at it from aside
  TriangleMesh mesh;
  test::add_sheet(mesh, Vec3(3, -0.05, 1.95), Vec3(0, 0.1, 0), Vec3(0, 0, 0.1));
  for (const double y : {-4.05, 0.05}) {
    test::add_sheet(mesh, Vec3(2.5, y, 0.5), Vec3(0, 4, 0), Vec3(0, 0, 3));
  }
  const Sight sight(mesh, lattice_of(Vec3(-1, -1, 2), 2.0, {2, 2, 1}), 0.0);
  const Vec3 plate_m(3, 0, 2);
  EXPECT_FALSE(sight.from_lattice(plate_m, kFew));
  bool is_seen = false;
  for (std::size_t turn = 0; turn < SightSearch::kTurns; ++turn) {
    is_seen =
        is_seen || sight.search.look_out(plate_m.cast<float>(), turn) == SightSearch::Look::seen;
  }
  EXPECT_TRUE(is_seen);
}

TEST(SightSearch, FromAClosedBoxNothingIsOpen) {
  TriangleMesh box;
  test::add_box(box, Vec3(-1, -1, 1), Vec3(2, 2, 2));
  const Sight sight(box, lattice_of(Vec3(-4, -4, 2), 1.0, {9, 2, 2}), 0.0);
  for (std::size_t turn = 0; turn < SightSearch::kTurns; ++turn) {
    EXPECT_EQ(sight.search.look_out(Vec3f(0.3F, 0.2F, 1.5F), turn), SightSearch::Look::closed);
    EXPECT_NE(sight.search.look_out(Vec3f(-1.2F, 0.2F, 1.5F), turn), SightSearch::Look::closed);
  }
}

/// A wall of 2 x 2 m at x = 2 and a lower fence of 1.2 m before it, which is nothing, an obstacle
/// or terrain.
enum class Fence { none, obstacle, terrain };
World walled(Fence fence) {
  World world;
  test::add_sheet(world.structure, Vec3(2, -1, 1), Vec3(0, 2, 0), Vec3(0, 0, 2));
  TriangleMesh mesh;
  test::add_sheet(mesh, Vec3(1.5, -9, 0), Vec3(0, 18, 0), Vec3(0, 0, 2));
  if (fence == Fence::obstacle) world.obstacles = mesh;
  if (fence == Fence::terrain) world.terrain = mesh;
  return world;
}

TEST(SightSearch, NobodySeesTheWallThroughAFence) {
  for (const Fence fence : {Fence::none, Fence::obstacle, Fence::terrain}) {
    // before the fence, at the height of the low point and of the high one
    const Sight sight(walled(fence), lattice_of(Vec3(-1, 0.1, 1.4), 1.2, {1, 1, 2}), 0.0);
    EXPECT_TRUE(sight.from_lattice(Vec3(2, 0.1, 2.6), kFew));
    EXPECT_EQ(sight.from_lattice(Vec3(2, 0.1, 1.4), kFew), fence == Fence::none);
  }
}

/// Whether the point is in the image and range from there; `slack` widens both.
bool is_in_image(const CameraModel& model, const ViewPose& view, const Vec3& point_m,
                 double slack) {
  const CameraConfig& c = model.config;
  const Vec3 p = (T_world_body(view) * model.T_body_camera).inverse() * point_m;
  return p.z() >= c.range_min_m - slack && p.z() <= c.range_max_m + slack &&
         std::abs(p.x()) <= p.z() * std::tan(0.5 * c.fov_x_rad) + slack &&
         std::abs(p.y()) <= p.z() * std::tan(0.5 * c.fov_y_rad) + slack;
}

Vec3 random_point(std::uint64_t index) {
  const auto u = [&](std::uint64_t axis) {
    return 12.0 * uniform01({9, Stream::bench, index, axis}) - 6.0;
  };
  return {u(0), u(1), u(2)};
}

TEST(FreeYawCamera, HasInItsImageWhatSomeYawHas) {
  // the brute force: every tenth of a degree. The bearings tried leave out slivers between them.
  constexpr double kSliver_m = 0.12;
  for (const double pitch_rad : {0.0, 0.35, -0.8}) {
    const CameraModel model = camera(pitch_rad, Vec3(0.1, 0.0, -0.2));
    const FreeYawCamera free_yaw(model);
    int found = 0;
    int missed = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const Vec3 vehicle_m(0.5, -0.3, 0.2);
      const Vec3 point_m = random_point(i);
      bool some_yaw = false;
      bool some_yaw_easily = false;
      for (int k = 0; k < 3600; ++k) {
        const ViewPose view{vehicle_m, 2.0 * kPi * k / 3600.0};
        some_yaw = some_yaw || is_in_image(model, view, point_m, 0.02);
        some_yaw_easily = some_yaw_easily || is_in_image(model, view, point_m, -kSliver_m);
      }
      const auto origin_m = free_yaw.origin_world_m(vehicle_m, point_m);
      EXPECT_TRUE(!origin_m || some_yaw) << i;
      missed += !origin_m && some_yaw_easily ? 1 : 0;
      if (!origin_m) continue;
      ++found;
      EXPECT_NEAR((*origin_m - vehicle_m).norm(), model.config.p_body_m.norm(), 1e-9);
      EXPECT_LE((point_m - vehicle_m).norm(), free_yaw.reach_m());
    }
    EXPECT_GT(found, 30);
    EXPECT_LE(missed, 1) << found;
  }
}

Scenario noise_free(const std::string& name, const std::string& utility, int views) {
  Scenario scenario =
      load_scenario(name, {"planner.utility.name=" + utility, "vehicle.estimate.model=none",
                           "planner.termination.max_iterations=" + std::to_string(views)});
  for (CameraConfig& camera : scenario.cameras) camera.noise.model = DepthNoise::none;
  for (LidarConfig& lidar : scenario.lidars) lidar.range_sigma_m = 0.0;
  return scenario;
}

TEST(SeenSurface, IsNoLessThanWhatNoiseFreeMissionsCover) {
  constexpr double kOneOfVoxel_m = 0.05;
  constexpr double kBeyondVoxels_m = 0.04;
  for (const auto& [name, utility, views, leaf_m] :
       {std::tuple("smoke", "bircher", 12, kOneOfVoxel_m),
        std::tuple("smoke", "proposed", 60, kBeyondVoxels_m),
        std::tuple("lab_model", "isler", 15, 0.02),
        std::tuple("lab_airplane", "bircher", 15, 0.02)}) {
    Scenario scenario = noise_free(name, utility, views);
    scenario.planner.cloud.leaf_m = leaf_m;
    if (leaf_m == kBeyondVoxels_m) {  // enough pixels and views to fill the leaves
      scenario.cameras[0].width_px = 640;
      scenario.cameras[0].height_px = 480;
    }
    const LimitsSetting m(scenario);
    const SeenSurface seen = m.seen();
    const Ceiling ceiling = find_ceiling(scenario, m.world, m.scene, m.start, 2);
    const Flown flown(scenario);
    const auto cloud = flown.result.belief.cloud.points_world_m();
    const auto covered = coverage_at_all_sizes(m.reference.counted, cloud);
    for (std::size_t size = 0; size < 3; ++size) {
      EXPECT_LE(covered[size], ceiling.counted[size]) << name << " " << size;
      EXPECT_LE(covered[size], ceiling.leaf_counted[size]) << name << " " << size;
    }
    // and voxel by voxel, but for the few where the leaf's centroid lies beside the surface
    const VoxelSet voxels = voxels_of(cloud, kCoverageSizes_m[0]);
    std::size_t in_reference = 0;
    std::size_t unseen = 0;
    for (const std::uint64_t code : m.reference.counted[0]) {
      if (!std::binary_search(voxels.begin(), voxels.end(), code)) continue;
      ++in_reference;
      unseen += std::binary_search(seen.voxels.begin(), seen.voxels.end(), code) ? 0 : 1;
    }
    EXPECT_GT(in_reference, 1000U);
    EXPECT_LE(static_cast<double>(unseen), 0.005 * static_cast<double>(in_reference)) << name;
  }
}

TEST(SeenSurface, HasWhatViewsFromLegalPositionsShow) {
  const LimitsSetting lab(load_scenario("lab_airplane", {}));
  const auto& [scenario, warnings, world, scene, start, legal, reference] = lab;
  const SeenSurface seen = lab.seen();
  const std::vector<CameraModel> cameras = exact_cameras(scenario);
  const Vec3 centre_m = bounds_m(world.structure).center();
  VoxelSet shown;
  std::vector<FrameRays> rays;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const auto at = static_cast<std::size_t>(uniform01({3, Stream::bench, i, 0}) *
                                             static_cast<double>(legal.size()));
    const Vec3 to_m = centre_m - legal.p_world_m[at];
    const double yaw_rad =
        std::atan2(to_m.y(), to_m.x()) + 0.5 * uniform01({3, Stream::bench, i, 1}) - 0.25;
    take_view(scene, cameras, {legal.p_world_m[at], yaw_rad}, scenario.planner.floor_z_m, 2, rays);
    for (const std::uint32_t voxel : finds_alone(reference.counted[0], rays, 0.02)) {
      shown.push_back(reference.counted[0][voxel]);
    }
  }
  std::sort(shown.begin(), shown.end());
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  ASSERT_GT(shown.size(), 3000U);
  const auto missed = std::count_if(shown.begin(), shown.end(), [&](std::uint64_t code) {
    return !std::binary_search(seen.voxels.begin(), seen.voxels.end(), code);
  });
  EXPECT_LE(static_cast<double>(missed), 0.002 * static_cast<double>(shown.size()));
}

TEST(SeenSurface, AVoxelKeepsAPointOfALeafThatItHasAQuarterOf) {
  setenv("GNBV_CACHE", "", 1);
  Scenario scenario = load_scenario("smoke", {});
  scenario.planner.cloud.leaf_m = 0.02;
  for (const double width_m : {0.005, 0.002}) {
    // a wall whose last bit reaches into another voxel, beyond x = 1.05, in the middle of a leaf:
    // a third of the leaf's surface, or a sixth
    World world{TriangleMesh{}, true};
    test::add_sheet(world.structure, Vec3(1.05 - width_m, 0.01, 1.0), Vec3(0.5, 0, 0),
                    Vec3(0, 0, 0.6));
    const RayScene scene(world);
    const ViewPose start = start_pose(scenario, scene);
    const LegalViewpoints legal = find_legal_viewpoints(scenario, scene, start, 2);
    const SurfaceReference reference = make_surface_reference(world, scene, {}, 2);
    const SeenSurface seen = find_seen_surface(scenario, world, scene, legal, reference, 2, {});
    const VoxelSet kept = voxels_of(seen.kept_world_m, kCoverageSizes_m[0]);
    const std::uint64_t last = voxel_code(Vec3f(1.049F, 0.01F, 1.23F), kCoverageSizes_m[0]);
    EXPECT_TRUE(std::binary_search(seen.voxels.begin(), seen.voxels.end(), last));
    EXPECT_EQ(std::binary_search(kept.begin(), kept.end(), last), width_m > 0.004) << width_m;
    EXPECT_TRUE(std::includes(seen.voxels.begin(), seen.voxels.end(), kept.begin(), kept.end()));
  }
}

TEST(Ceiling, IsMeasuredAgainstWhatItsMissionsAre) {
  Scenario scenario = noise_free("smoke", "bircher", 12);
  const Flown flown(scenario);
  const auto cloud = flown.result.belief.cloud.points_world_m();
  std::array<Ceiling, 2> ceilings;
  for (const ScoreReference reference : {ScoreReference::outside, ScoreReference::area_samples}) {
    scenario.score.reference = reference;
    const LimitsSetting m(scenario);
    Ceiling& ceiling = ceilings[reference == ScoreReference::outside ? 0 : 1];
    ceiling = find_ceiling(scenario, m.world, m.scene, m.start, 2);
    EXPECT_EQ(ceiling.area_samples, m.reference.area_samples);
    const auto covered = coverage_at_all_sizes(m.reference.counted, cloud);
    for (std::size_t size = 0; size < 3; ++size) {
      EXPECT_LE(covered[size], ceiling.leaf_counted[size]) << size;
      EXPECT_LE(ceiling.leaf_counted[size], ceiling.counted[size]) << size;
    }
    EXPECT_GT(covered[0], 0.5 * ceiling.leaf_counted[0]);
  }
  // of the inner surface, which is asked for, nothing can be had
  EXPECT_LT(ceilings[1].counted[0], ceilings[0].counted[0]);
  EXPECT_NEAR(ceilings[1].raw[0], ceilings[0].raw[0], 1e-3);
  const std::string json = ceiling_json(scenario, ceilings[1], 0.0);
  EXPECT_NE(json.find("\"leaf_area_samples\""), std::string::npos);
  EXPECT_EQ(json.find("outside"), std::string::npos);
  EXPECT_NE(ceiling_text(ceilings[1], 0.0).find("155,000 points drawn by area"), std::string::npos);
}

TEST(Ceiling, LeavesLoseNothingOfSizesThatTheyDivide) {
  for (const auto& [name, leaf_m] :
       {std::pair("smoke", 0.05), std::pair("smoke", 0.02), std::pair("lab_model", 0.02)}) {
    Scenario scenario = load_scenario(name, {});
    scenario.planner.cloud.leaf_m = leaf_m;
    const LimitsSetting m(scenario);
    const Ceiling ceiling = find_ceiling(scenario, m.world, m.scene, m.start, 2);
    EXPECT_LE(ceiling.leaf_counted[0], ceiling.counted[0]) << name;
    for (const std::size_t size : {1U, 2U}) {
      EXPECT_EQ(ceiling.leaf_counted[size], ceiling.counted[size]) << name << " " << size;
      EXPECT_EQ(ceiling.leaf_raw[size], ceiling.raw[size]) << name << " " << size;
    }
    EXPECT_LT(ceiling.raw[0], ceiling.counted[0]) << name;
  }
}

TEST(LidarSight, SeesAFaceOfTheBoxAndNeitherItsInsideNorThroughAFence) {
  Scenario scenario = load_scenario("smoke", {});
  TriangleMesh mesh;
  test::add_box(mesh, Vec3(-1, -1, 0.5), Vec3(2, 2, 2));
  test::add_box(mesh, Vec3(-0.5, -0.5, 1), Vec3(1, 1, 1));
  const World world{mesh, true};
  const RayScene scene(world);
  const LidarSight lidars(scenario, scene);
  for (const double z : {0.8, 1.5, 2.2}) {
    const auto up = static_cast<float>(z);
    EXPECT_TRUE(lidars.is_seen(Vec3f(1.0F, 0.3F, up))) << z;
    EXPECT_TRUE(lidars.is_seen(Vec3f(0.2F, -1.0F, up))) << z;
    EXPECT_FALSE(lidars.is_seen(Vec3f(0.5F, 0.1F, up))) << z;
  }
  World fenced = world;  // by an obstacle whose upper end is at 1.6 m
  test::add_box(fenced.obstacles, Vec3(-1.2, -1.2, 0), Vec3(2.4, 2.4, 1.6), false);
  const RayScene fenced_scene(fenced);
  const LidarSight over_the_fence(scenario, fenced_scene);
  EXPECT_FALSE(over_the_fence.is_seen(Vec3f(1.0F, 0.3F, 0.8F)));
  EXPECT_TRUE(over_the_fence.is_seen(Vec3f(1.0F, 0.3F, 2.2F)));
  scenario.planner.profiling.method = ProfilingMethod::none;
  EXPECT_FALSE(LidarSight(scenario, scene).is_seen(Vec3f(1.0F, 0.3F, 1.5F)));
}

}  // namespace
}  // namespace gnbv
