// What is wrong with the world of a scenario: named with file, line and key.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <typeindex>
#include <utility>

#include "scenarios/fields.hpp"
#include "scenarios/load.hpp"
#include "scenarios/problems.hpp"
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

TEST(WorldProblems, EveryMeshFileIsThereUnlessTheScenarioWasFlown) {
  EXPECT_THAT(complaint(kMinimal + "structure:\n  files:\n    - {path: none.ply}\n"),
              AllOf(StartsWith("s.yaml:4: structure.files.0.path: value '"),
                    HasSubstr("none.ply': there is no such file")));
  EXPECT_THAT(complaint(kMinimal + "structure:\n  files:\n    - {scale: 2}\n"),
              HasSubstr("structure.files.0.path: "));
  EXPECT_THAT(complaint(kMinimal + "terrain: {path: hill.obj}\n"),
              AllOf(StartsWith("s.yaml:2: terrain.path: value '"), HasSubstr("no such file")));
  const ScenarioFile file(kMinimal +
                          "structure: {files: [{path: a.obj}]}\nterrain: {path: b.obj}\n"
                          "obstacles: [{file: {path: c.obj}}]\n");
  EXPECT_NO_THROW(load_flown_scenario(file.path().string()));
  EXPECT_THROW(load_scenario(file.path().string(), {}), BadInput);
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

TEST(WorldProblems, BoxesOfWhatCountsHaveSomethingOfTheWorkspaceInThem) {
  for (const std::string key : {"score.region_m", "planner.object_bounds_m"}) {
    EXPECT_EQ(complaint(kMinimal, {key + "={min: [0, 0, 0], max: [5, 5, 5]}"}), "");
    EXPECT_THAT(complaint(kMinimal, {key + "={min: [30, 0, 0], max: [35, 5, 5]}"}),
                AllOf(HasSubstr(key), HasSubstr(key + " has nothing of the workspace in it")));
    EXPECT_THAT(complaint(kMinimal, {key + "={min: [5, 0, 0], max: [0, 5, 5]}"}),
                AllOf(HasSubstr(key), HasSubstr("min x = 5 has to be below max x = 0")));
  }
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
  EXPECT_TRUE(repeats(scenario));
}

TEST(PapersSetting, IsThatOfTheBuiltInScenariosWhateverTheReading) {
  for (const std::string name : {"aircraft", "power_plant", "lab_model", "lab_airplane"}) {
    EXPECT_TRUE(has_papers_setting(load_scenario(name, {})));
    EXPECT_TRUE(has_papers_setting(load_scenario(
        name,
        {"seed=7", "planner.utility.name=isler", "planner.preset=released", "planner.fvs.tries=1",
         "structure.builtin=smoke", "score.sizes_m=[0.2]"})));  // which is only told
  }
}

TEST(PapersSetting, IsNoneInAnotherWorldNorWithAnotherEndViewsSensorsProfileRoomOrName) {
  for (const std::string set : {"obstacles=[{box_m: {min: [20, 20, 0], max: [21, 21, 1]}}]",
                                "no_fly=[{min: [20, 20, 0], max: [21, 21, 1]}]",
                                "score.region_m={min: [-1, -1, 0], max: [1, 1, 9]}",
                                "wind.gust_w20_m_s=1",
                                "vehicle.power.return_home=true",
                                "planner.termination.max_distance_m=2000",
                                "planner.termination.max_flight_time_s=9000",
                                "planner.termination.min_new_voxels_per_m=1",
                                "planner.termination.max_views_without_new_points=5",
                                "benchmark.stop_at_coverage=0.9",
                                "planner.termination.max_iterations=20",
                                "planner.profiling.method=none",
                                "cameras.0.range_max_m=6",
                                "cameras=[{}]",
                                "lidars.0.range_max_m=9",
                                "planner.map.resolution_m=0.1",
                                "workspace_m={max: [30, 30, 20]}",
                                "name=mine",
                                "vehicle.estimate.model=gnss",
                                "planner.validity.collision_radius_m=1",
                                "vehicle.estimate={model: gnss, outages: [{start_s: 9}]}",
                                "planner.agvs.step_m=2",
                                "planner.agvs.yaw_step_deg=90"}) {
    EXPECT_FALSE(has_papers_setting(load_scenario("aircraft", {set}))) << set;
  }
  Scenario hilly = load_scenario("aircraft", {});
  hilly.terrain.path = "/hill.ply";
  EXPECT_FALSE(has_papers_setting(hilly));
}

// No config field without a key: the fields of each struct are counted and compared with its keys.

/// Converts to any field's type, so that T{Any, Any, ...} compiles up to the number of fields.
struct Any {
  template <typename T>
  operator T() const;  // NOLINT: has to be implicit; never called
};

template <typename T, std::size_t... i>
constexpr bool takes(std::index_sequence<i...>) {
  return requires { T{(static_cast<void>(i), Any{})...}; };
}

template <typename T, std::size_t count = 0>
constexpr std::size_t field_count() {
  if constexpr (takes<T>(std::make_index_sequence<count + 1>{})) {
    return field_count<T, count + 1>();
  } else {
    return count;
  }
}

/// Counts the keys of each struct, those of the structs in it left out.
class KeyCounter final : public FieldVisitor {
 public:
  std::map<std::type_index, std::size_t> counts;

  void leaf(const Field&, const FieldValue&) override { counts[within_.back()] += 1; }
  std::optional<std::size_t> begin(const Group& group) override {
    if (group.kind != Group::Kind::item) counts[within_.back()] += 1;
    if (group.kind != Group::Kind::list) counts[group.config] = 0;  // some are there several times
    within_.push_back(group.config);
    return 1;  // item in every list
  }
  void end(const Group&) override { within_.pop_back(); }
  Form form_of(std::string_view, bool) override { return Form::both; }

 private:
  std::vector<std::type_index> within_ = {typeid(Scenario)};
};

TEST(Fields, EveryFieldOfEveryConfigHasAKey) {
  Scenario scenario;
  KeyCounter counter;
  fields(Keys(counter), scenario);
  const auto expect = [&]<typename Config>(const Config&, int more = 0) {
    const auto keys = counter.counts.find(typeid(Config));
    ASSERT_NE(keys, counter.counts.end()) << typeid(Config).name();
    EXPECT_EQ(keys->second, field_count<Config>() + more) << typeid(Config).name();
    counter.counts.erase(keys);
  };
  const auto expect_all = [&](const auto&... configs) { (expect(configs), ...); };
  expect_all(MeshFileConfig{}, RotorMount{}, AirframeParameters{}, PowerParameters{},
             EstimateConfig{}, VehicleConfig{}, GuidanceConfig{}, WindConfig{}, GnssOutage{},
             RtkParameters{}, GimbalConfig{}, DepthNoiseConfig{}, DistortionConfig{}, LidarConfig{},
             OccupancyConfig{}, CloudConfig{}, ProfilingConfig{}, AgvsConfig{}, FvsConfig{},
             FrontierConfig{}, ValidityConfig{}, PathSearchConfig{}, UtilityConfig{},
             VolumeWeights{}, ShadowConfig{}, UserFunctionConfig{}, TourConfig{}, SymmetryConfig{},
             RouteConfig{}, OracleConfig{}, ViewPose{}, TerminationConfig{}, PlannerConfig{},
             StructureConfig{}, ObstacleConfig{}, MotionConfig{}, WaypointConfig{}, ScoreConfig{},
             BenchmarkConfig{});
  expect(AutopilotParameters{});
  // the commander's others are PX4 parameters
  EXPECT_EQ(counter.counts.extract(typeid(CommanderParameters)).mapped(), 1U);
  expect(CameraConfig{}, 1);                          // calibration fills other fields
  expect(StartConfig{}, 1);                           // pose is two keys
  expect(NoFlyConfig{}, 1);                           // a box is two keys
  expect(Scenario{}, -1);                             // placed_at is no key
  EXPECT_EQ(counter.counts.erase(typeid(Box3)), 1U);  // no struct of ours
  for (const auto& [config, count] : counter.counts) ADD_FAILURE() << config.name() << " is new";
}

}  // namespace
}  // namespace gnbv
