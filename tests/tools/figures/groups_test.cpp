// Laws of groups, labels and looks: runs are one group when nothing but their seeds tells them
// apart, a label says what does, and a method looks the same in whatever company.
#include "tools/figures/groups.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "tests/support/covered_record.hpp"
#include "tests/support/fault.hpp"
#include "tools/figures/runs_to_figures.hpp"

namespace gnbv {
namespace {

using Names = std::vector<std::string>;

Names group_labels(const std::vector<RunRecord>& runs) {
  Names notes, labels;
  for (const RunGroup& group : group_runs(runs, notes)) labels.push_back(group.label);
  return labels;
}

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
  EXPECT_EQ(group_labels(runs), (Names{"Smoke, leaf_m=0.05", "Smoke, leaf_m=0.07", "Lab"}));
  runs[1].scenario.planner.map.resolution_m = 0.1;
  runs[1].scenario.planner.floor_z_m = 0.4;
  runs[0].folder = "runs/a";
  runs[1].folder = "runs/b";
  EXPECT_EQ(group_labels(runs), (Names{"Smoke, a", "Smoke, b", "Lab"}));
  runs[3].scenario.structure.builtin.clear();
  runs[3].scenario.structure.file.path = "/meshes/my_a340.obj";  // whose other keys follow from it
  runs[3].scenario.planner.floor_z_m = 0.4;
  EXPECT_EQ(group_labels(runs).back(), "Smoke (my_a340.obj)");
  runs.resize(2);
  runs[1].scenario = runs[0].scenario;
  runs[0].scenario.cameras[0].rate_hz = runs[0].scenario.lidars[0].rate_hz = 1.0;
  runs[1].scenario.cameras[0].rate_hz = runs[1].scenario.lidars[0].rate_hz = 2.0;
  EXPECT_EQ(group_labels(runs)[1], "cameras.0.rate_hz=2, lidars.0.rate_hz=2");
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
  const auto labels = [](const std::vector<RunRecord>& runs) { return run_labels(runs); };
  EXPECT_EQ(labels({a, c}), (Names{"Smoke, Proposed", "Smoke, Bircher"}));
  EXPECT_EQ(labels({c, d}), (Names{"Smoke, Bircher, seed 1", "Smoke, Bircher, seed 2"}));
  EXPECT_EQ(labels({a, b})[1], "Smoke, Proposed, seed 1 (b)");
  b.folder = "/else/where/a";
  EXPECT_EQ(labels({a, b}), (Names{"Smoke, Proposed, seed 1 (runs/a)",  //
                                   "Smoke, Proposed, seed 1 (where/a)"}));
  a.folder = "runs/./a/";
  EXPECT_EQ(labels({a, b})[0], "Smoke, Proposed, seed 1 (runs/a)");
  EXPECT_EQ(labels({a, a})[0], "Smoke, Proposed, seed 1 (runs/a)");
  b.scenario.planner.cloud.leaf_m = 0.07;
  EXPECT_EQ(labels({a, b, c}), (Names{"Smoke, Proposed, leaf_m=0.05",
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
  EXPECT_EQ(settings(), Names(2));
  runs[2].scenario.planner.preset = "released";
  EXPECT_EQ(settings(), (Names{"paper", "paper", "released"}));
}

/// A function of the user's own, once as it is asked and once as the views that it gave.
TEST(RunGroups, AFunctionOfTheUsersIsOneMethodWhateverViewsItGave) {
  std::vector<RunRecord> runs;
  const auto add = [&](std::uint64_t seed, std::string_view name, UserFunctionConfig function) {
    RunRecord& run = runs.emplace_back(covered_record(seed, {0.2}));
    run.scenario.planner.utility.name = name;
    run.scenario.planner.utility.python = std::move(function);
    if (name != kRouteName) return;
    run.scenario.planner.routes.views = {{Vec3(static_cast<double>(seed), 0, 1)}};
  };
  const UserFunctionConfig mine = {.file = "a.py", .function = "mine", .source = "def mine(): 1"};
  const auto kPlanner = UserFunctionKind::planner;
  add(1, "proposed", {});
  for (const std::uint64_t seed : {1, 2, 3}) add(seed, kUserUtilityName, mine);
  for (const std::uint64_t seed : {1, 2, 3}) {
    add(seed, kRouteName, {.kind = kPlanner, .file = "a.py", .function = "plan", .source = "p"});
  }
  EXPECT_EQ(group_labels(runs), (Names{"Proposed", "mine", "plan"}));
  add(1, kUserUtilityName, {.label = "my own", .function = "mine", .source = "x"});
  add(1, kUserUtilityName, {.file = "b.py", .function = "mine", .source = "def mine(): 2"});
  EXPECT_EQ(group_labels(runs), (Names{"Proposed", "a.py:mine", "plan", "my own", "b.py:mine"}));
}

/// Grouping that compares all with all would take hours.
TEST(RunGroups, ThousandsOfConfigurationsAreGroupedAtOnce) {
  std::vector<RunRecord> runs;
  for (int i = 0; i < 2000; ++i) {
    runs.push_back(covered_record(1, {0.2}));
    runs.back().scenario.planner.cloud.leaf_m = 0.01 + 1e-5 * i;
    runs.back().folder = "run";
  }
  const std::vector<std::string> labels = group_labels(runs);
  EXPECT_EQ(std::set<std::string>(labels.begin(), labels.end()).size(), runs.size());
  EXPECT_EQ(run_labels(runs).size(), runs.size());
}

TEST(RunNames, AreThoseOfTheFoldersHoweverTheirPathsAreWrittenAndUnique) {
  const auto names = [](const std::vector<std::filesystem::path>& folders) {
    return run_names(folders);
  };
  EXPECT_EQ(names({"x/run", "x/other/", "x/./third/../fourth//"}),
            (Names{"run", "other", "fourth"}));
  EXPECT_EQ(names({"."}), Names{std::filesystem::current_path().filename()});
  EXPECT_EQ(names({"x/run", "y/run", "z/run/"}), (Names{"run", "run-2", "run-3"}));
  const Names made = names({"x/run", "y/run", "x/run-2"});  // a name that another's number made
  EXPECT_EQ(std::set<std::string>(made.begin(), made.end()).size(), 3U);
  EXPECT_TRUE(names({}).empty());
}

TEST(Looks, AMethodHasItsOwnInWhateverCompanyAndStrangersTakeWhatIsLeft) {
  using Slots = std::vector<std::size_t>;
  const auto slots = [](const std::vector<std::string>& methods) { return method_slots(methods); };
  EXPECT_EQ(slots({"tour", "proposed"}), (Slots{3, 0}));
  EXPECT_EQ(slots({"isler", "proposed", "bircher", "tour"}), (Slots{2, 0, 1, 3}));
  EXPECT_EQ(slots({"mine", "proposed", "tour", "proposed", "yours"}), (Slots{1, 0, 3, 2, 4}));
  Slots all(14);
  std::iota(all.begin(), all.end(), std::size_t{0});
  EXPECT_EQ(slots(std::vector<std::string>(14, "mine")), all);
  RunRecord run = made_record();
  EXPECT_EQ(method_of(run), "proposed");
  run.scenario.planner.preset = "released";
  EXPECT_EQ(method_of(run), "released");
}

/// Curves hide each other: two methods differ in more than their colour.
TEST(Looks, NeighboursDifferInDashesAndAllInColourOrDashes) {
  std::set<std::pair<std::string, std::vector<double>>> looks;
  for (std::size_t slot = 0; slot < 35; ++slot) {
    const SeriesLook look = look_of_slot(slot);
    looks.emplace(look.colour, look.dashes);
    EXPECT_NE(look.dashes, look_of_slot(slot + 1).dashes) << slot;
    EXPECT_NE(look.colour, look_of_slot(slot + 1).colour) << slot;
  }
  EXPECT_EQ(looks.size(), 35U);
}

TEST(DressGroups, NamesColoursAndOrderAreTheUsers) {
  std::vector<RunRecord> runs(3, covered_record(1, {0.2}));
  runs[1].scenario.planner.utility.name = "isler";
  runs[2].scenario.planner.utility.name = "bircher";
  std::vector<std::string> notes;
  std::vector<RunGroup> groups = group_runs(runs, notes);
  FigureRequest request{.labels = {"Isler=Isler = 2016", " here", "3=B"},
                        .colours = {"proposed=#ABCDEF"},
                        .order = {"bircher", "Isler"}};
  dress_groups(groups, request);
  EXPECT_EQ(groups[0].label, "B");
  EXPECT_EQ(groups[1].label, "Isler = 2016, here");
  EXPECT_EQ(groups[2].label, "Proposed");
  EXPECT_EQ(groups[2].look.colour, "#abcdef");
  for (const auto& [bad, words] : std::vector<std::pair<FigureRequest, std::string>>{
           {{.labels = {"Ilser=x"}}, "--labels: value 'Ilser': no such group; there are: B, "},
           {{.labels = {"x"}}, "--labels: value 'x': must be GROUP=VALUE"},
           {{.colours = {"1=red"}}, "--colors: value '1=red': a colour is #rrggbb"},
           {{.order = {"4"}}, "--order: value '4': no such group"}}) {
    EXPECT_TRUE(
        test::says(test::fault_of([&, &bad = bad] { dress_groups(groups, bad); }), {words}));
  }
}

}  // namespace
}  // namespace gnbv
