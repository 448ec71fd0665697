#include "bench/compare/comparison.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace gnbv {
namespace {

ComparedRun run(const std::string& method, std::uint64_t seed, double coverage, double metres,
                const std::string& scenario = "aircraft") {
  ComparedRun r{scenario, method, seed, {}};
  r.figures.coverage_final = {coverage, coverage, coverage};
  r.figures.straight_m = metres;
  r.figures.iterations = 2;
  r.figures.curve = {.coverage = {{0.0, 0.0, 0.0}, {coverage, 0.0, 0.0}},
                     .metres = {0.0, metres},
                     .seconds = {0.0, 10.0}};
  return r;
}

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

bool notes_say(const Comparison& comparison, std::string_view words) {
  const TextTable table = comparison_table(comparison);
  return std::any_of(table.notes.begin(), table.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
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
  EXPECT_EQ(b.contrast->pairs, 2U);
  EXPECT_NEAR(b.contrast->difference.mean, 2.0, 1e-9);             // of 1 and 3 points
  EXPECT_NEAR(*b.contrast->difference.half_width, 12.7062, 1e-3);  // deviation sqrt 2, over sqrt 2
  EXPECT_NEAR(b.contrast->baseline_mean, 91.0, 1e-9);
  EXPECT_EQ(b.contrast->p, 0.5);  // two of two positive
  EXPECT_EQ(b.contrast->verdict, Verdict::not_significant);
  EXPECT_FALSE(find_figure(c, 0, kCoverageMetric, 0)->contrast);
}

/// What so few seeds cannot say is said, by the number of them and of the methods.
TEST(Compare, TheTestSaysHowManySeedsItTakes) {
  const Comparison five = compare(clear_cut(5), "base", {});
  EXPECT_EQ(coverage_contrast(five, 1).p, 0.0625);
  EXPECT_EQ(coverage_contrast(five, 1).verdict, Verdict::interval_only);
  EXPECT_TRUE(notes_say(five, "at n = 5: no p of the signed-rank test can be below 0.0625"));
  EXPECT_TRUE(notes_say(five, "6 that differ could"));
  EXPECT_FALSE(notes_say(five, "not adjusted"));  // one method against the baseline
  EXPECT_NE(answers(five)[0].find("5 seeds are too few for the test"), std::string::npos);
  std::vector<ComparedRun> runs = clear_cut(6);
  const Comparison six = compare(runs, "base", {});
  EXPECT_EQ(coverage_contrast(six, 1).p, 0.03125);
  EXPECT_EQ(coverage_contrast(six, 1).verdict, Verdict::significant);
  EXPECT_FALSE(notes_say(six, "cannot reject"));
  for (int s = 0; s < 6; ++s) {
    const auto seed = static_cast<std::uint64_t>(s);
    runs.push_back(run("noise", seed, 0.9 + 0.01 * (s % 3) + (s % 2 == 0 ? 0.01 : -0.012), 1000.0));
  }
  const Comparison three = compare(runs, "base", {});
  EXPECT_DOUBLE_EQ(coverage_contrast(three, 1).p_holm, 0.0625);
  // with two methods six seeds cannot reach 5 % any more
  EXPECT_EQ(coverage_contrast(three, 1).verdict, Verdict::interval_only);
  EXPECT_EQ(coverage_contrast(three, 2).verdict, Verdict::not_significant);
  EXPECT_TRUE(notes_say(three, "7 that differ could"));
  EXPECT_TRUE(notes_say(three, "; the intervals are not adjusted for several methods"));
  // a seed without a difference gives the test no power
  runs = clear_cut(6);
  runs[6].figures.coverage_final = runs[0].figures.coverage_final;
  const Comparison equal = compare(runs, "base", {});
  EXPECT_EQ(coverage_contrast(equal, 1).pairs, 6U);
  EXPECT_EQ(coverage_contrast(equal, 1).differing, 5U);
  EXPECT_EQ(coverage_contrast(equal, 1).p, 0.0625);  // two of 2^5 signs
  EXPECT_EQ(coverage_contrast(equal, 1).verdict, Verdict::interval_only);
  EXPECT_TRUE(notes_say(equal, "at n = 6, 5 of them with a difference: no p"));
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
                   "50.0 m less, 50 % (one seed: no test)"));
  EXPECT_EQ(answer(1, 0.9, 100),
            Answer(Verdict::untested,
                   "aircraft: b covers as much as a (one seed: no test) in as many metres (one "
                   "seed: no test)"));
  // differences 2.00, 2.01, ... 2.05 points: mean 2.025, and 500 to 505 m
  EXPECT_EQ(
      answers(compare(clear_cut(6), "base", {}))[0],
      "aircraft: better covers 2.0 points more than base at 0.05 m (95 % CI 2.0 to 2.0, p = "
      "0.031, n = 6: significant) in 502.5 m less, 50 % (95 % CI 500.5 to 504.5 m, p = 0.031, "
      "n = 6: significant)");
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

TEST(Compare, BudgetsOfAreasAreTheLongestRuns) {
  const std::vector<ComparedRun> runs = {run("short", 1, 0.8, 50), run("long", 1, 0.8, 200)};
  const Comparison c = compare(runs, "short", {});
  EXPECT_EQ(c.budgets[0][1], 200.0);
  // nothing up to 50 m, then 0.8: mean over 200 m is 0.8 (1 - 50/200)
  EXPECT_NEAR(find_figure(c, 0, "AUC over metres (%)", 0)->estimate.mean, 60.0, 1e-9);
  EXPECT_NEAR(find_figure(c, 0, "AUC over metres (%)", 1)->estimate.mean, 0.0, 1e-9);
}

TEST(Compare, WhatWasNotMeasuredIsNotCompared) {
  std::vector<ComparedRun> runs = clear_cut(2);
  runs[0].figures.curve = {};
  const Comparison c = compare(runs, "base", {});
  for (const std::string_view metric :
       {"AUC over views (%)", "F at 0.05 m (%)", "share of ceiling at 0.05 m (%)",
        "metres to 90 % of ceiling"}) {
    EXPECT_EQ(find_figure(c, 0, metric, 0), nullptr) << metric;
  }
  EXPECT_FALSE(notes_say(c, "of ceiling: until"));
}

Ceilings ceilings_at(const std::map<std::string, double>& most) {
  Ceilings all;
  for (const auto& [method, coverage] : most) {
    all[{"aircraft", method}].leaf_counted = {coverage, 1.0, 1.0};
  }
  return all;
}

/// And one without a ceiling has no share of it.
TEST(Compare, EachMethodIsDividedByItsOwnCeiling) {
  const std::vector<ComparedRun> runs = {run("coarse", 1, 0.4, 50), run("fine", 1, 0.8, 50),
                                         run("other", 1, 0.8, 50)};
  const Comparison c = compare(runs, "coarse", ceilings_at({{"coarse", 0.5}, {"fine", 1.0}}));
  for (const std::size_t method : {0, 1}) {  // 0.4 of 0.5, 0.8 of 1
    EXPECT_NEAR(find_figure(c, 0, "share of ceiling at 0.05 m (%)", method)->estimate.mean, 80.0,
                1e-9);
  }
  EXPECT_EQ(find_figure(c, 0, "share of ceiling at 0.05 m (%)", 2), nullptr);
}

/// A run that covers a tenth of the ceiling more with each of its views of 10 m.
ComparedRun climbing(const std::string& method, std::uint64_t seed, int views, double metres) {
  ComparedRun r = run(method, seed, 0.1 * views, metres * views);
  r.figures.curve = {};
  for (int view = 0; view <= views; ++view) {
    r.figures.curve.coverage.push_back({0.1 * view + 1e-9, 0.0, 0.0});
    r.figures.curve.metres.push_back(metres * view);
    r.figures.curve.seconds.push_back(view);
  }
  r.figures.before = {.profile_m = 100.0, .transfer_m = 5.0, .profile_end_s = 60.0};
  return r;
}

constexpr std::string_view kTo90 = "metres to 90 % of ceiling";

TEST(Compare, AMissionThatDiesEarlyWinsMetresButNotTheEffortToReach) {
  std::vector<ComparedRun> runs;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    runs.push_back(climbing("whole", seed, 9, 10.0 + 0.1 * static_cast<double>(seed)));
    // half the metres a view, but most crash after two
    runs.push_back(climbing("dies", seed, seed == 3 ? 9 : 2, 5.0));
  }
  const Comparison c = compare(runs, "whole", ceilings_at({{"whole", 1.0}, {"dies", 1.0}}));
  EXPECT_LT(find_figure(c, 0, kDistanceMetric, 1)->contrast->difference.mean, 0.0);
  const MethodFigure& whole = *find_figure(c, 0, kTo90, 0);
  const MethodFigure& dies = *find_figure(c, 0, kTo90, 1);
  EXPECT_EQ(whole.estimate.n, 8U);
  EXPECT_EQ(dies.runs, 8U);
  EXPECT_EQ(dies.estimate.n, 1U);
  EXPECT_EQ(dies.estimate.mean, 45.0);
  // ranks: worst in seven seeds, best in the one where it got there
  EXPECT_DOUBLE_EQ(*dies.rank, (7 * 2 + 1) / 8.0);
  const Contrast& contrast = *dies.contrast;
  EXPECT_EQ(contrast.pairs, 8U);
  EXPECT_EQ(contrast.difference.n, 1U);
  EXPECT_NEAR(contrast.difference.mean, 45.0 - 9 * 10.3, 1e-9);  // of seed 3 alone
  EXPECT_EQ(contrast.p, 2.0 * 2 / 256);  // the one negative difference is the smallest in size
  EXPECT_EQ(contrast.verdict, Verdict::significant);
  const TextTable table = comparison_table(c);
  const auto row = std::find_if(table.rows.begin(), table.rows.end(), [](const auto& r) {
    return r[1].text == kTo90 && r[2].text == "dies";
  });
  ASSERT_NE(row, table.rows.end());
  EXPECT_EQ((*row)[3].text, "1 of 8");
  EXPECT_EQ(row->back().text, "worse");
  EXPECT_TRUE(notes_say(c, "aircraft: no run got to 95 % of ceiling, 98 % of ceiling, 99 %"));
}

TEST(Compare, EffortsWithTheProfileAddIt) {
  const std::vector<ComparedRun> runs = {climbing("a", 1, 10, 10.0), climbing("b", 1, 10, 20.0)};
  const Comparison c = compare(runs, "a", ceilings_at({{"a", 1.0}, {"b", 1.0}}));
  const auto mean = [&](std::string_view metric) {
    return find_figure(c, 0, metric, 0)->estimate.mean;
  };
  EXPECT_EQ(mean("views to 80 % of ceiling"), 8.0);
  EXPECT_EQ(mean("metres to 80 % of ceiling"), 80.0);
  EXPECT_EQ(mean("metres to 80 % of ceiling, with profile"), 185.0);
  EXPECT_EQ(mean("seconds to 80 % of ceiling, with profile"), 68.0);
  EXPECT_EQ(mean("views to 99 % of ceiling"), 10.0);
}

TEST(Compare, TwoThatNeverGetThereAreEqual) {
  std::vector<ComparedRun> runs;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    runs.push_back(climbing("a", seed, 2, 10.0));
    runs.push_back(climbing("b", seed, 3, 10.0));
  }
  const Comparison c = compare(runs, "a", ceilings_at({{"a", 1.0}, {"b", 1.0}}));
  EXPECT_EQ(find_figure(c, 0, kTo90, 1)->contrast->verdict, Verdict::equal);
  EXPECT_EQ(find_figure(c, 0, kTo90, 1)->rank, 1.5);
  EXPECT_EQ(find_figure(c, 0, kTo90, 1)->estimate.n, 0U);
}

TEST(Compare, RanksAreMeansOverScenariosAndSeeds) {
  std::vector<ComparedRun> runs;
  for (const auto& [scenario, a, b, c] :
       std::vector<std::tuple<std::string, double, double, double>>{{"x", 0.9, 0.8, 0.7},
                                                                    {"y", 0.5, 0.5, 0.6}}) {
    runs.push_back(run("a", 1, a, 10, scenario));
    runs.push_back(run("b", 1, b, 20, scenario));
    runs.push_back(run("c", 1, c, 30, scenario));
  }
  const Comparison c = compare(runs, "a", {});
  const auto rank_of = [&](std::string_view metric, std::size_t method) {
    for (const OverallRank& rank : c.ranks) {
      if (c.metrics[rank.metric].name == metric && rank.method == method) return rank.rank;
    }
    return std::nan("");
  };
  EXPECT_DOUBLE_EQ(rank_of(kCoverageMetric, 0), (1 + 2.5) / 2);
  EXPECT_DOUBLE_EQ(rank_of(kCoverageMetric, 1), (2 + 2.5) / 2);
  EXPECT_DOUBLE_EQ(rank_of(kCoverageMetric, 2), (3 + 1) / 2.0);
  EXPECT_DOUBLE_EQ(rank_of(kDistanceMetric, 0), 1.0);  // fewer metres are better
  const TextTable table = comparison_table(c);
  EXPECT_EQ(table.rows.back()[0].text, "all scenarios");
}

TEST(Compare, TableHasAllFormsAndOneCellAColumn) {
  const TextTable table = comparison_table(compare(clear_cut(3), "base", {}));
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  for (const std::string_view format : kTableFormats) {
    EXPECT_NE(formatted_text(table, format).find("AUC"), std::string::npos) << format;
  }
}

}  // namespace
}  // namespace gnbv
