// Laws of pictures for which a mission is flown again: they show what the mission believed.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/surface_reference.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/mission/candidates_file.hpp"
#include "tools/mission/cloud_file.hpp"
#include "tools/mission/replay.hpp"
#include "tools/record/candidates_record.hpp"
#include "tools/render/picture.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kAsked = 3;

/// A mission of five views, with what was believed and planned on the way.
struct Watched {
  explicit Watched(const Scenario& scenario) : flown(scenario, hooks()) {}

  MissionHooks hooks() {
    MissionHooks hooks;
    hooks.on_view_belief = [this](const Belief& belief) { beliefs.push_back(belief); };
    hooks.on_candidates = [this](std::size_t, const Plan& plan) { plans.push_back(plan); };
    return hooks;
  }
  RecordedMission recorded() const {
    return {.scenario = flown.scenario,
            .world = flown.world,
            .scene = flown.scene,
            .views = flown.result.views,
            .threads = 2};
  }

  std::vector<Belief> beliefs = {};
  std::vector<Plan> plans = {};
  Flown flown;
};

const Watched& watched() {
  static const Watched all(smoke({"planner.termination.max_iterations=5"}));
  return all;
}

bool same_belief(const Belief& a, const Belief& b) {
  const auto same = [](auto x, auto y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end());
  };
  return same(a.grid.all_log_odds(), b.grid.all_log_odds()) &&
         same(a.grid.words(), b.grid.words()) &&
         same(a.cloud.points_world_m(), b.cloud.points_world_m());
}

bool same_plan(const Plan& a, const Plan& b) {
  return a.chosen == b.chosen &&
         std::equal(a.candidates.begin(), a.candidates.end(), b.candidates.begin(),
                    b.candidates.end(), [](const Candidate& x, const Candidate& y) {
                      return x.view.p_world_m == y.view.p_world_m &&
                             x.view.yaw_rad == y.view.yaw_rad && x.sampler == y.sampler &&
                             x.scale == y.scale && x.cluster == y.cluster &&
                             x.rejected == y.rejected && x.path_m == y.path_m &&
                             x.score.value == y.score.value;
                    });
}

RunSource source(const std::filesystem::path& folder = {}) {
  const Flown& flown = watched().flown;
  return {RunRecord{.folder = folder, .scenario = flown.scenario, .views = flown.result.views},
          flown.world};
}

TEST(Replay, BelievesWhatTheMissionBelieved) {
  EXPECT_TRUE(same_belief(replay_belief(watched().recorded(), kAsked), watched().beliefs[kAsked]));
  EXPECT_FALSE(same_belief(watched().beliefs[kAsked - 1], watched().beliefs[kAsked]));
}

TEST(Replay, PlansWhatTheMissionPlanned) {
  const ReplayedDecision decision = replay_decision(watched().recorded(), kAsked);
  EXPECT_TRUE(same_belief(decision.belief, watched().beliefs[kAsked - 1]));
  EXPECT_TRUE(same_plan(decision.plan, watched().plans[kAsked - 1]));  // the start is no decision
}

TEST(Replay, RefusesAnotherMissionsRecord) {
  std::vector<ViewRecord> views = watched().flown.result.views;
  ++views[1].cloud_points;
  RecordedMission mission = watched().recorded();
  mission.views = views;
  EXPECT_THROW(replay_belief(mission, kAsked), BadInput);
}

TEST(Replay, ProfileEndsAsTheMissionsDid) {
  const std::size_t waypoints[] = {1, 3, 8};
  const auto stages = replay_profile(watched().recorded(), waypoints);
  ASSERT_EQ(stages.size(), 3U);
  EXPECT_EQ(stages[2].points_world_m, watched().flown.result.profile_points_world_m);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(stages[i].waypoints, waypoints[i]);
  EXPECT_LT(stages[0].path_world_m.size(), stages[1].path_world_m.size());
  EXPECT_LT(stages[1].path_world_m.size(), stages[2].path_world_m.size());
}

TEST(CandidatesRecord, RoundTripsAndNamesDamage) {
  const TempFolder temp;
  EXPECT_FALSE(read_candidates(temp.path(), 1).has_value());
  CandidatesFile file(temp.path(), 1);
  for (std::size_t i = 0; i < watched().plans.size(); ++i) file.write(i + 1, watched().plans[i]);
  file.finish();
  for (std::size_t i = 0; i < watched().plans.size(); ++i) {
    const auto plan = read_candidates(temp.path(), i + 1);
    ASSERT_TRUE(plan.has_value());
    EXPECT_TRUE(same_plan(*plan, watched().plans[i])) << i;
  }
  EXPECT_THROW(read_candidates(temp.path(), 99), BadInput);
  write_file_atomically(temp.path() / "candidates.jsonl", "{\"iteration\":1,\"x_m\":\n");
  try {
    read_candidates(temp.path(), 1);
    FAIL() << "no error";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("candidates.jsonl:1"), std::string::npos);
  }
}

TEST(VoxelsPicture, HoldsACubeForEachVoxelOfTheMap) {
  RunSource run = source();
  PictureOptions options;
  options.iteration = kAsked;
  const RenderScene scene = kVoxelsPicture.draw(run, options, {}).panels.at(0).scene;
  const OccupancyGrid& grid = watched().beliefs[kAsked].grid;
  ASSERT_EQ(scene.surfaces.size(), 3U);  // occupied, predicted, unknown
  EXPECT_EQ(scene.surfaces[0].mesh.faces.size(), 12U * grid.occupied_count());
  EXPECT_EQ(scene.surfaces[1].mesh.faces.size(), 12U * grid.predicted_count());
}

TEST(CoveragePicture, CoversTheShareThatTheScoreSays) {
  const TempFolder temp;
  const auto points = watched().flown.result.belief.cloud.points_world_m();
  write_cloud_ply(points, temp.path() / "cloud.ply");
  write_cloud_ply(watched().flown.result.profile_points_world_m, temp.path() / "profile.ply");
  RunSource run = source(temp.path());
  const auto dots = kCoveragePicture.draw(run, {}, {}).panels.at(0).scene.dots;
  ASSERT_EQ(dots.size(), 2U);  // covered, missed
  const auto covered = static_cast<double>(dots[0].points_m.size());
  const auto missed = static_cast<double>(dots[1].points_m.size());
  const auto scored = coverage_at_all_sizes(run.reference().outside, points);
  EXPECT_DOUBLE_EQ(covered / (covered + missed), scored[0]);
  // every covered sample has a point in its voxel
  const VoxelSet seen = voxels_of(points, kCoverageSizes_m[0]);
  for (const Vec3f& sample : dots[0].points_m) {
    EXPECT_TRUE(
        std::binary_search(seen.begin(), seen.end(), voxel_code(sample, kCoverageSizes_m[0])));
  }
}

TEST(CandidatesPicture, HoldsAPinForEachCandidate) {
  const TempFolder temp;
  RunSource planned = source(temp.path());
  PictureOptions options;
  options.iteration = kAsked;
  const auto tubes_without_rays = [&](RunSource& run) {
    std::size_t pins = 0;
    const RenderScene scene = kCandidatesPicture.draw(run, options, {}).panels.at(0).scene;
    for (const Candidate& candidate : watched().plans[kAsked - 1].candidates) {
      const Vec3f p = candidate.view.p_world_m.cast<float>();
      pins += static_cast<std::size_t>(
          std::any_of(scene.tubes.begin(), scene.tubes.end(),
                      [&](const TubeItem& tube) { return tube.points_m.front() == p; }));
    }
    EXPECT_GE(scene.tubes.size(), pins);
    return pins;
  };
  const std::size_t sampled = watched().plans[kAsked - 1].candidates.size();
  EXPECT_EQ(tubes_without_rays(planned), sampled);
  // the same from the file
  CandidatesFile file(temp.path(), 1);
  for (std::size_t i = 0; i < watched().plans.size(); ++i) file.write(i + 1, watched().plans[i]);
  file.finish();
  RunSource read = source(temp.path());
  EXPECT_EQ(tubes_without_rays(read), sampled);
}

}  // namespace
}  // namespace gnbv
