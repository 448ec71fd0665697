#include "bench/compare/baseline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

RunFigures run() {
  RunFigures run;
  run.scenario = "smoke";
  run.structure = "/somewhere/plane.obj";
  run.utility = "proposed";
  run.preset = "paper";
  run.seed = 3;
  run.version = "1.2.3";
  run.termination = "entropy_change";
  run.result_sha256 = "abc";
  run.iterations = 12;
  run.entropy_reduction_nat = 900.0;
  run.straight_m = 20.0;
  run.flight_time_s = 100.0;
  run.coverage_final = {0.5, 0.8, 0.9};
  run.distances.at[1] = {0.05, 0.9, 0.6, 0.72};
  run.distances.chamfer_m = 0.04;
  run.density.mean_points = 50.0;
  return run;
}

std::vector<std::string> with_verdict(const BaselineCheck& check, GateVerdict verdict) {
  std::vector<std::string> names;
  for (const MetricChange& change : check.metrics) {
    if (change.verdict == verdict) names.push_back(change.baseline.name);
  }
  return names;
}

TEST(Baseline, OfARunKeepsThatRun) {
  const Baseline baseline = make_baseline(run());
  const BaselineCheck check = check_against(baseline, "b.json", run());
  EXPECT_EQ(with_verdict(check, GateVerdict::kept).size(), 12U);
  EXPECT_FALSE(check.is_hash_wrong);
  EXPECT_FALSE(check.is_termination_wrong);
  EXPECT_EQ(check.termination, "entropy_change");
}

TEST(Baseline, AnotherEndRegressesAndACollisionAlways) {
  const auto is_wrong = [](const char* was, const char* is) {
    Baseline baseline = make_baseline(run());
    baseline.termination = was;
    RunFigures now = run();
    now.termination = is;
    return check_against(baseline, "b.json", now).is_termination_wrong;
  };
  EXPECT_FALSE(is_wrong("max_iterations", "max_iterations"));
  EXPECT_TRUE(is_wrong("max_iterations", "battery"));
  EXPECT_TRUE(is_wrong("battery", "max_iterations"));
  EXPECT_TRUE(is_wrong("max_iterations", "collision"));
  EXPECT_TRUE(is_wrong("collision", "collision"));
}

/// Every figure of the baseline, one at a time, a little within and beyond its tolerance.
TEST(Baseline, EachMetricRegressesAndImprovesBeyondItsToleranceOnly) {
  Baseline baseline = make_baseline(run());
  for (std::size_t i = 0; i < baseline.metrics.size(); ++i) {
    BaselineMetric& metric = baseline.metrics[i];
    const double value = metric.value;
    ASSERT_GT(metric.tolerance, 0.0) << metric.name;
    for (const double steps : {-1.01, -0.99, 0.99, 1.01}) {
      for (const Better better : {Better::higher, Better::lower, Better::same}) {
        metric.better = better;
        // the run is `steps` tolerances above the baseline
        metric.value = value - steps * metric.tolerance;
        const bool is_beyond = std::abs(steps) > 1.0;
        const bool is_gain = better != Better::same && (better == Better::higher) == (steps > 0.0);
        const GateVerdict expected = !is_beyond ? GateVerdict::kept
                                     : is_gain  ? GateVerdict::better
                                                : GateVerdict::regressed;
        const BaselineCheck check = check_against(baseline, "b.json", run());
        EXPECT_EQ(check.metrics[i].verdict, expected) << metric.name << " " << steps;
        EXPECT_EQ(with_verdict(check, GateVerdict::kept).size(),
                  baseline.metrics.size() - (is_beyond ? 1 : 0));
      }
    }
    metric.value = value;
  }
}

TEST(Baseline, HashCountsOnlyWhereItIsAskedFor) {
  Baseline baseline = make_baseline(run());
  RunFigures other = run();
  other.result_sha256 = "def";
  EXPECT_FALSE(check_against(baseline, "b.json", other).is_hash_wrong);
  baseline.result_sha256 = "abc";
  EXPECT_TRUE(check_against(baseline, "b.json", other).is_hash_wrong);
  EXPECT_FALSE(check_against(baseline, "b.json", run()).is_hash_wrong);
  EXPECT_EQ(updated_baseline(other, baseline, "b.json").result_sha256, "def");
}

TEST(Baseline, AnUpdateKeepsTolerancesAndTakesTheFigures) {
  Baseline before = make_baseline(run());
  before.metrics[0].tolerance = 0.123;
  before.metrics[1].better = Better::same;
  RunFigures better = run();
  better.coverage_final = {0.6, 0.85, 0.95};
  const Baseline after = updated_baseline(better, before, "b.json");
  EXPECT_EQ(after.metrics[0].value, 0.6);
  EXPECT_EQ(after.metrics[0].tolerance, 0.123);
  EXPECT_EQ(after.metrics[1].better, Better::same);
}

TEST(Baseline, ReadsBackWhatItWrote) {
  TempFolder temp;
  const fs::path file = temp.path() / "b.json";
  Baseline written = make_baseline(run());
  written.result_sha256 = "abc";
  write_file_atomically(file, to_json(written));
  const Baseline read = read_baseline(file);
  EXPECT_EQ(to_json(read), to_json(written));
  EXPECT_EQ(read.of.structure, "plane.obj");  // the same mesh in another folder is the same
  EXPECT_NO_THROW(check_against(read, file, run()));
}

/// Of another version it may be where it is updated.
TEST(Baseline, OfSomethingElseNamesEveryDifference) {
  const Baseline baseline = make_baseline(run());
  RunFigures other = run();
  other.version = "1.3.0";
  other.termination = "max_iterations";
  EXPECT_EQ(updated_baseline(other, baseline, "b.json").of.version, "1.3.0");
  EXPECT_EQ(updated_baseline(other, baseline, "b.json").termination, "max_iterations");
  const std::vector<std::function<void(RunFigures&)>> changes = {
      [](RunFigures& r) { r.scenario = "aircraft"; },
      [](RunFigures& r) { r.structure = "ship.obj"; },
      [](RunFigures& r) { r.utility = "isler"; },
      [](RunFigures& r) { r.preset = "released"; },
      [](RunFigures& r) { r.seed = 4; },
      [](RunFigures& r) { r.area_samples = 5000; }};
  for (const auto& change : changes) {
    RunFigures one = run();
    change(one);
    EXPECT_THROW(updated_baseline(one, baseline, "b.json"), BadInput);
    change(other);
  }
  EXPECT_TRUE(test::says(test::fault_of([&] { check_against(baseline, "b.json", other); }),
                         {"b.json", "aircraft", "ship.obj", "isler", "released", "4", "1.3.0",
                          "reference outside, the run's is area_samples 5000"}));
}

TEST(Baseline, AFileWithAFaultIsRefusedByKey) {
  struct Fault {
    const char* was;
    const char* is;
    const char* word;  // of the complaint
  };
  for (const auto& [was, is, word] : std::vector<Fault>{
           {"gnbv-baseline-1", "gnbv-baseline-2", "schema"},
           {"\"termination\": \"entropy_change\"", "\"termination\": 1", "termination"},
           {"{", "", "JSON"},
           {"\"chamfer_m\"", "\"shamfer_m\"", "metrics.chamfer_m"},
           {"\"tolerance\": 0.02", "\"tolerance\": \"0.02\"", "metrics.coverage_0.05.tolerance"},
           {"\"tolerance\": 0.02", "\"tolerance\": -1", "metrics.coverage_0.05.tolerance"},
           {"\"tolerance\": 0.02", "\"tolerance\": 1e999", "JSON"},
           {"\"value\": 0.5", "\"value\": null", "metrics.coverage_0.05.value"},
           {"\"higher\"", "\"more\"", "more"},
           {"\"seed\": 3", "\"seed\": -3", "of.seed"},
           {"\"utility\"", "\"untility\"", "of.utility"},
           {"\"metrics\": {", "\"metrics\": {\"beauty\": {},", "metrics.beauty"}}) {
    SCOPED_TRACE(is);
    const TempFolder temp;
    std::string text = to_json(make_baseline(run()));
    text.replace(text.find(was), std::string_view(was).size(), is);
    std::ofstream(temp.path() / "b.json") << text;
    const std::string fault = test::fault_of([&] { read_baseline(temp.path() / "b.json"); });
    EXPECT_TRUE(test::says(fault, {"b.json", word}));
    EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
  }
}

/// What people and programs read of a check: the changes beyond their tolerance, and all of them.
TEST(Baseline, ACheckIsATableOfWhatChangedAndJsonOfAll) {
  RunFigures now = run();
  now.coverage_final[0] = 0.4;
  now.straight_m = 10.0;
  now.termination = "battery";
  const BaselineCheck check = check_against(make_baseline(run()), "b.json", now);
  const TextTable table = check_table(check);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0][0].text, "regressed");
  EXPECT_EQ(table.rows[0][4].text, "-0.1");
  EXPECT_EQ(table.rows[1][0].text, "better");
  EXPECT_EQ(table.notes, (std::vector<std::string>{
                             "regressed termination: battery, the baseline's is entropy_change",
                             "10 of 12 metrics within their tolerance"}));
  const auto json = nlohmann::json::parse(check_json(check));
  EXPECT_EQ(json.at("regressed"), 2);
  EXPECT_EQ(json.at("metrics").size(), 12U);
  EXPECT_EQ(json.at("metrics").at(0).at("verdict"), "regressed");
}

}  // namespace
}  // namespace gnbv
