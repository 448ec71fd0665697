// Laws of groups and labels: runs are one group when nothing but their seeds tells them apart, and
// a label says what does.
#include "tools/run/run_groups.hpp"

#include <gtest/gtest.h>

#include "tests/support/covered_record.hpp"

namespace gnbv {
namespace {

TEST(RunGroups, RunsOfOneMethodAreOneGroup) {
  std::vector<RunRecord> runs = {covered_record(1, {0.2}), covered_record(2, {0.2}),
                                 covered_record(1, {0.2}), covered_record(1, {0.2})};
  runs[3].scenario.planner.cloud.leaf_m = 0.07;
  std::vector<std::string> notes;
  const std::vector<RunGroup> groups = group_runs(runs, notes);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].runs.size(), 2U);
  EXPECT_EQ(groups[0].label, "leaf_m=0.05");
  EXPECT_EQ(groups[1].label, "leaf_m=0.07");
  EXPECT_EQ(notes.size(), 1U);
  runs.push_back(made_record());  // never scored
  notes.clear();
  EXPECT_EQ(group_runs(runs, notes).size(), 2U);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[1].find("has no figures"), std::string::npos) << notes[1];
  runs[3].scenario.planner.utility.name = "isler";
  EXPECT_EQ(group_runs(runs, notes)[1].label, "Isler");
}

/// Only what tells it from others of its name is said of a group, and a label is never a list.
TEST(RunGroups, LabelsSayNoMoreThanIsNeeded) {
  std::vector<RunRecord> runs(4, covered_record(1, {0.2}));
  runs[1].scenario.planner.cloud.leaf_m = 0.07;
  runs[2].scenario.name = "lab";
  runs[2].scenario.planner.map.resolution_m = 0.1;
  runs[2].scenario.planner.floor_z_m = 0.4;
  const auto labels = [&] {
    std::vector<std::string> notes;
    std::vector<std::string> all;
    for (const RunGroup& group : group_runs(runs, notes)) all.push_back(group.label);
    return all;
  };
  EXPECT_EQ(labels(),
            (std::vector<std::string>{"Smoke, leaf_m=0.05", "Smoke, leaf_m=0.07", "Lab"}));
  runs[1].scenario.planner.map.resolution_m = 0.1;
  runs[1].scenario.planner.floor_z_m = 0.4;
  runs[0].folder = "runs/a";
  runs[1].folder = "runs/b";
  EXPECT_EQ(labels(), (std::vector<std::string>{"Smoke, a", "Smoke, b", "Lab"}));
  runs[3].scenario.structure.builtin.clear();
  runs[3].scenario.structure.file.path = "/meshes/my_a340.obj";  // whose other keys follow from it
  runs[3].scenario.planner.floor_z_m = 0.4;
  EXPECT_EQ(labels().back(), "Smoke (my_a340.obj)");
  runs.resize(2);
  runs[1].scenario = runs[0].scenario;
  runs[0].scenario.cameras[0].rate_hz = runs[0].scenario.lidars[0].rate_hz = 1.0;
  runs[1].scenario.cameras[0].rate_hz = runs[1].scenario.lidars[0].rate_hz = 2.0;
  EXPECT_EQ(labels()[1], "cameras.0.rate_hz=2, lidars.0.rate_hz=2");
}

TEST(RunLabels, RunsAreToldApartByAsMuchAsItTakes) {
  RunRecord a = made_record();
  a.folder = "runs/a";
  RunRecord b = a;
  b.folder = "runs/b";
  RunRecord c = a;
  c.scenario.planner.utility.name = "bircher";
  RunRecord d = c;
  d.scenario.seed = 2;
  using Labels = std::vector<std::string>;
  const auto labels = [](const std::vector<RunRecord>& runs) { return run_labels(runs); };
  EXPECT_EQ(labels({a, c}), (Labels{"Smoke, Proposed", "Smoke, Bircher"}));
  EXPECT_EQ(labels({c, d}), (Labels{"Smoke, Bircher, seed 1", "Smoke, Bircher, seed 2"}));
  EXPECT_EQ(labels({a, b})[1], "Smoke, Proposed, seed 1 (b)");
  b.folder = "/else/where/a";
  EXPECT_EQ(labels({a, b}), (Labels{"Smoke, Proposed, seed 1 (runs/a)",  //
                                    "Smoke, Proposed, seed 1 (where/a)"}));
  a.folder = "runs/./a/";
  EXPECT_EQ(labels({a, b})[0], "Smoke, Proposed, seed 1 (runs/a)");
  EXPECT_EQ(labels({a, a})[0], "Smoke, Proposed, seed 1 (runs/a)");
  b.scenario.planner.cloud.leaf_m = 0.07;
  EXPECT_EQ(labels({a, b, c}), (Labels{"Smoke, Proposed, leaf_m=0.05",
                                       "Smoke, Proposed, leaf_m=0.07", "Smoke, Bircher"}));
}

/// The utility has a column of its own in tables.
TEST(RunGroups, SettingsAreWhatDiffersBesideTheUtility) {
  std::vector<RunRecord> runs(3, covered_record(1, {0.2}));
  runs[1].scenario.planner.utility.name = "isler";
  const auto settings = [&] {
    std::vector<std::string> notes;
    return setting_labels(group_runs(runs, notes));
  };
  EXPECT_EQ(settings(), (std::vector<std::string>(2)));
  runs[2].scenario.planner.preset = "released";
  EXPECT_EQ(settings(), (std::vector<std::string>{"paper", "paper", "released"}));
}

}  // namespace
}  // namespace gnbv
