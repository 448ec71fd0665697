#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bench/compare/compared_runs.hpp"

namespace gnbv {
namespace {

/// `better` covers 2 points more than `base` in every seed, give or take a little.
std::vector<ComparedRun> clear_cut(int seeds) {
  std::vector<ComparedRun> runs;
  for (const std::string method : {"base", "better"}) {
    for (int s = 0; s < seeds; ++s) {
      const double spread = 0.01 * (s % 3) + 0.0001 * s * (method == "better" ? 1 : 0);
      const double gain = method == "better" ? 0.02 : 0.0;
      runs.push_back(run(method, static_cast<std::uint64_t>(s), 0.9 + spread + gain,
                         method == "better" ? 500.0 - s : 1000.0));
    }
  }
  return runs;
}

const Contrast& coverage_contrast(const Comparison& c, std::size_t method) {
  return *find_figure(c, 0, kCoverageMetric, method)->contrast;
}

TEST(Compare, MeansDifferencesAndIntervalsAreTheTextbooks) {
  const std::vector<ComparedRun> runs = {run("a", 1, 0.90, 100), run("a", 2, 0.92, 100),
                                         run("b", 1, 0.91, 90), run("b", 2, 0.95, 80),
                                         run("b", 3, 0.50, 70)};  // a seed that `a` lacks
  const Comparison c = compare(runs, "a", {});
  const MethodFigure& b = *find_figure(c, 0, kCoverageMetric, 1);
  EXPECT_EQ(b.estimate.n, 3U);
  EXPECT_NEAR(b.estimate.mean, 100.0 * (0.91 + 0.95 + 0.50) / 3, 1e-9);
  ASSERT_TRUE(b.contrast);
  EXPECT_EQ(b.contrast->difference.n, 2U);
  EXPECT_NEAR(b.contrast->difference.mean, 2.0, 1e-9);             // of 1 and 3 points
  EXPECT_NEAR(*b.contrast->difference.half_width, 12.7062, 1e-3);  // deviation sqrt 2, over sqrt 2
  EXPECT_NEAR(b.contrast->baseline_mean, 91.0, 1e-9);
  EXPECT_EQ(b.contrast->test.p, 0.5);  // two of two positive
  EXPECT_EQ(b.contrast->verdict, Verdict::too_few);
  EXPECT_FALSE(find_figure(c, 0, kCoverageMetric, 0)->contrast);
}

/// What so few seeds cannot say is said, by the number of them and of the methods.
TEST(Compare, TheTestSaysHowManySeedsItTakes) {
  const Comparison five = compare(clear_cut(5), "base", {});
  EXPECT_EQ(coverage_contrast(five, 1).test.p, 0.0625);
  EXPECT_EQ(coverage_contrast(five, 1).verdict, Verdict::too_few);
  EXPECT_TRUE(notes_say(five, "with fewer than 6 seeds that differ; 5 have p = 0.0625 at best"));
  EXPECT_NE(answers(five)[0].find("n = 5 seeds: too few seeds)"), std::string::npos);
  std::vector<ComparedRun> runs = clear_cut(6);
  const Comparison six = compare(runs, "base", {});
  EXPECT_EQ(coverage_contrast(six, 1).test.p, 0.03125);
  EXPECT_EQ(coverage_contrast(six, 1).verdict, Verdict::significant);
  for (int s = 0; s < 6; ++s) {
    const auto seed = static_cast<std::uint64_t>(s);
    runs.push_back(run("noise", seed, 0.9 + 0.01 * (s % 3) + (s % 2 == 0 ? 0.01 : -0.012), 1000.0));
  }
  const Comparison three = compare(runs, "base", {});
  EXPECT_DOUBLE_EQ(coverage_contrast(three, 1).p_holm, 0.0625);
  // with two methods six seeds cannot reach 5 % any more
  EXPECT_EQ(coverage_contrast(three, 1).verdict, Verdict::too_few);
  EXPECT_EQ(coverage_contrast(three, 2).verdict, Verdict::too_few);
  EXPECT_TRUE(notes_say(three,
                        "fewer than 7 seeds that differ; 6 have p = 0.0625 at best, after "
                        "Holm over 2 methods"));
  // a seed without a difference gives the test no power
  runs = clear_cut(6);
  runs[6].figures.coverage_final = runs[0].figures.coverage_final;
  const Comparison equal = compare(runs, "base", {});
  EXPECT_EQ(coverage_contrast(equal, 1).difference.n, 6U);
  EXPECT_EQ(coverage_contrast(equal, 1).test.n, 5U);
  EXPECT_EQ(coverage_contrast(equal, 1).test.p, 0.0625);  // two of 2^5 signs
  EXPECT_EQ(coverage_contrast(equal, 1).verdict, Verdict::too_few);
  EXPECT_NE(answers(equal)[0].find("too few seeds that differ"), std::string::npos);
}

/// Where nothing can be told apart, and where there is too little to tell it by.
TEST(Compare, AnAnswerSaysNoMoreThanTheSeedsDo) {
  const auto answer = [](int seeds, double coverage, double metres) {
    std::vector<ComparedRun> runs;
    for (int s = 0; s < seeds; ++s) {
      runs.push_back(run("a", static_cast<std::uint64_t>(s), 0.9, 100));
      runs.push_back(run("b", static_cast<std::uint64_t>(s), coverage, metres));
    }
    const Comparison c = compare(runs, "a", {});
    return std::pair(coverage_contrast(c, 1).verdict, answers(c)[0]);
  };
  using Answer = std::pair<Verdict, std::string>;
  EXPECT_EQ(answer(8, 0.9, 100),
            Answer(Verdict::equal, "aircraft: b covers as much as a in as many metres"));
  EXPECT_EQ(answer(1, 0.92, 50),
            Answer(Verdict::untested,
                   "aircraft: b covers 2.0 points more than a at 0.05 m (one seed: no test) in "
                   "50.0 m less, 50 %"));
  EXPECT_EQ(answer(1, 0.9, 100),
            Answer(Verdict::untested,
                   "aircraft: b covers as much as a (one seed: no test) in as many metres"));
  // differences 2.00, 2.01, ... 2.05 points: mean 2.025, and 500 to 505 m
  EXPECT_EQ(answers(compare(clear_cut(6), "base", {}))[0],
            "aircraft: better covers 2.0 points more than base at 0.05 m (95 % CI 2.0 to 2.0, p = "
            "0.031, n = 6 seeds: significant) in 502.5 m less, 50 % (95 % CI 500.5 to 504.5 m)");
}

TEST(Compare, MethodsThatFlewTheSameMissionsAreNamed) {
  std::vector<ComparedRun> runs = clear_cut(3);
  for (ComparedRun& run : runs) {
    run.figures.result_sha256 = fmt::format("{} {}", run.method, run.seed);
  }
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    ComparedRun copy = runs.front();
    copy.method = "idle switch";
    copy.seed = seed;
    copy.figures.result_sha256 = fmt::format("base {}", seed);
    runs.push_back(copy);
  }
  EXPECT_TRUE(notes_say(compare(runs, "base", {}), "idle switch flew the very missions of base: "));
  runs.back().figures.result_sha256 = "another";
  EXPECT_FALSE(notes_say(compare(runs, "base", {}), "the very missions"));
}

TEST(Compare, SeedsThatFlewOneAndTheSameMissionAreOneObservation) {
  std::vector<ComparedRun> runs;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const auto& [method, coverage] : {std::pair("a", 0.90), std::pair("b", 0.92)}) {
      runs.push_back(run(method, seed, coverage, 100));
      runs.back().figures.result_sha256 = method;
    }
  }
  const Comparison one = compare(runs, "a", {});
  EXPECT_EQ(coverage_contrast(one, 1).verdict, Verdict::untested);
  EXPECT_EQ(find_figure(one, 0, kCoverageMetric, 1)->estimate.n, 1U);
  EXPECT_TRUE(notes_say(one, "aircraft: nothing varies over the seeds"));
  for (ComparedRun& run : runs) {
    if (run.method == "b") run.figures.result_sha256 += fmt::format("{}", run.seed);
  }
  const Comparison drawn = compare(runs, "a", {});
  EXPECT_EQ(coverage_contrast(drawn, 1).difference.n, 6U);
  EXPECT_TRUE(notes_say(drawn, "aircraft: what a planner draws by them is all that varies"));
}

/// Coverage is cut there, distances are of the whole cloud.
TEST(Compare, ViewsBeyondTheBudgetWinNoVerdict) {
  std::vector<MissionRow> rows;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    for (const std::string method : {"base", "longer"}) {
      const bool is_longer = method == "longer";
      MissionRow& row = rows.emplace_back(mission_row(run(method, seed, 0.9, 100).figures));
      row.scenario = "aircraft";
      row.method = method;
      row.seed = seed;
      row.figures["f_0.05"] = (is_longer ? 0.9 : 0.8) + 0.001 * static_cast<double>(seed);
      row.figures["iterations"] = is_longer ? 30.0 : 20.0;
      row.figures["within_iterations"] = 20.0;
    }
  }
  constexpr std::string_view kF = "F at 0.05 m (%)";
  const Comparison c = compare(rows, "base");
  EXPECT_EQ(find_figure(c, 0, kF, 1)->contrast->verdict, Verdict::told);
  EXPECT_EQ(coverage_contrast(c, 1).verdict, Verdict::equal);
  EXPECT_TRUE(notes_say(c, "aircraft: some missions took more views than the budget"));
  for (MissionRow& row : rows) row.figures["within_iterations"] = row.figures["iterations"];
  EXPECT_EQ(find_figure(compare(rows, "base"), 0, kF, 1)->contrast->verdict, Verdict::significant);
}

TEST(Compare, WhatDiffersInItsLastBitsIsEqual) {
  std::vector<ComparedRun> runs;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    runs.push_back(run("a", seed, 0.3, 100));
    runs.push_back(run("b", seed, 0.1 + 0.2, 100));
  }
  const Comparison c = compare(runs, "a", {});
  EXPECT_EQ(coverage_contrast(c, 1).verdict, Verdict::equal);
  EXPECT_EQ(find_figure(c, 0, kCoverageMetric, 1)->rank, 1.5);
}

TEST(Compare, MeanCoverageIsOverTheBudgetOfTheScenario) {
  const std::vector<ComparedRun> runs = {run("short", 1, 0.8, 50), run("long", 1, 0.8, 200)};
  const Comparison c = compare(runs, "short", {});
  EXPECT_EQ(c.budgets[0][1], 200.0);
  // nothing up to 50 m, then 0.8: mean over 200 m is 0.8 (1 - 50/200)
  EXPECT_NEAR(find_figure(c, 0, "mean coverage over metres (%)", 0)->estimate.mean, 60.0, 1e-9);
  EXPECT_NEAR(find_figure(c, 0, "mean coverage over metres (%)", 1)->estimate.mean, 0.0, 1e-9);
}

TEST(Compare, WhatWasNotMeasuredIsNotCompared) {
  std::vector<ComparedRun> runs = clear_cut(2);
  for (ComparedRun& run : runs) run.figures.curve = {};
  const Comparison c = compare(runs, "base", {});
  for (const std::string_view metric :
       {"mean coverage over views (%)", "F at 0.05 m (%)", "share of ceiling at 0.05 m (%)",
        "metres to 90 % of ceiling"}) {
    EXPECT_EQ(find_figure(c, 0, metric, 0), nullptr) << metric;
  }
  EXPECT_FALSE(notes_say(c, "of ceiling: until"));
}

TEST(Compare, AllMethodsOfAScenarioHaveOneCeiling) {
  const std::vector<ComparedRun> runs = {run("coarse", 1, 0.4, 50), run("fine", 1, 0.8, 50),
                                         run("fine", 1, 0.8, 50, "other")};
  const Comparison c = compare(runs, "coarse", ceiling_at(0.5));
  const auto share = [&](std::size_t scenario, std::size_t method) {
    return find_figure(c, scenario, "share of ceiling at 0.05 m (%)", method);
  };
  ASSERT_NE(share(0, 1), nullptr);
  EXPECT_NEAR(share(0, 0)->estimate.mean, 80.0, 1e-9);
  EXPECT_NEAR(share(0, 1)->estimate.mean, 160.0, 1e-9);
  EXPECT_EQ(share(1, 1), nullptr);  // without a ceiling no share
}

/// Ranks and test count a run that does not get there as the worst, means as the budget.
TEST(Compare, AMissionThatDiesEarlyWinsNoVerdict) {
  std::vector<ComparedRun> runs;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    runs.push_back(climbing("whole", seed, 9, 10.0 + 0.1 * static_cast<double>(seed)));
    // half the metres a view, but most crash after two
    runs.push_back(climbing("dies", seed, seed == 3 ? 9 : 2, 5.0));
    runs.back().figures.flight_time_s = 10.0;
    runs.back().figures.entropy_reduction_nat = 9.0;
  }
  const Comparison c = compare(runs, "whole", ceiling_at(1.0));
  for (const MethodFigure& figure : c.figures) {
    if (figure.method == 0) continue;
    const RunMetric& metric = c.metrics[figure.metric];
    const Contrast& contrast = *figure.contrast;
    EXPECT_EQ(contrast.verdict == Verdict::told, !metric.is_judged) << metric.name;
    EXPECT_EQ(figure.rank.has_value(), metric.is_judged) << metric.name;
    EXPECT_FALSE(contrast.verdict == Verdict::significant &&
                 contrast.test.is_above() == metric.higher_is_better)
        << metric.name;
  }
  EXPECT_EQ(find_figure(c, 0, kDistanceMetric, 1)->contrast->verdict, Verdict::told);
  EXPECT_LT(find_figure(c, 0, kDistanceMetric, 1)->contrast->difference.mean, 0.0);
  EXPECT_TRUE(coverage_contrast(c, 1).verdict == Verdict::significant);
  const double budget_m = c.budgets[0][1];
  EXPECT_NEAR(budget_m, 9 * 10.8, 1e-9);
  const MethodFigure& whole = *find_figure(c, 0, kTo90, 0);
  const MethodFigure& dies = *find_figure(c, 0, kTo90, 1);
  EXPECT_EQ(whole.reached, 8U);
  EXPECT_NEAR(*whole.median, 9 * 10.45, 1e-9);
  EXPECT_EQ(dies.reached, 1U);
  EXPECT_EQ(dies.estimate.n, 8U);
  EXPECT_EQ(dies.median, std::nullopt);
  EXPECT_NEAR(dies.estimate.mean, (7 * budget_m + 45.0) / 8, 1e-9);
  // with the profile the budget has it, too: 105 m
  EXPECT_NEAR(find_figure(c, 0, "metres to 90 % of ceiling, from take-off", 1)->estimate.mean,
              dies.estimate.mean + 105.0, 1e-9);
  // ranks: worst in seven seeds, best in the one where it got there
  EXPECT_DOUBLE_EQ(*dies.rank, (7 * 2 + 1) / 8.0);
  const Contrast& contrast = *dies.contrast;
  EXPECT_NEAR(contrast.difference.mean, dies.estimate.mean - whole.estimate.mean, 1e-9);
  EXPECT_EQ(contrast.test.p, 2.0 * 2 / 256);  // the one negative difference is the smallest in size
  EXPECT_EQ(contrast.verdict, Verdict::significant);
  const TextTable table = comparison_table(c);
  for (const auto& each : table.rows) EXPECT_EQ(each.size(), table.columns.size());
  const auto row = std::find_if(table.rows.begin(), table.rows.end(), [](const auto& r) {
    return r[1].text == kTo90 && r[2].text == "dies";
  });
  ASSERT_NE(row, table.rows.end());
  EXPECT_EQ((*row)[3].text, "1 of 8");
  EXPECT_EQ((*row)[5].text, "-");
  EXPECT_EQ(row->back().text, "worse");
  EXPECT_TRUE(notes_say(c, "aircraft: no run got to 95 % of ceiling, 98 % of ceiling, 99 %"));
}

/// Each counts as the most that any method has by then, not as what it has spent itself.
TEST(Compare, WhoNeverGetsThereIsNoFasterForAShorterProfile) {
  std::vector<ComparedRun> runs;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    runs.push_back(climbing("profile", seed, 2, 10.0));
    runs.push_back(climbing("none", seed, 2, 10.0));
    runs.back().figures.before = {};
  }
  const Comparison c = compare(runs, "profile", ceiling_at(1.0));
  for (const std::string_view unit : {"metres", "seconds"}) {
    const auto metric = fmt::format("{} to 90 % of ceiling, from take-off", unit);
    EXPECT_EQ(find_figure(c, 0, metric, 1)->contrast->difference.mean, 0.0) << unit;
    EXPECT_EQ(find_figure(c, 0, metric, 1)->estimate.mean, unit == "metres" ? 125.0 : 62.0);
  }
}

TEST(Compare, EffortsWithTheProfileAddIt) {
  const std::vector<ComparedRun> runs = {climbing("a", 1, 10, 10.0), climbing("b", 1, 10, 20.0)};
  const Comparison c = compare(runs, "a", ceiling_at(1.0));
  const auto mean = [&](std::string_view metric) {
    return find_figure(c, 0, metric, 0)->estimate.mean;
  };
  EXPECT_EQ(mean("views to 80 % of ceiling"), 8.0);
  EXPECT_EQ(mean("metres to 80 % of ceiling"), 80.0);
  EXPECT_EQ(mean("metres to 80 % of ceiling, from take-off"), 185.0);
  EXPECT_EQ(mean("seconds to 80 % of ceiling, from take-off"), 68.0);
  EXPECT_EQ(mean("views to 99 % of ceiling"), 10.0);
}

TEST(Compare, TwoThatNeverGetThereAreEqual) {
  std::vector<ComparedRun> runs;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    runs.push_back(climbing("a", seed, 2, 10.0));
    runs.push_back(climbing("b", seed, 3, 10.0));
  }
  const Comparison c = compare(runs, "a", ceiling_at(1.0));
  EXPECT_EQ(find_figure(c, 0, kTo90, 1)->contrast->verdict, Verdict::equal);
  EXPECT_EQ(find_figure(c, 0, kTo90, 1)->rank, 1.5);
  EXPECT_EQ(find_figure(c, 0, kTo90, 1)->reached, 0U);
}

TEST(Compare, SaysWhatVariesAndWhatThePairsAre) {
  std::vector<ComparedRun> runs = clear_cut(3);
  EXPECT_TRUE(notes_say(compare(runs, "base", {}), "aircraft: the start is what varies"));
  EXPECT_TRUE(notes_say(compare(runs, "base", {}), "the pairs are the seeds of one structure"));
  runs[0].is_noisy = true;
  EXPECT_TRUE(notes_say(compare(runs, "base", {}), "aircraft: start and noise are what varies"));
  for (ComparedRun other : clear_cut(1)) {
    other.scenario = "other";
    runs.push_back(other);
  }
  EXPECT_TRUE(notes_say(compare(runs, "base", {}), "all 2 structures: the pairs are structures"));
}

}  // namespace
}  // namespace gnbv
