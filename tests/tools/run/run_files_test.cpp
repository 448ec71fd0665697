// Laws of the one door: a run is read as it stands, whoever writes into it, and what grows is
// written once.
#include "tools/run/run_files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "planner/planners.hpp"
#include "sim/core/error.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/run/decision_lines.hpp"
#include "tools/run/frames_folder.hpp"
#include "tools/run/run_directory.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/run/user_views.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

class RunAsItStands : public ::testing::Test {
 protected:
  fs::path run() const { return temp_.path() / "run"; }
  Scenario scenario_ = made_record().scenario;
  std::vector<ViewRecord> views_ = made_record().views;
  TempFolder temp_;

  /// A run of the made views that was interrupted, with all its files.
  void end_interrupted() const {
    MissionResult result{ViewPose{}, make_model(scenario_.planner, scenario_.workspace_m, {}, {})};
    result.termination = Termination::interrupted;
    result.views = views_;
    result.trajectory = made_record().path;
    MissionScore score;
    const std::size_t rows = views_.size() + 1;
    score.curve.coverage.assign(rows, {0.1, 0.2, 0.3});
    score.curve.metres.assign(rows, 0.0);
    score.curve.seconds.assign(rows, 0.0);
    RunDirectory(run(), scenario_, false).finish(scenario_, result, score, 1.0);
  }
};

TEST_F(RunAsItStands, AResumedRunIsItsJournalAndNotItsEarlierEnd) {
  end_interrupted();
  ASSERT_TRUE(read_run(run()).figures.has_value());
  RunDirectory directory(run(), scenario_, true);
  for (const ViewRecord& view : views_) directory.append(view);
  RunRecord record = read_run(run());
  EXPECT_FALSE(record.goes_on) << "it has caught up and no more";
  EXPECT_TRUE(record.figures && !record.path.empty());
  ViewRecord next = views_.back();
  ++next.iteration;
  directory.append(next);
  record = read_run(run());
  EXPECT_TRUE(record.goes_on);
  EXPECT_EQ(record.views.size(), views_.size() + 1);
  EXPECT_FALSE(record.figures || record.profile_end_s || !record.path.empty());
  EXPECT_EQ(record.missing.size(), 3U);
  EXPECT_NE(record.missing.back().find("earlier end"), std::string::npos) << record.missing.back();
  EXPECT_THROW(read_run_cloud(record), BadInput);
  EXPECT_THROW(read_summary(run()), BadInput);
  EXPECT_FALSE(RunFiles(run()).is_finished());
}

TEST_F(RunAsItStands, WhatIsWrittenNowIsReadNow) {
  Plan plan;
  plan.candidates = {{.view = {Vec3(1, 2, 3), 0.5}, .sampler = Sampler::agvs}};
  plan.chosen = {0};
  write_file_atomically(temp_.path() / kCandidatesFile, "of an earlier end\n");
  fs::rename(temp_.path() / kCandidatesFile, temp_.path() / "old");
  CandidatesFile candidates(temp_.path(), 1);
  fs::rename(temp_.path() / "old", temp_.path() / kCandidatesFile);
  BeliefsFile beliefs(temp_.path(), 1);
  candidates.write(1, plan);
  beliefs.write(1, {.unknown = {{2, 5}}});
  for (const char* name : {kCandidatesFile, kBeliefsFile}) {
    const fs::path part = part_of(temp_.path() / name);
    write_file_atomically(part, read_file(part) + "{\"iterat");  // half of the next line
  }
  EXPECT_EQ(read_candidates(temp_.path(), 1)->chosen, plan.chosen);
  EXPECT_EQ(read_all_candidates(temp_.path(), 2).at(1).candidates.size(), 1U);
  EXPECT_EQ(voxel_count(read_beliefs(temp_.path(), 2, 100).at(1).unknown), 5U);
}

/// What this process has written so far.
double bytes_written() {
  std::ifstream io("/proc/self/io");
  for (std::string key; io >> key;) {
    double value = 0.0;
    io >> value;
    if (key == "wchar:") return value;
  }
  return 0.0;
}

double bytes_of(const std::function<void()>& work) {
  const double before = bytes_written();
  work();
  return bytes_written() - before;
}

TEST_F(RunAsItStands, TwiceAsManyViewsAreTwiceAsManyBytes) {
  const auto given = [&](int count) {
    TempFolder temp;
    RunDirectory directory(temp.path() / "run", scenario_, false);
    std::vector<ViewPose> views;
    return bytes_of([&] {
      for (int i = 0; i < count; ++i) {
        views.push_back({Vec3(1.0 / 3.0, i, 2), 0.5});
        directory.keep(views);
      }
    });
  };
  const auto frames = [&](int count) {
    TempFolder temp;
    CameraConfig config = scenario_.cameras[0];
    config.width_px = config.height_px = 1;
    FramesFolder folder(temp.path(), {make_camera_model(config)});
    DepthFrame depth;
    depth.depth_m = {1.0F};
    ColourFrame colour;
    colour.rgb = {{1, 2, 3}};
    return bytes_of([&] {
      for (int i = 0; i < count; ++i) {
        folder.write(static_cast<std::size_t>(i), i, {&depth, 1}, {&colour, 1});
      }
    });
  };
  EXPECT_LT(given(800), 2.5 * given(400));
  EXPECT_LT(frames(800), 2.5 * frames(400));
}

TEST_F(RunAsItStands, AKilledRunHasEveryViewThatItWasGiven) {
  scenario_.planner.utility.name = "route";
  std::vector<ViewPose> views;
  {
    RunDirectory directory(run(), scenario_, false);
    for (int i = 0; i < 3; ++i) {
      views.push_back({Vec3(1.0 / 3.0, i, 2), deg_to_rad(10.0 * i)});
      directory.keep(views);
    }
  }
  const fs::path part = part_of(run() / kViewsFile);
  write_file_atomically(part, read_file(part) + "1,2,3,");  // died while it wrote
  const std::vector<ViewPose> kept = views_on_the_way(run());
  ASSERT_EQ(kept.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(is_same_view(kept[i], views[i])) << i;
  Scenario resumed = scenario_;
  resumed.planner.routes.views = {views[1]};
  EXPECT_THROW(RunDirectory(run(), resumed, true), BadInput) << "of other views";
  resumed.planner.routes.views = kept;
  const RunDirectory directory(run(), resumed, true);
  EXPECT_TRUE(is_written_in((run() / kScenarioFile).string(), resumed));
  EXPECT_TRUE(views_on_the_way(run()).empty());
}

}  // namespace
}  // namespace gnbv
