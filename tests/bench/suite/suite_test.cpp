// The suite's file, its scores and its intervals: closed forms and round trips.
#include "bench/suite/suite.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/suite/standings.hpp"
#include "bench/suite/submission.hpp"
#include "tests/support/fault.hpp"

namespace gnbv {
namespace {

using ::testing::HasSubstr;

/// Coverage c after the profile and after each view, at those metres and seconds.
CoverageCurve curve_of(const std::vector<double>& coverage, const std::vector<double>& metres,
                       const std::vector<double>& seconds = {}) {
  CoverageCurve curve;
  curve.metres = metres;
  curve.seconds = seconds.empty() ? metres : seconds;
  for (const double c : coverage) {
    curve.accurate.push_back({c, 1.0, 1.0});
    curve.coverage.push_back({1.0, 1.0, 1.0});  // counts nowhere
  }
  return curve;
}

TEST(TaskScore, AViewCountsFromWhereItWasTaken) {
  // 0.2 for 3 m, 0.5 for 2 m, 0.8 for the other 5 m
  const CoverageCurve curve = curve_of({0.2, 0.5, 0.8}, {0, 3, 5});
  EXPECT_DOUBLE_EQ(mean_coverage(curve, {}, Effort::metres, 10.0, false),
                   (3 * 0.2 + 2 * 0.5 + 5 * 0.8) / 10.0);
}

TEST(TaskScore, NothingCountsBeyondTheBudgetNorWhereTheVehicleWasLost) {
  const CoverageCurve curve = curve_of({0.2, 0.5, 0.8}, {0, 3, 5});
  EXPECT_DOUBLE_EQ(mean_coverage(curve, {}, Effort::metres, 4.0, false), (3 * 0.2 + 0.5) / 4.0);
  EXPECT_DOUBLE_EQ(mean_coverage(curve, {}, Effort::metres, 10.0, true),
                   (3 * 0.2 + 2 * 0.5) / 10.0);
}

TEST(TaskScore, SecondsCountFromTakeOffWithTheProfile) {
  // nothing for the profile's 20 s, 0.3 for 10 s, 0.6 for the other 30 s
  const CoverageCurve curve = curve_of({0.3, 0.6}, {0, 0}, {0, 10});
  const BeforeViews before{.profile_end_s = 20.0};
  EXPECT_DOUBLE_EQ(mean_coverage(curve, before, Effort::seconds_with_profile, 60.0, false),
                   (10 * 0.3 + 30 * 0.6) / 60.0);
}

TEST(TaskScore, EffortsAreToSharesOfTheCeilingWithinTheBudget) {
  const SuiteTask task{.track = "t", .structure = "s", .budget = 6.0, .ceiling = 0.8, .best = 0.5};
  RunFigures run;
  run.termination = "route_flown";
  run.curve = curve_of({0.1, 0.73, 0.77, 0.8}, {0, 2, 7, 9});
  const TaskFigures figures = task_figures(run, task, Effort::metres);
  EXPECT_EQ(figures.to_90, 2.0);
  EXPECT_EQ(figures.to_95, std::nullopt);  // at 7 m
  EXPECT_EQ(figures.coverage, 0.73);
  EXPECT_DOUBLE_EQ(figures.share, (2 * 0.1 + 4 * 0.73) / 6.0 / 0.5);
}

TEST(Bootstrap, OfZerosAndOnesIsTheBinomial) {
  // means of resamples are Binomial(10, 1/2) / 10, whose 2.5 % quantiles are 0.2 and 0.8
  const std::vector<double> values = {0, 1, 0, 1, 0, 1, 0, 1, 0, 1};
  const Interval interval = bootstrap_mean(values);
  EXPECT_DOUBLE_EQ(interval.mean, 0.5);
  EXPECT_DOUBLE_EQ(interval.low, 0.2);
  EXPECT_DOUBLE_EQ(interval.high, 0.8);
  const std::vector<double> same(5, 0.25);
  EXPECT_EQ(bootstrap_mean(same).low, 0.25);
  EXPECT_EQ(bootstrap_mean(same).high, 0.25);
}

TEST(Verdict, IsThatOfTheRanksAndNotOfTheMeans) {
  // seven structures in which the first one has less, and one in which it has so much more that its
  // mean is the higher one
  const std::vector<double> against = {-1, -2, -3, -4, -5, -6, -7, 90};
  std::vector<double> with = against;
  for (double& difference : with) difference = -difference;
  const auto verdict = [](const std::vector<double>& differences, double p) {
    return verdict_of({.test = wilcoxon_signed_rank(differences), .p = p}, false);
  };
  EXPECT_EQ(verdict(against, 0.04), "ahead by ranks (p = 0.040)");
  EXPECT_EQ(verdict(with, 0.04), "behind (p = 0.040)");
  EXPECT_EQ(verdict(against, 0.06), "not told apart (p = 0.060)");
  EXPECT_EQ(verdict(std::vector<double>(8, 0.0), 1.0), "equal");
  EXPECT_EQ(verdict({0, 0, 0, 1}, 1.0), "too few structures");
}

TEST(SuiteFile, ReadsWhatItWritesAndItsTracksAreApart) {
  const Suite suite = read_suite(std::string(builtin_suite()), "v1");
  EXPECT_EQ(read_suite(suite_yaml(suite), "again"), suite);
  Suite other = suite;
  other.tasks.back().budget += 1.0;
  const std::string last = suite.tasks.back().track;
  for (const SuiteTrack& track : suite.tracks) {
    const bool is_same = track_sha256(suite, track.name) == track_sha256(other, track.name);
    EXPECT_EQ(is_same, track.name != last) << track.name;
  }
}

TEST(SuiteFile, HoldsThePapersScenesThreeOfAKindAndSixteenHeldOut) {
  const Suite suite = read_suite(std::string(builtin_suite()), "v1");
  for (const char* const name : {"exact", "real", "takeoff"}) {
    std::map<std::string, int> sets;
    for (const SuiteTask& task : suite.tasks_of(name)) ++sets[suite.structure_of(task).set];
    EXPECT_EQ(sets, (std::map<std::string, int>{{"paper", 4}, {"public", 24}, {"held_out", 16}}));
  }
  EXPECT_EQ(suite.tasks_of("small").size(), 5U);
  for (const SuiteTask& task : suite.tasks_of("small")) EXPECT_TRUE(task.is_frozen());
}

/// Why the text is no suite.
std::string fault_of(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return test::fault_of([&] { read_suite(text, "s.yaml"); });
}

TEST(SuiteFile, FaultsNameLineAndKey) {
  const std::string good =
      "suite: gnbv\nversion: 1\ndrawn_from: \"abc\"\nstructures:\n"
      "  - {name: a, set: public, scenario: smoke}\n"
      "tracks:\n  - {name: t, effort: metres, what: \"w\"}\n"
      "tasks:\n  - {track: t, structure: a, budget: 5}\n";
  EXPECT_EQ(fault_of(good, "set", "set"), "");
  EXPECT_THAT(fault_of(good, "budget: 5", "budget: x"), HasSubstr("s.yaml:9: tasks.0.budget"));
  EXPECT_THAT(fault_of(good, "budget: 5", "budget: 5, bset: 1"), HasSubstr("did you mean 'best'"));
  EXPECT_THAT(fault_of(good, "structure: a", "structure: b"), HasSubstr("none of the structures"));
  EXPECT_THAT(fault_of(good, "scenario: smoke", "scenario: smoke, random: hall, seed: 1, draw: 1"),
              HasSubstr("structures.0.seed: value '1': does not follow"));
  EXPECT_THAT(fault_of(good, "metres", "hours"), HasSubstr("tracks.0.effort"));
  EXPECT_THAT(fault_of(good, "suite: gnbv", "suite: other"), HasSubstr("is no suite"));
}

}  // namespace
}  // namespace gnbv
