// What is wrong with the world of a scenario: named with file, line and key.
#include <gmock/gmock.h>

#include <filesystem>

#include "scenarios/problems.hpp"
#include "sim/core/file.hpp"
#include "tests/scenarios/scenario_text.hpp"

namespace gnbv {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(WorldProblems, AnObstacleIsAMeshOrABox) {
  EXPECT_EQ(complaint(kMinimal + "obstacles:\n  - {}\n"),
            "s.yaml:3: obstacles.0: names neither a mesh (file.path) nor a box (box_m)");
  EXPECT_EQ(complaint(kMinimal + "obstacles:\n  - {box_m: {min: [0, 0, 0], max: [1, 1, 1]}}\n"),
            "");
  EXPECT_THAT(complaint(kMinimal + "obstacles:\n  - {box_m: {min: [0, 2, 0], max: [1, 1, 1]}}\n"),
              AllOf(StartsWith("s.yaml:3: obstacles.0.box_m.m"),
                    HasSubstr("min y = 2 has to be below max y = 1")));
  EXPECT_THAT(complaint(kMinimal + "obstacles:\n  - {file: {path: none.obj}}\n"),
              AllOf(StartsWith("s.yaml:3: obstacles.0.file.path: value '"),
                    HasSubstr("none.obj': there is no such file")));
  EXPECT_THAT(complaint(kMinimal + "obstacles:\n  - {box_m: {min: [0, 0, 0], max: [1, 1, 1]}, "
                                   "file: {path: none.obj}}\n"),
              HasSubstr("is a mesh or a box, not both"));
  EXPECT_THAT(complaint(kMinimal + "obstacles:\n  - {boxes: 1}\n"),
              HasSubstr("s.yaml:3: obstacles.0.boxes: is no known key"));
}

TEST(WorldProblems, EveryMeshFileIsThere) {
  EXPECT_THAT(complaint(kMinimal + "structure:\n  files:\n    - {path: none.ply}\n"),
              AllOf(StartsWith("s.yaml:4: structure.files.0.path: value '"),
                    HasSubstr("none.ply': there is no such file")));
  EXPECT_THAT(complaint(kMinimal + "structure:\n  files:\n    - {scale: 2}\n"),
              HasSubstr("structure.files.0.path: "));
  EXPECT_THAT(complaint(kMinimal + "terrain: {path: hill.obj}\n"),
              AllOf(StartsWith("s.yaml:2: terrain.path: value '"), HasSubstr("no such file")));
}

TEST(WorldProblems, AStartInANoFlyBoxIsRefused) {
  const std::string start = kMinimal + "start: {position_m: [0, -10, 5]}\n";
  EXPECT_THAT(
      complaint(start + "no_fly:\n  - {min: [-1, -11, 4], max: [1, -9, 6]}\n"),
      AllOf(StartsWith("s.yaml:4: no_fly.0: "),
            HasSubstr("the start [0, -10, 5] is in the box from [-1, -11, 4] to [1, -9, 6]")));
  EXPECT_THAT(complaint(start + "no_fly:\n  - {min: [-1, -9, 4], max: [1, 3, 6]}\n"),
              HasSubstr("1.00 m, less than collision_radius_m = 1.5, from the box"));
  EXPECT_EQ(complaint(start + "no_fly:\n  - {min: [-1, -8, 4], max: [1, 3, 6]}\n"), "");
  EXPECT_THAT(complaint(start + "no_fly:\n  - {min: [1, -8, 4], max: [1, 3, 6]}\n"),
              HasSubstr("s.yaml:4: no_fly.0.max: value '[1, 3, 6]': min x = 1 has to be below"));
}

TEST(WorldProblems, TheRegionHasSomethingOfTheWorkspaceInIt) {
  EXPECT_EQ(complaint(kMinimal + "score: {region_m: {min: [0, 0, 0], max: [5, 5, 5]}}\n"), "");
  EXPECT_THAT(complaint(kMinimal + "score: {region_m: {min: [30, 0, 0], max: [35, 5, 5]}}\n"),
              AllOf(StartsWith("s.yaml:2: score.region_m"), HasSubstr("nothing of the workspace")));
}

TEST(WorldProblems, AFlownScenarioMayHaveLostItsMeshes) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / "gnbv_world_problems.yaml";
  write_file_atomically(file, kMinimal +
                                  "structure: {files: [{path: a.obj}]}\nterrain: {path: b.obj}\n"
                                  "obstacles: [{file: {path: c.obj}}]\n");
  EXPECT_NO_THROW(load_flown_scenario(file.string()));
  EXPECT_THROW(load_scenario(file.string(), {}), BadInput);
  std::filesystem::remove(file);
}

TEST(WorldProblems, TheResolvedScenarioNamesThemAllAndIsReadBack) {
  const std::string text = kMinimal +
                           "obstacles: [{box_m: {min: [0, 0, 0], max: [1, 1, 1]}}]\n"
                           "no_fly: [{min: [5, 5, 5], max: [6, 6, 6]}]\n"
                           "score: {region_m: {min: [0, 0, 0], max: [5, 5, 5]}}\n"
                           "structure: {file: {yaw_deg: 30}}\n";
  const Scenario scenario = load_text(text);
  EXPECT_EQ(scenario.obstacles.at(0).box_m.max(), Vec3(1, 1, 1));
  EXPECT_EQ(no_fly_of(scenario).boxes_m.at(0).min(), Vec3(5, 5, 5));
  EXPECT_EQ(no_fly_of(scenario).margin_m, scenario.planner.validity.collision_radius_m);
  EXPECT_NEAR(scenario.structure.file.yaw_rad, deg_to_rad(30.0), 1e-12);
  EXPECT_EQ(to_yaml(load_text(to_yaml(scenario))), to_yaml(scenario));
}

}  // namespace
}  // namespace gnbv
