#include "scenarios/load.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "scenarios/builtin.hpp"
#include "sim/core/file.hpp"
#include "tests/scenarios/scenario_text.hpp"

namespace gnbv {
namespace {

TEST(LoadScenario, DefaultsSurviveWritingAndReading) {
  Scenario defaults;
  defaults.cameras.resize(1);
  const std::string yaml = to_yaml(defaults);
  EXPECT_EQ(to_yaml(load_text(yaml)), yaml);
  EXPECT_EQ(to_yaml(load_text(kMinimal)), yaml) << "what a file leaves out is at its default";
}

TEST(LoadScenario, WhatIsBuiltInLoadsAndRepeatsFromItsOwnText) {
  for (const std::string& name : builtin_scenario_names()) {
    const Scenario scenario = load_scenario(name, {});
    EXPECT_EQ(scenario.name, name);
    EXPECT_TRUE(repeats(scenario)) << name;
  }
  for (const std::string_view preset : builtin_names("vehicles")) {
    EXPECT_TRUE(repeats(
        load_text(kMinimal + fmt::format("vehicle: {{preset: {}, power: {{k1: 0.9}}}}", preset))));
  }
  for (const std::string_view camera : builtin_names("cameras")) {
    for (const std::string_view lidar : builtin_names("lidars")) {
      const Scenario scenario = load_text(fmt::format(
          "cameras: [{{preset: {}, height_px: 99}}]\nlidars: [{{preset: {}}}]\n", camera, lidar));
      EXPECT_TRUE(repeats(scenario));
      EXPECT_THAT(to_yaml(scenario),
                  testing::AllOf(testing::HasSubstr(fmt::format("- preset: {}\n", camera)),
                                 testing::HasSubstr("height_px: 99")));
    }
  }
}

TEST(LoadScenario, BuiltinsAreTheFilesOfTheirFolders) {
  const std::filesystem::path scenarios = GNBV_SCENARIOS_FOLDER;
  for (const auto& folder : {scenarios, scenarios / "presets/vehicles",
                             scenarios / "presets/cameras", scenarios / "presets/lidars"}) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ".yaml") files.push_back(entry.path().stem().string());
    }
    std::sort(files.begin(), files.end());
    const std::string name = folder.filename().string();
    const auto names = builtin_names(name);
    EXPECT_EQ(std::vector<std::string>(names.begin(), names.end()), files);
    for (const BuiltinFile& file : builtin_files(name)) {
      EXPECT_EQ(file.yaml, read_file(folder / fmt::format("{}.yaml", file.name)));
    }
  }
}

TEST(LoadScenario, AircraftHoldsTableOne) {
  const Scenario s = load_scenario("aircraft", {});
  EXPECT_EQ(s.workspace_m.sizes(), Vec3(40, 40, 20));
  ASSERT_EQ(s.cameras.size(), 2U);
  for (const CameraConfig& camera : s.cameras) {
    EXPECT_EQ(camera.fov_x_rad, deg_to_rad(60.0));
    EXPECT_EQ(camera.fov_y_rad, deg_to_rad(45.0));
  }
  EXPECT_EQ(s.cameras[0].pitch_rad, deg_to_rad(20.0));
  EXPECT_EQ(s.cameras[1].pitch_rad, deg_to_rad(-20.0));
  const UtilityConfig& u = s.planner.utility;
  EXPECT_EQ(std::vector({u.alpha, u.beta, u.gamma, u.lambda_per_m}),
            std::vector({10.0, 0.5, 0.5, 0.2}));
  EXPECT_EQ(s.planner.termination.entropy_change_percent, 0.0);
}

TEST(LoadScenario, DegreesOfTheFileAreRadiansInside) {
  EXPECT_EQ(load_text("cameras: [{pitch_deg: 12.3}]").cameras[0].pitch_rad, deg_to_rad(12.3));
  const Vec3 rates = load_text(kMinimal, {"vehicle.autopilot.rate_max_deg_s=[10, 20, 30]"})
                         .vehicle.autopilot.rate_max_rad_s;
  EXPECT_EQ(rates, Vec3(deg_to_rad(10), deg_to_rad(20), deg_to_rad(30)));
}

TEST(LoadScenario, AnglesAreWrittenSoThatTheyReadBackExactlyAndRoundOnesRound) {
  Scenario s = load_scenario("smoke", {});
  const auto written = [&](const std::string& key) {
    const auto values = scenario_values(s);
    return std::ranges::find(values, key, [](const auto& v) { return v.first; })->second;
  };
  for (int i = 0; i < 2000; ++i) {
    // degrees with long binary expansions, over all magnitudes of the range
    s.lidars[0].pitch_rad = deg_to_rad(-89.7 + 0.0897131 * i);
    EXPECT_EQ(deg_to_rad(std::stod(written("lidars.0.pitch_deg"))), s.lidars[0].pitch_rad) << i;
  }
  for (int degrees = -360; degrees <= 360; ++degrees) {
    s.start.pose.yaw_rad = deg_to_rad(degrees);
    EXPECT_EQ(written("start.yaw_deg"), std::to_string(degrees));
  }
}

TEST(LoadScenario, NumbersAreWrittenInTheFewestDigitsThatReadBack) {
  const Scenario s = load_text(kMinimal, {"planner.utility.alpha=0.1", "planner.utility.beta=1e-6",
                                          "planner.utility.gamma=0.30000000000000004"});
  EXPECT_THAT(to_yaml(s), testing::HasSubstr("alpha: 0.1\n    beta: 1.0e-06\n"
                                             "    gamma: 0.30000000000000004\n"));
}

TEST(VehiclePreset, HoldsWhereTheKeysBesideItSayNothingElse) {
  const VehicleConfig authors = load_text(kMinimal + "vehicle: {preset: authors}").vehicle;
  EXPECT_EQ(authors.preset, "authors");
  EXPECT_EQ(authors.airframe.idle_speed_rad_s, vehicle_preset("authors").airframe.idle_speed_rad_s);
  // whatever their order in the file
  const Scenario heavy = load_text(kMinimal +
                                   "vehicle:\n  power: {battery_wh: 56.6}\n"
                                   "  airframe: {mass_kg: 1.6}\n  preset: authors\n"
                                   "  estimate: {model: vio}\n");
  EXPECT_EQ(heavy.vehicle.airframe.mass_kg, 1.6);
  EXPECT_EQ(heavy.vehicle.airframe.idle_speed_rad_s, 450.0);
  EXPECT_EQ(heavy.vehicle.power.battery_wh, 56.6);
  EXPECT_EQ(heavy.vehicle.estimate.model, EstimateModel::vio);
  EXPECT_EQ(load_text(kMinimal, {"vehicle.preset=f450"}).vehicle.airframe.mass_kg, 1.9);
}

TEST(Overrides, ReachItemsOfListsAndNumbersOfVectors) {
  const Scenario s = load_scenario("aircraft", {"cameras.1.range_max_m=6", "workspace_m.max.2=15",
                                                "vehicle.airframe.rotors.3.p_body_m.0=-0.2"});
  EXPECT_EQ(s.cameras[0].range_max_m, 8.0);
  EXPECT_EQ(s.cameras[1].range_max_m, 6.0);
  EXPECT_EQ(s.workspace_m.max(), Vec3(20, 20, 15));
  EXPECT_EQ(s.vehicle.airframe.rotors[3].p_body_m, Vec3(-0.2, -0.2, 0.023));
}

TEST(Overrides, AMapSetsWhatItNamesAListReplacesTheList) {
  const Scenario s = load_scenario(
      "aircraft", {"planner.utility={name: isler, alpha: 3}", "cameras=[{name: one}]"});
  EXPECT_EQ(s.planner.utility.name, "isler");
  EXPECT_EQ(s.planner.utility.alpha, 3.0);
  EXPECT_EQ(s.planner.utility.beta, 0.5);
  ASSERT_EQ(s.cameras.size(), 1U);
  EXPECT_EQ(s.cameras[0].pitch_rad, 0.0) << "items of the new list start at defaults";
}

TEST(SensorPresets, BringTheirValuesAndTheKeysBesideThemOverride) {
  const CameraConfig camera =
      load_text(
          "cameras: [{preset: zed_mini, name: eye, range_max_m: 7, noise: {baseline_m: 0.1}}]")
          .cameras[0];
  EXPECT_EQ(camera.name, "eye");
  EXPECT_EQ(camera.fov_x_rad, deg_to_rad(90.0));
  EXPECT_EQ(camera.range_min_m, 0.1);
  EXPECT_EQ(camera.range_max_m, 7.0);
  EXPECT_EQ(camera.noise.model, DepthNoise::stereo);
  EXPECT_EQ(camera.noise.baseline_m, 0.1);
  const LidarConfig lidar =
      load_text(kMinimal + "lidars: [{beams: 11, preset: hokuyo_ust_10lx}]").lidars[0];
  EXPECT_EQ(lidar.beams, 11) << "wherever among the keys the preset stands";
  EXPECT_EQ(lidar.range_max_m, 10.0);
  EXPECT_TRUE(lidar.rolling);
  // and naming the same again changes nothing
  const std::string text = "cameras: [{preset: zed_mini, range_max_m: 7}]\n";
  EXPECT_EQ(load_text(text, {"cameras.0.preset=zed_mini"}).cameras[0].range_max_m, 7.0);
  EXPECT_EQ(load_text(text, {"cameras.0.preset=rgbd_sim"}).cameras[0].range_max_m, 8.0);
  EXPECT_EQ(load_text(text, {"cameras.0.width_px=80"}).cameras[0].range_max_m, 7.0);
}

TEST(SensorPresets, GivenLaterAreAsIfTheKeysBeforeWereNotThere) {
  const std::vector<std::string> takeoff = {"planner.preset=takeoff"};
  const std::string alone =
      to_yaml(load_text("cameras: [{preset: rgbd_sim, yaw_deg: 9}]\n", takeoff));
  for (const int fov_deg : {60, 80}) {  // the preset's own, and another
    const std::string before = fmt::format(
        "cameras: [{{preset: zed_mini, fov_x_deg: {}, rate_hz: 10, yaw_deg: 9}}]\n", fov_deg);
    EXPECT_EQ(to_yaml(load_text(before, {takeoff[0], "cameras.0.preset=rgbd_sim"})), alone);
  }
}

TEST(SensorPresets, LeaveNameAndMountingToTheVehicle) {
  const Scenario s = load_text(
      "cameras: [{name: a, pitch_deg: 20}, {name: b, p_body_m: [1, 2, 3], yaw_deg: 30}]\n"
      "lidars: [{pitch_deg: 5}]",
      {"cameras.0.preset=zed_mini", "cameras.1.preset=zed_mini",
       "lidars.0.preset=hokuyo_utm_30lx"});
  EXPECT_EQ(s.cameras[0].name, "a");
  EXPECT_EQ(s.cameras[1].name, "b");
  EXPECT_EQ(s.cameras[0].pitch_rad, deg_to_rad(20.0));
  EXPECT_EQ(s.cameras[1].yaw_rad, deg_to_rad(30.0));
  EXPECT_EQ(s.cameras[1].p_body_m, Vec3(1, 2, 3));
  EXPECT_EQ(s.lidars[0].pitch_rad, deg_to_rad(5.0));
  EXPECT_EQ(s.lidars[0].beams, 1081);
}

TEST(Presets, OfThePlannerLeaveNothingBehindForTheNextOne) {
  for (const std::string_view before : kPlannerPresets) {
    const std::string other = fmt::format("planner.preset={}", before);
    const Scenario back = load_text(kMinimal, {other, "planner.preset=paper"});
    EXPECT_TRUE(to_yaml(back) == to_yaml(load_text(kMinimal))) << before;
    const Scenario set = load_text(kMinimal, {"planner.validity.collision_radius_m=2", other});
    EXPECT_EQ(set.planner.validity.collision_radius_m, before == "authors_2018" ? 0.8 : 2.0);
  }
}

TEST(Presets, OfTheSimulationAreTheDefaults) {
  Scenario defaults;
  defaults.cameras.resize(1);
  const Scenario named =
      load_text("cameras: [{preset: zed_mini}]",
                {"vehicle.preset=f450", "lidars.0.preset=hokuyo_ust_10lx", "vehicle.preset=iris",
                 "cameras.0.preset=rgbd_sim", "lidars.0.preset=profiling_sim"});
  EXPECT_EQ(to_yaml(named), to_yaml(defaults));
  EXPECT_THAT(load_text(kMinimal).cameras[0].noise.model, DepthNoise::none)
      << "the paper states no noise";
  const CameraModel zed = make_camera_model(load_text("cameras: [{preset: zed_mini}]").cameras[0]);
  EXPECT_NEAR(zed.fx_px / zed.fy_px, 1.0, 0.002) << "square pixels, and its maker's noise";
  const DepthNoiseConfig& noise = zed.config.noise;
  EXPECT_NEAR(noise.disparity_noise_px / (zed.fx_px * noise.baseline_m), 2.48e-3, 5e-6);
}

TEST(Paths, OfAFileAreBesideItThoseOfAnOverrideInTheCurrentFolder) {
  const ScenarioFile file("structure: {file: {path: mesh/../s.yaml}}\n" + kMinimal);
  const Scenario s = load_scenario(file.path().string(), {});
  EXPECT_EQ(s.structure.file.path, file.path().lexically_normal().string());

  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(file.folder().path());
  const Scenario t = load_scenario("smoke", {"structure.file.path=s.yaml"});
  std::filesystem::current_path(before);
  EXPECT_TRUE(std::filesystem::path(t.structure.file.path).is_absolute());
  EXPECT_TRUE(std::filesystem::equivalent(t.structure.file.path, file.path()));
  EXPECT_EQ(load_text(to_yaml(t)).structure.file.path, t.structure.file.path);
}

TEST(Paths, WithAwkwardLettersSurviveWritingAndReading) {
  const ScenarioFile file(kMinimal);
  for (const char* name : {"a b.obj", "it's.obj", "q\"uote.obj", "back\\slash.obj", "#5: x.obj",
                           "ünïcode.obj", "tab\t.obj"}) {
    const std::string path = file.folder().write(name, "x").string();
    Scenario s = load_text(kMinimal);
    s.structure.file.path = path;
    EXPECT_EQ(load_text(to_yaml(s)).structure.file.path, path);
  }
}

}  // namespace
}  // namespace gnbv
