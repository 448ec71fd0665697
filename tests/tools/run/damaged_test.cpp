// The law of damaged files: whatever is wrong in a file of a run is named by file and line.
#include <gtest/gtest.h>

#include <functional>

#include "tests/support/fault.hpp"
#include "tests/support/made_frames.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/run/coverage_csv.hpp"
#include "tools/run/decision_lines.hpp"
#include "tools/run/frames_folder.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/run/tour_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

const std::string kCandidates =
    R"({"iteration":1,"x_m":1,"y_m":2,"z_m":3,"yaw_rad":0,"sampler":"fvs","path_m":1,"cluster":2,)"
    "\"rejected\":\"collision\"}\n";
const std::string kPlans =
    R"({"iteration":1,"tour":[{"x_m":2.0,"y_m":2.0,"z_m":2.0,"yaw_rad":1.0}],"cube_m":0.5,"cubes":)"
    R"({"sampled":[],"extrapolated":[],"opposite":[],"frontier":[[0,0,3,12.5]]}})"
    "\n";
const std::string kPredictions =
    "iteration,source,looks,incidence_deg,patches,missing,promised,found\n"
    "1,frontier,4,65,17,130.5,65.2,0.0\n2,opposite,0,45,1,6.0,5.5,6.0\n";
const std::string kCoverage =
    "view,metres,seconds,coverage_0.05,coverage_0.10,coverage_0.50\n"
    "0,0,0,0.1,0.2,0.3\n1,4,8,0.2,0.3,0.4\n";
const std::string kPath = "0 1 2 3 0 0 0 1\n1 2 2 3 0 0 0 1\n";
const std::string kBeliefs = "{\"iteration\":1,\"unknown\":[0,5]}\n{\"iteration\":2}\n";

/// The made run, a tour's, with a whole file of every other kind.
class DamagedFile : public ::testing::Test {
 protected:
  DamagedFile() {
    write_made_run(run_);
    write_made_frames(run_);
    for (const auto& [name, text] :
         std::map<std::string, std::string>{{kCandidatesFile, kCandidates},
                                            {kPlanFile, kPlans},
                                            {kPredictionsFile, kPredictions},
                                            {kCoverageFile, kCoverage},
                                            {kTrajectoryFile, kPath},
                                            {kBeliefsFile, kBeliefs}}) {
      write_file_atomically(run_ / name, text);
    }
  }
  RunRecord tour() const {
    RunRecord record = read_run(run_);
    record.scenario.planner.utility.name = "tour";
    return record;
  }

  TempFolder temp_;
  fs::path run_ = temp_.path();
  const std::map<std::string, std::function<void()>> readers_ = {
      {kIterationsFile, [&] { read_view_records(run_ / kIterationsFile); }},
      {kCoverageFile, [&] { read_coverage_csv(run_ / kCoverageFile); }},
      {kTrajectoryFile, [&] { read_run(run_); }},
      {kCandidatesFile, [&] { read_candidates(run_, 1); }},
      {kBeliefsFile, [&] { read_beliefs(run_, 4, 100); }},
      {kPlanFile, [&] { read_plans(tour()); }},
      {kPredictionsFile, [&] { read_predictions_csv(run_ / kPredictionsFile); }},
      {"frames/poses.csv", [&] { read_frames(run_); }},
      {"frames/cameras.json", [&] { read_frames(run_); }}};
};

struct Damage {
  std::string file;
  std::string from;  // whose last place in the file
  std::string to;
  std::string says;
};

const std::vector<Damage> kDamages = {
    {kIterationsFile, "start", "guess", ":4: 'guess' is no sampler"},
    {kIterationsFile, ",6,", ",many,", ":4: cloud_points `many` is not a number"},
    {kIterationsFile, ",6,", ",-1,", ":4: cloud_points `-1` is not a count"},
    {kIterationsFile, "\n2,", "\n3,", ":4: '3' must be iteration 2"},
    {kIterationsFile, ",6,", ",", ":4: '2,-4,-4,3"},
    {kIterationsFile, "iteration,", "view,", ":1: is not the header"},
    {kIterationsFile, ",\n", ",1:2\n", ":4: via '1:2' is no list of x:y:z"},
    {kCoverageFile, "0.2,0.3,0.4", "0.2,0.3", ":3: '1,4,8,0.2,0.3' is no row of 6 numbers"},
    {kCoverageFile, "0.4\n", "0.4,5\n", ":3: "},
    {kCoverageFile, "0.4\n", "x\n", ":3: "},
    {kCoverageFile, "0.4\n", "1.5\n", ":3: coverage 1.5 must be from 0 to 1"},
    {kCoverageFile, "1,4,8", "2,4,8", ":3: view 2 must be 1"},
    {kCoverageFile, "1,4,8", "1,-4,8", ":3: -4 m and 8 s after 0 m and 0 s"},
    {kCoverageFile, "1,4,8", "1,4,-8", ":3: "},
    {kCoverageFile, "0.50\n", "0.50,x\n", ":1: is not the header"},
    {kTrajectoryFile, "1 2 2 3", "1 2 two 3", ":2: "},
    {kTrajectoryFile, "1 2 2 3", "1 2 nan 3", ":2: "},
    {kTrajectoryFile, "1 2 2 3", "1 2 2", ":2: fewer than 8 values"},
    {kTrajectoryFile, "1 2 2 3", "1 2 2 3 4", ":2: more than 8 values"},
    {kTrajectoryFile, "1 2 2 3", "-1 2 2 3", ":2: time -1 s goes back"},
    {kTrajectoryFile, "0 0 0 1", "0 0 0 2", ":2: qx qy qz qw are no unit quaternion"},
    {kTrajectoryFile, "1 2 2 3", "1 1e30 2 3", ":2: stands at 1e+30 2 3"},
    {kTrajectoryFile, kPath, "", ": holds no pose"},
    {kCandidatesFile, "collision", "unlucky", ":1: rejected: no such reason"},
    {kCandidatesFile, "fvs", "luck", ":1: sampler: no sampler is named luck"},
    {kCandidatesFile, "2,\"rej", "-2,\"rej", ":1: cluster: is no whole number from 0 on"},
    {kCandidatesFile, "\"yaw_rad\":0,", "", ":1: key 'yaw_rad' not found; `gnbv run"},
    {kCandidatesFile, "1,\"y_m", "", ":1: "},
    {kBeliefsFile, "2}", "2,\"unknown\":[0,101]}", ":2: runs end beyond the 100 voxels"},
    {kBeliefsFile, "2}", "2,\"frontier\":[99,18446744073709551615]}", ":2: runs end beyond"},
    {kBeliefsFile, "2}", "2,\"unknown\":[0,1,2]}", ":2: is no list of gaps and lengths"},
    {kBeliefsFile, "2}", "2,\"unknown\":[-1,1]}", ":2: is no list"},
    {kBeliefsFile, "2}", "2,\"unknown\":[0.5,1]}", ":2: is no list"},
    {kBeliefsFile, "2}", "2,\"unknown\":{}}", ":2: is no list"},
    {kBeliefsFile, "2}", "2,\"unknown\":[3,0]}", ":2: runs are longer, and apart"},
    {kBeliefsFile, "2}", "2,\"unknown\":[0,1,0,1]}", ":2: runs are longer, and apart"},
    {kBeliefsFile, "2}", "-1}", ":2: is of no decision"},
    {kBeliefsFile, "2}", "2,", ":2: "},
    {kBeliefsFile, "{\"iteration\":2}", "[]", ":2: is of no decision"},
    {kPlanFile, "\n", "\n" + kPlans, ":2: iteration 1 comes after 1"},
    {kPlanFile, ":1,", ":-2,", ":1: iteration -2 is none"},
    {kPlanFile, "\"x_m\":2.0", "\"x_m\":\"two\"", ":1: "},
    {kPlanFile, "\"x_m\":2.0", "\"x_m\":2e9", ":1: stands at 2e+09 2 2 m"},
    {kPlanFile, "[0,0,3,12.5]", "[0,0,3]", ":1: "},
    {kPlanFile, "12.5", "-1", ":1: a cube of -1 voxels"},
    {kPlanFile, "}\n", "", ":1: "},
    {kPredictionsFile, "opposite", "behind", ":3: 'behind' is no source"},
    {kPredictionsFile, ",45,", ",44,", ":3: '44' is no"},
    {kPredictionsFile, ",4,65,", ",5,65,", ":2: looks 5 must be less than 5"},
    {kPredictionsFile, ",5.5,", ",", ":3: '2,opposite"},
    {kPredictionsFile, ",5.5,", ",many,", ":3: promised `many` is not a number"},
    {kPredictionsFile, "missing,", "", ":1: is not the header"},
    {"frames/poses.csv", "2,c,", "2,other,", ":4: camera `other` is not in cameras.json"},
    {"frames/poses.csv", "0,0,0,1", "0,0,1,1", ":4: qx qy qz qw are no unit quaternion"},
    {"frames/poses.csv", "c,5,", "c,soon,", ":4: time or pose `soon` is not a number"},
    {"frames/poses.csv", ",2.png", ",../2.png", ":4: no image"},
    {"frames/poses.csv", "iteration,", "view,", ":1: is not the header"},
    {"frames/cameras.json", "\"fx_px\": 32,", "", ": key 'fx_px' not found"},
    {"frames/cameras.json", "64", "0", ": camera 'c': sizes, focal lengths"}};

TEST_F(DamagedFile, IsNamedWithTheLine) {
  for (const auto& [file, read] : readers_) EXPECT_EQ(test::fault_of(read), "") << file;
  for (const auto& [file, from, to, words] : kDamages) {
    SCOPED_TRACE(file + ": " + to);
    const std::string good = read_file(run_ / file);
    ASSERT_NE(good.rfind(from), std::string::npos) << from;
    write_file_atomically(run_ / file,
                          std::string(good).replace(good.rfind(from), from.size(), to));
    EXPECT_TRUE(test::says(test::fault_of(readers_.at(file)), {file + words}));
    write_file_atomically(run_ / file, good);
  }
}

TEST_F(DamagedFile, ListsDeeperThanTheStackAreRefused) {
  const std::string deep(200'000, '['), brackets(300, '[');
  write_file_atomically(run_ / kSummaryFile, R"({"\"":")" + brackets + R"(","schema":)" + deep);
  EXPECT_TRUE(test::says(test::fault_of([&] { read_run(run_); }),
                         {"summary.json: its JSON is more than 200 deep"}));
  write_file_atomically(run_ / kSummaryFile, R"({"\"":")" + brackets + "\"}");
  EXPECT_TRUE(test::says(test::fault_of([&] { read_run(run_); }), {"schema"}));
}

}  // namespace
}  // namespace gnbv
