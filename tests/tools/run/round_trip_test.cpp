// Laws of the files of a run directory: what was written is what is read, number by number.
#include <gtest/gtest.h>

#include <limits>

#include "planner/planners.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/run/coverage_csv.hpp"
#include "tools/run/frames_folder.hpp"
#include "tools/run/run_directory.hpp"
#include "tools/run/summary_json.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using test::fault_of;
using test::says;

/// Numbers that no short text holds by chance.
ViewRecord odd_view(int iteration) {
  const double odd = 1.0 / 3.0 + iteration;
  ViewRecord view{.iteration = iteration};
  view.decision = {.view = {Vec3(odd, -1e-300, 1.7e5), 0.1 + 0.2},
                   .sampler = iteration == 0 ? Sampler::start : Sampler::fvs,
                   .scale = 4.0 / 7.0,
                   .candidates = 1'000'000,
                   .valid = 3,
                   .score = {.value = odd,
                             .information = 5e-324,
                             .density = 0.7,
                             .prediction = -0.0,
                             .distance = 1.0 / 9.0},
                   .via_world_m = {Vec3(odd, 2, 3), Vec3(-4, 5e-7, 1e20)}};
  view.entropy_nat = 9007199254740993.0 / 7.0;
  view.density_points_per_voxel = 2.0 / 3.0;
  view.cloud_points = 999'999'999;
  view.straight_m = 1e-9;
  view.flown_m = 12345.678901234567;
  view.time_s = 0.004 * 1234567;
  view.energy_wh = 4.0 / 13.0 + iteration;
  view.wall = {.sense_s = 0.25, .map_s = 1e-6, .plan_s = 123.456789, .fly_s = 0.0};
  return view;
}

TEST(RoundTrip, IterationsCsv) {
  TempFolder temp;
  const fs::path csv = temp.path() / kIterationsFile;
  const std::vector<ViewRecord> views = {odd_view(0), odd_view(1)};
  write_file_atomically(csv, iterations_csv(views));
  const std::vector<ViewRecord> read = read_view_records(csv);
  ASSERT_EQ(read.size(), 2U);
  // the text of a number is the shortest that reads back as it: equal texts are equal numbers
  EXPECT_EQ(iterations_csv(read), iterations_csv(views));
  EXPECT_EQ(read[1].decision.view.p_world_m, views[1].decision.view.p_world_m);
  EXPECT_EQ(read[1].decision.via_world_m, views[1].decision.via_world_m);
  EXPECT_EQ(read[1].decision.score.information, 5e-324);
  EXPECT_EQ(read[1].entropy_nat, views[1].entropy_nat);
  EXPECT_EQ(read[1].wall.plan_s, 123.456789);
  EXPECT_EQ(read[0].decision.sampler, Sampler::start);
  EXPECT_FALSE(read[1].energy_wh) << "none of runs of older versions";
  for (const bool gimbal : {false, true}) {
    write_file_atomically(csv, iterations_csv(views, {.gimbal = gimbal, .energy = true}));
    EXPECT_EQ(read_view_records(csv).at(1).energy_wh, views[1].energy_wh);
  }
  write_file_atomically(csv, iterations_csv(read, {.energy = true}));
  EXPECT_FALSE(read_view_records(csv).at(1).energy_wh) << "and is not nothing";
  ViewRecord turned = odd_view(0);
  turned.decision.view.gimbal_pitch_rad = 0.1 + 0.2;
  write_file_atomically(csv, iterations_csv(std::vector{turned}, Columns{.gimbal = true}));
  EXPECT_EQ(read_view_records(csv).at(0).decision.view.gimbal_pitch_rad, 0.1 + 0.2);
  // an older record is as good as what it knows; what it does not know is in no hash of it
  EXPECT_FALSE(first_difference(views[1], read[1]));
  EXPECT_NE(views_sha256(views), views_sha256(read));
  ViewRecord thirsty = views[1];
  *thirsty.energy_wh *= 2.0;
  EXPECT_EQ(first_difference(thirsty, views[1])->column, "energy_wh");
  // the second view of a burst: what tells of its decision tells of the first
  std::vector<ViewRecord> burst = {odd_view(0), odd_view(1), odd_view(2)};
  const std::string decided_alone = views_sha256(burst);
  burst[2].decision.plan_view = 2;
  EXPECT_NE(views_sha256(burst), decided_alone);
  write_file_atomically(csv, iterations_csv(burst, Columns{.plans = true}));
  EXPECT_EQ(read_view_records(csv).at(2).planned_at(), 1U);
  burst[2].decision.plan_view = 3;  // the start is no view of a plan
  write_file_atomically(csv, iterations_csv(burst, Columns{.plans = true}));
  EXPECT_TRUE(says(fault_of([&] { read_view_records(csv); }), {"iterations.csv:4: ", "view 3"}));
}

TEST(RoundTrip, CoverageCsv) {
  TempFolder temp;
  const CoverageCurve curve{.coverage = {{0.0, 1.0 / 3.0, 1.0}, {0.1 + 0.2, 5e-324, 2.0 / 3.0}},
                            .metres = {0.0, 1e-9},
                            .seconds = {0.0, 12345.678901234567}};
  const fs::path csv = temp.path() / kCoverageFile;
  const std::vector<SizedCoverage> more = {{.size_m = 0.2, .curve = {0.7, 1.0 / 7.0}},
                                           {.size_m = 0.025, .curve = {0.0, 5e-324}}};
  write_file_atomically(csv, coverage_csv(curve, more));
  const CoverageFile wide = read_coverage_csv(csv);
  EXPECT_EQ(wide.curve.coverage, curve.coverage);
  EXPECT_EQ(wide.more_names, (std::vector<std::string>{"0.20", "0.025"}));
  EXPECT_EQ(wide.more_curves[0], more[0].curve);
  EXPECT_EQ(wide.more_curves[1], more[1].curve);
  // with accurate coverage, which older versions did not write
  EXPECT_TRUE(wide.curve.accurate.empty());
  CoverageCurve both = curve;
  both.accurate = {{0.0, 0.25, 1.0 / 3.0}, {1.0 / 9.0, 0.0, 5e-324}};
  std::vector<SizedCoverage> more_of_both = more;
  more_of_both[0].accurate_curve = {0.1, 1.0 / 11.0};
  more_of_both[1].accurate_curve = {0.0, 0.3};
  write_file_atomically(csv, coverage_csv(both, more_of_both));
  const CoverageFile whole = read_coverage_csv(csv);
  EXPECT_EQ(whole.curve.coverage, curve.coverage);
  EXPECT_EQ(whole.curve.accurate, both.accurate);
  EXPECT_EQ(whole.more_names, wide.more_names);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(whole.more_curves[i], more[i].curve);
    EXPECT_EQ(whole.more_accurate[i], more_of_both[i].accurate_curve);
  }
  // and with energy, likewise
  EXPECT_TRUE(whole.curve.energy_wh.empty());
  for (CoverageCurve fed : {curve, both}) {
    fed.energy_wh = {1.0 / 3.0, 12.0 / 7.0};
    fed.on_one_battery = {true, false};
    write_file_atomically(csv, coverage_csv(fed, fed.accurate.empty() ? more : more_of_both));
    const CoverageFile again = read_coverage_csv(csv);
    EXPECT_EQ(again.curve.energy_wh, fed.energy_wh);
    EXPECT_EQ(again.curve.on_one_battery, fed.on_one_battery);
    EXPECT_EQ(again.curve.accurate, fed.accurate);
    EXPECT_EQ(again.more_curves[1], more[1].curve);
    fed.energy_wh.back() = 0.3;
    write_file_atomically(csv, coverage_csv(fed, more_of_both));
    EXPECT_TRUE(says(fault_of([&] { read_coverage_csv(csv); }), {"coverage.csv:3: 0.3 Wh after"}));
  }
  write_file_atomically(csv, coverage_csv(curve));
  EXPECT_TRUE(read_coverage_csv(csv).more_names.empty());
  const CoverageCurve read = read_coverage_csv(csv).curve;
  EXPECT_EQ(read.coverage, curve.coverage);
  EXPECT_EQ(read.metres, curve.metres);
  EXPECT_EQ(read.seconds, curve.seconds);
}

TEST(RoundTrip, TrajectoryTum) {
  TempFolder temp;
  std::vector<TrajectorySample> path;
  for (int i = 0; i < 4; ++i) {
    TrajectorySample& sample = path.emplace_back(made_sample(0.1 * i, {0.000001 * i, -1.5, 2.25}));
    sample.T_world_body.rotate(Eigen::AngleAxisd(0.7 * i, Vec3(1, 2, 3).normalized()));
  }
  const fs::path file = temp.path() / kTrajectoryFile;
  write_file_atomically(file, trajectory_tum(path));
  const auto read = read_trajectory_tum(file, Box3(Vec3(-5, -5, 0), Vec3(5, 5, 5)));
  ASSERT_EQ(read.size(), path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_NEAR(read[i].time_s, path[i].time_s, 1e-15);
    EXPECT_EQ(read[i].T_world_body.translation(), path[i].T_world_body.translation());
    // nine digits of a quaternion
    EXPECT_TRUE(read[i].T_world_body.isApprox(path[i].T_world_body, 1e-8));
  }
  EXPECT_EQ(trajectory_tum(read), read_file(file));
}

TEST(RoundTrip, Frames) {
  TempFolder temp;
  CameraConfig config = made_record().scenario.cameras[0];
  config.width_px = 3;
  config.height_px = 2;
  const CameraModel camera = make_camera_model(config);
  DepthFrame depth;
  depth.depth_m = {0.001F, 1.5F, 65.535F, 65.5364F, std::numeric_limits<float>::infinity(), 2.0F};
  depth.T_world_camera.translate(Vec3(1.5, -2.000001, 3));
  depth.T_world_camera.rotate(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5));
  ColourFrame colour;
  for (std::uint8_t i = 0; i < 6; ++i) colour.rgb.push_back({i, 0, 255});
  {
    FramesFolder folder(temp.path(), {camera});
    folder.write(0, 0.25, std::span(&depth, 1), std::span(&colour, 1));
    folder.write(7, 12.125, std::span(&depth, 1), std::span(&colour, 1));
  }
  const FrameRecord read = read_frames(temp.path());
  ASSERT_EQ(read.cameras.size(), 1U);
  EXPECT_EQ(read.cameras[0].name, config.name);
  EXPECT_EQ(read.cameras[0].width_px, 3);
  EXPECT_EQ(read.cameras[0].height_px, 2);
  EXPECT_EQ(read.cameras[0].fx_px, camera.fx_px);
  EXPECT_EQ(read.cameras[0].fy_px, camera.fy_px);
  EXPECT_EQ(read.cameras[0].cx_px, camera.cx_px);
  EXPECT_EQ(read.cameras[0].cy_px, camera.cy_px);
  ASSERT_EQ(read.frames.size(), 2U);
  EXPECT_EQ(read.frames[1].iteration, 7);
  EXPECT_EQ(read.frames[1].time_s, 12.125);
  EXPECT_EQ(read.frames[1].T_world_camera.matrix(), depth.T_world_camera.matrix());
  EXPECT_EQ(read_depth(read, 1).values, (std::vector<std::uint16_t>{1, 1500, 65535, 0, 0, 2000}));
  EXPECT_EQ(read_colour(read, 0).at(2, 1), (Rgb8{5, 0, 255}));
}

/// A mission that was hardly flown, with a score of its own.
struct MadeMission {
  Scenario scenario = made_record().scenario;
  MissionResult result{ViewPose{}, make_model(scenario.planner, scenario.workspace_m, {}, {})};
  MissionScore score;

  MadeMission() {
    result.termination = Termination::no_valid_view;
    result.views = {odd_view(0), odd_view(1)};
    for (ViewRecord& view : result.views) view.decision.view.p_world_m = Vec3(1.0 / 3.0, 0, 1);
    result.trajectory = made_record().path;
    result.distance = {
        .profile_m = 1.0 / 3.0, .transfer_m = 2.0 / 7.0, .straight_m = 1e-9, .flown_m = 2.0 / 3.0};
    result.profile_end_s = 0.1 + 0.2;
    result.flight_time_s = 1e20;
    result.energy_wh = 5e-324;
    result.entropy_after_profile_nat = result.belief.grid.total_entropy_nat() + 0.5;
    score.profile = {0.1, 0.2, 0.3};
    score.final = {0.4, 0.5, 2.0 / 3.0};
    score.accurate = {0.35, 0.36, 4.0 / 11.0};
    score.is_noisy = true;
    score.area_samples = 1234;
    score.profile_raw = {0.01, 0.02, 0.03};
    score.final_raw = {0.04, 0.05, 0.06};
    score.distances.at[1] = {.distance_m = 0.05, .precision = 1.0 / 3.0, .recall = 0.7, .f = 0.45};
    score.distances.accuracy_m = 1.0 / 7.0;
    score.distances.completeness_m = 1.0 / 9.0;
    score.distances.chamfer_m = 1.0 / 11.0;
    score.density = {.voxel_m = 0.2, .mean_points = 10.0 / 3.0, .variation = 0.3};
    score.curve = {.coverage = {{0.1, 0.2, 0.3}, {0.2, 0.3, 0.4}, {0.4, 0.5, 2.0 / 3.0}},
                   .metres = {0.0, 0.0, 1.0},
                   .seconds = {0.0, 1.0, 2.0},
                   .accurate = {{0.1, 0.2, 0.3}, {0.1, 0.25, 0.3}, {0.35, 0.36, 4.0 / 11.0}}};
  }
  fs::path written_into(const TempFolder& temp) const {
    RunDirectory(temp.path() / "run", scenario, false).finish(scenario, result, score, 61.5);
    return temp.path() / "run";
  }
};

TEST(RoundTrip, RunDirectory) {
  const TempFolder temp;
  const MadeMission made;
  const fs::path run = made.written_into(temp);
  const RunRecord record = read_run(run);
  EXPECT_TRUE(record.missing.empty());
  EXPECT_EQ(to_yaml(record.scenario), to_yaml(made.scenario));
  EXPECT_EQ(record.profile_end_s, made.result.profile_end_s);
  EXPECT_EQ(record.views_begin_s, made.result.views[0].time_s);
  EXPECT_EQ(iterations_csv(record.views), iterations_csv(made.result.views));
  EXPECT_EQ(trajectory_tum(record.path), trajectory_tum(made.result.trajectory));
  const RunSummary summary = read_summary(run);
  EXPECT_EQ(summary.schema, kSummarySchema);
  EXPECT_EQ(summary.termination, "no_valid_view");
  EXPECT_EQ(summary.iterations, 2U);
  ASSERT_TRUE(record.figures.has_value());
  // every number that a comparison reads is one of summary.json, where no two are the same
  const RunFigures& f = *record.figures;
  EXPECT_EQ(f.result_sha256, result_sha256(made.result));
  EXPECT_EQ(f.structure, structure_name(made.scenario.structure));
  EXPECT_EQ(
      (std::array{f.entropy_reduction_nat, f.straight_m, f.flown_m, f.before.profile_m,
                  f.before.transfer_m, f.before.profile_end_s, f.flight_time_s, f.energy_wh,
                  f.density_points_per_voxel, f.distances.at[1].precision, f.distances.at[1].recall,
                  f.distances.accuracy_m, f.distances.completeness_m, f.distances.chamfer_m,
                  f.density.mean_points, f.wall_s}),
      (std::array{0.5, 1e-9, 2.0 / 3.0, 1.0 / 3.0, 2.0 / 7.0, 0.1 + 0.2, 1e20, 5e-324, 2.0 / 3.0,
                  1.0 / 3.0, 0.7, 1.0 / 7.0, 1.0 / 9.0, 1.0 / 11.0, 10.0 / 3.0, 61.5}));
  EXPECT_EQ(f.area_samples, 1234U);
  EXPECT_EQ(f.coverage_final, made.score.final);
  EXPECT_EQ(f.coverage_profile, made.score.profile);
  EXPECT_EQ(f.coverage_final_raw, made.score.final_raw);
  EXPECT_EQ(f.coverage_profile_raw, made.score.profile_raw);
  EXPECT_EQ(f.curve.coverage, made.score.curve.coverage);
  EXPECT_EQ(f.coverage_accurate, made.score.accurate);
  EXPECT_EQ(f.curve.accurate, made.score.curve.accurate);
  EXPECT_TRUE(f.is_noisy);
}

}  // namespace
}  // namespace gnbv
