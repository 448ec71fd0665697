// Missions in a world that is more than a structure: the smoke one, a second or so each.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "bench/score/cloud_metrics.hpp"
#include "bench/score/content_cache.hpp"
#include "bench/score/mission_score.hpp"
#include "sim/core/error.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/known_inputs.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/mission/reference.hpp"
#include "tools/mission/resolve.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/run/run_inputs.hpp"

namespace gnbv {
namespace {

/// A screen between the start, at y = -2.8, and the structure, whose south side is at y = -0.75.
const std::string kScreen = "obstacles=[{box_m: {min: [-0.5, -1.6, 0], max: [0.5, -1.5, 1.6]}}]";
/// On the way of the profile and of views: the middle of the east face of the workspace.
const std::string kNoFlyEast = "no_fly=[{min: [2.6, -0.8, 0], max: [4.5, 0.8, 3]}]";

MissionScore score_of(const Flown& flown, const SurfaceReference& reference) {
  ScoredCloud cloud = scored_cloud(flown.scenario, flown.result);
  cloud.region_m = flown.scenario.score.region_m;
  return score_cloud(reference, flown.scene, cloud, flown.scenario.planner.map.resolution_m, 2);
}

SurfaceReference reference_of(const Flown& flown) {
  return reference_of(flown.scenario, flown.world, flown.scene, 2);
}

/// Every recorded pose, and every straight leg between the commanded views.
void expect_clear_of(const Flown& flown, const Box3& box_m, double margin_m) {
  for (const TrajectorySample& sample : flown.result.trajectory) {
    EXPECT_FALSE(box_m.contains(Vec3(sample.T_world_body.translation()))) << sample.time_s;
  }
  Vec3 at_m = flown.result.start.p_world_m;
  for (const ViewRecord& view : flown.result.views) {
    std::vector<Vec3> points_m = view.decision.via_world_m;
    points_m.push_back(view.decision.view.p_world_m);
    for (const Vec3& next_m : points_m) {
      for (int i = 0; i <= 200; ++i) {
        const Vec3 p_m = at_m + 0.005 * i * (next_m - at_m);
        EXPECT_GE(box_m.exteriorDistance(p_m), margin_m - 1e-9) << view.iteration;
      }
      at_m = next_m;
    }
  }
}

TEST(ObstacleMission, AScreenIsFlownAroundAndLeavesTheScoreItsMeaning) {
  const Flown open(smoke());
  const Flown screened(smoke({kScreen}));
  EXPECT_NE(screened.result.termination, Termination::collision);
  EXPECT_EQ(screened.result.views.size(), open.result.views.size());
  const double hull_m = screened.scenario.vehicle.airframe.hull_radius_m;
  for (const TrajectorySample& sample : screened.result.trajectory) {
    EXPECT_GT(
        screened.scene.distance_to_surroundings_m(Vec3(sample.T_world_body.translation()), 99.0),
        hull_m);
  }
  const SurfaceReference reference = reference_of(open);
  EXPECT_EQ(reference_of(screened), reference);

  // it is seen, and counts nowhere
  const auto points = screened.result.belief.cloud.points_world_m();
  const std::vector<std::uint8_t> is_own = points_of_structure(screened.scene, points, 2);
  EXPECT_GT(std::count(is_own.begin(), is_own.end(), 0), 100);
  const MissionScore score = score_of(screened, reference);
  EXPECT_GT(score.distances.at[1].precision, 0.99);
  // two missions of twelve views, of which the screened one has to look from elsewhere: a point
  // less
  EXPECT_NEAR(score.final[1], score_of(open, reference).final[1], 0.03);
}

TEST(ObstacleMission, AWallEndsAFlightIntoItAndIsFlownAroundAfterTheProfile) {
  // across the first leg of the profile, which is flown on the faces of the workspace
  const Flown hit(smoke({"obstacles=[{box_m: {min: [-4, -4, 0], max: [4, -3.9, 5]}}]",
                         "planner.validity.collision_radius_m=0.4"}));
  EXPECT_EQ(hit.result.termination, Termination::collision);
  // between the last descent, in the corner at [-4, -4], and the start; over the top is no way
  const Flown around(smoke({"obstacles=[{box_m: {min: [-2.2, -3.15, 0], max: [-2, -1, 5]}}]",
                            "planner.termination.max_iterations=2"}));
  EXPECT_EQ(around.result.termination, Termination::max_iterations);
}

TEST(ObstacleMission, AStartBesideOneIsRefused) {
  const Scenario scenario = smoke({"obstacles=[{box_m: {min: [-2, -3.2, 0], max: [2, -2.4, 3]}}]"});
  EXPECT_TRUE(test::says(
      test::fault_of([&] { start_pose(scenario, RayScene(world_of(scenario))); }), {"obstacle"}));
  EXPECT_NO_THROW(start_pose(smoke(), RayScene(world_of(smoke()))));
}

TEST(ObstacleMission, BoundsAutoStartsBesideAnObstacleNotInIt) {
  const auto start_with = [&](const std::string& obstacles) {
    ScenarioOptions options;
    options.scenario = "smoke";
    options.overrides = {obstacles, "start.jitter_m=[0, 0, 0]"};
    options.bounds_auto = true;
    return resolve_scenario(options);
  };
  const Scenario open = start_with("obstacles=[]");
  const Vec3 p_m = open.start.pose.p_world_m;
  const Scenario beside =
      start_with(fmt::format("obstacles=[{{box_m: {{min: [{0}, {2}, 0], max: [{1}, {3}, 9]}}}}]",
                             p_m.x() - 0.2, p_m.x() + 0.2, p_m.y() - 0.2, p_m.y() + 0.2));
  EXPECT_EQ(beside.workspace_m.min(), open.workspace_m.min());
  EXPECT_EQ(beside.workspace_m.max(), open.workspace_m.max());
  const RayScene scene(world_of(beside));
  const double radius_m = beside.planner.validity.collision_radius_m;
  EXPECT_LT(scene.clearance_m(p_m, 9.0), radius_m);
  EXPECT_GE(scene.clearance_m(beside.start.pose.p_world_m, 9.0), radius_m);
}

TEST(NoFlyMission, NoPoseAndNoLegLiesInABox) {
  const Box3 box_m(Vec3(2.6, -0.8, 0), Vec3(4.5, 0.8, 3));
  for (const std::string utility : {"proposed", "lawnmower", "oracle_metres"}) {
    const Scenario scenario = smoke({kNoFlyEast, "planner.utility.name=" + utility});
    const World world = world_of(scenario);
    const RayScene scene(world);
    const SurfaceReference reference = reference_of(scenario, world, scene, 2);
    const Flown flown(scenario, known_inputs(scenario, world, scene, reference));
    EXPECT_NE(flown.result.termination, Termination::collision);
    EXPECT_GE(flown.result.views.size(), 2U);
    expect_clear_of(flown, box_m, scenario.planner.validity.collision_radius_m);
  }
}

TEST(NoFlyMission, ABoxThatNothingComesNearChangesNothing) {
  EXPECT_EQ(result_sha256(Flown(smoke({"no_fly=[{min: [30, 30, 0], max: [40, 40, 9]}]"})).result),
            result_sha256(Flown(smoke()).result));
}

TEST(Structure, OfTwoFilesIsTheirMergedFile) {
  const TempFolder folder;
  TriangleMesh box = box_mesh(Box3(Vec3(-1, -0.75, 0), Vec3(1, 0.75, 1)));
  TriangleMesh tower = box_mesh(Box3(Vec3(-0.25, -0.25, 0), Vec3(0.25, 0.25, 0.5)));
  write_mesh(box, folder.path() / "box.ply");
  write_mesh(tower, folder.path() / "tower.ply");
  TriangleMesh merged = box;
  for (Vec3f& v : tower.vertices_m) v = Vec3f(2.0F * v.x() + 0.5F, 2.0F * v.y(), 2.0F * v.z() + 1);
  append(merged, tower);
  write_mesh(merged, folder.path() / "merged.ply");
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  const std::string placed =
      fmt::format("[{{path: '{}'}}, {{path: '{}', scale: 2, offset_m: [0.5, 0, 1]}}]",
                  path("box.ply"), path("tower.ply"));
  const std::string tail =
      fmt::format("[{{path: '{}', scale: 2, offset_m: [0.5, 0, 1]}}]", path("tower.ply"));
  const std::string few = "planner.termination.max_iterations=5";
  const Flown one(smoke({few, fmt::format("structure.file.path='{}'", path("merged.ply"))}));
  const Flown two(smoke({few, "structure.files=" + placed}));
  const Flown file_and_files(smoke(
      {few, fmt::format("structure.file.path='{}'", path("box.ply")), "structure.files=" + tail}));
  EXPECT_EQ(result_sha256(two.result), result_sha256(one.result));
  EXPECT_EQ(result_sha256(file_and_files.result), result_sha256(one.result));
  EXPECT_EQ(reference_of(two), reference_of(one));
}

TEST(Structure, ItsPictureIsSeenAndHashedAndDecidesNothing) {
  const TempFolder folder;
  std::ofstream obj(folder.path() / "a.obj");
  obj << "mtllib a.mtl\nusemtl a\nvt 0 0\nvt 3 0\nvt 3 3\n";
  const TriangleMesh box = box_mesh(Box3(Vec3(-1, -0.75, 0), Vec3(1, 0.75, 1)));
  for (const Vec3f& v : box.vertices_m) obj << fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& [a, b, c] : box.faces) {
    obj << fmt::format("f {}/1 {}/2 {}/3\n", a + 1, b + 1, c + 1);
  }
  obj.close();
  const auto flown = [&](std::vector<std::uint8_t> rgb) {
    std::ofstream(folder.path() / "a.mtl") << "newmtl a\nKd 1 1 1\n"
                                           << (rgb.empty() ? "" : "map_Kd a.png\n");
    if (!rgb.empty()) write_png(Image{2, 2, std::move(rgb)}, folder.path() / "a.png");
    return Flown(
        smoke({"planner.termination.max_iterations=4",
               fmt::format("structure.file.path='{}'", (folder.path() / "a.obj").string())}));
  };
  const Flown plain = flown({});
  const Flown black = flown(std::vector<std::uint8_t>(12, 0));
  std::vector<std::uint8_t> one_level_brighter(12, 0);
  one_level_brighter[7] = 1;
  const Flown other = flown(one_level_brighter);
  EXPECT_EQ(result_sha256(black.result), result_sha256(plain.result));
  EXPECT_EQ(result_sha256(other.result), result_sha256(plain.result));
  std::set<std::string> inputs;
  for (const Flown* one : {&plain, &black, &other}) {
    inputs.insert(world_inputs(one->scenario, one->world).at(0).sha256);
  }
  EXPECT_EQ(inputs.size(), 3U);
  Sha256 shape;
  add_mesh(shape, plain.world.structure);
  EXPECT_TRUE(inputs.contains(shape.hex())) << "without a picture the shape alone is hashed";
}

TEST(Structure, TurnsAboutTheOriginOfItsFile) {
  const TempFolder folder;
  const std::string path = (folder.path() / "box.ply").string();
  write_mesh(box_mesh(Box3(Vec3(1, 0, 0), Vec3(2, 0.5, 1))), path);
  const TriangleMesh turned =
      load_mesh({.path = path, .yaw_rad = deg_to_rad(90.0), .offset_m = Vec3(10, 0, 0)});
  EXPECT_TRUE(bounds_m(turned).isApprox(Box3(Vec3(9.5, 1, 0), Vec3(10, 2, 1)), 1e-6));
}

TEST(Region, OfTheWholeWorkspaceScoresAsNone) {
  const Flown all(smoke({"planner.termination.max_iterations=5"}));
  const Flown whole(smoke({"planner.termination.max_iterations=5",
                           "score.region_m={min: [-4, -4, 0], max: [4, 4, 5]}"}));
  const Flown east(smoke({"planner.termination.max_iterations=5",
                          "score.region_m={min: [0, -4, 0], max: [4, 4, 5]}"}));
  const MissionScore a = score_of(all, reference_of(all));
  const MissionScore b = score_of(whole, reference_of(whole));
  EXPECT_EQ(a.final, b.final);
  EXPECT_EQ(a.curve.coverage, b.curve.coverage);
  EXPECT_EQ(a.distances.chamfer_m, b.distances.chamfer_m);
  EXPECT_EQ(result_sha256(east.result), result_sha256(all.result)) << "the planner knows no region";
  EXPECT_NE(score_of(east, reference_of(east)).final, a.final);
}

TEST(Terrain, ThatIsFlatIsTheGround) {
  const TempFolder folder;
  const std::string path = (folder.path() / "flat.ply").string();
  TriangleMesh sheet;
  sheet.vertices_m = {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}};
  sheet.faces = {{0, 1, 2}, {0, 2, 3}};
  write_mesh(sheet, path);
  const Flown plane(smoke());
  const Flown terrain(smoke({fmt::format("terrain.path='{}'", path)}));
  EXPECT_FALSE(terrain.world.has_ground);
  EXPECT_EQ(terrain.result.termination, plane.result.termination);
  const SurfaceReference reference = reference_of(plane);
  EXPECT_EQ(reference_of(terrain), reference);
  // rays meet other triangles of the same plane: equal but for what rounding makes of the views
  EXPECT_NEAR(score_of(terrain, reference).final[1], score_of(plane, reference).final[1], 0.01);
  EXPECT_NEAR(terrain.result.distance.profile_m, plane.result.distance.profile_m, 1e-9);
}

TEST(Terrain, AHillIsSeenFlownAroundAndNotScored) {
  const TempFolder folder;
  const std::string path = (folder.path() / "hill.ply").string();
  TriangleMesh hill;
  hill.vertices_m = {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}, {2.2F, 2.2F, 1.5F}};
  hill.vertices_m.push_back({1.6F, 1.6F, 0});
  hill.vertices_m.push_back({3.2F, 1.6F, 0});
  hill.vertices_m.push_back({2.2F, 3.2F, 0});
  hill.faces = {{0, 1, 2}, {0, 2, 3}, {5, 6, 4}, {6, 7, 4}, {7, 5, 4}};
  write_mesh(hill, path);
  const Flown flown(smoke({fmt::format("terrain.path='{}'", path)}));
  EXPECT_NE(flown.result.termination, Termination::collision);
  const auto points = flown.result.belief.cloud.points_world_m();
  const std::vector<std::uint8_t> is_own = points_of_structure(flown.scene, points, 2);
  EXPECT_GT(std::count(is_own.begin(), is_own.end(), 0), 10);
  EXPECT_GT(score_of(flown, reference_of(flown)).distances.at[1].precision, 0.99);
}

}  // namespace
}  // namespace gnbv
