#include "bench/compare/baseline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

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

TEST(Baseline, IsNotUpdatedByARunOfSomethingElseThanAnotherVersion) {
  const Baseline before = make_baseline(run());
  RunFigures next = run();
  next.version = "1.3.0";
  next.termination = "max_iterations";
  const Baseline after = updated_baseline(next, before, "b.json");
  EXPECT_EQ(after.of.version, "1.3.0");
  EXPECT_EQ(after.termination, "max_iterations");
  const auto expect_refused = [&](auto change) {
    RunFigures other = run();
    change(other);
    EXPECT_THROW(updated_baseline(other, before, "b.json"), BadInput);
  };
  expect_refused([](RunFigures& r) { r.scenario = "aircraft"; });
  expect_refused([](RunFigures& r) { r.structure = "ship.obj"; });
  expect_refused([](RunFigures& r) { r.utility = "isler"; });
  expect_refused([](RunFigures& r) { r.preset = "released"; });
  expect_refused([](RunFigures& r) { r.seed = 4; });
}

TEST(Baseline, OfSomethingElseNamesEveryDifference) {
  const Baseline baseline = make_baseline(run());
  RunFigures other = run();
  other.scenario = "aircraft";
  other.structure = "ship.obj";
  other.utility = "isler";
  other.preset = "released";
  other.seed = 4;
  other.version = "1.3.0";
  EXPECT_TRUE(test::says(test::fault_of([&] { check_against(baseline, "b.json", other); }),
                         {"b.json", "aircraft", "ship.obj", "isler", "released", "4", "1.3.0"}));
}

/// A baseline file with one place of its text changed.
struct FileFault {
  const char* name;
  const char* was;
  const char* is;
  const char* word;  // of the complaint
};

class BaselineFile : public testing::TestWithParam<FileFault> {};

TEST_P(BaselineFile, WithAFaultIsRefusedByKey) {
  TempFolder temp;
  const fs::path file = temp.path() / "b.json";
  std::string text = to_json(make_baseline(run()));
  const std::size_t at = text.find(GetParam().was);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(GetParam().was).size(), GetParam().is);
  std::ofstream(file) << text;
  const std::string fault = test::fault_of([&] { read_baseline(file); });
  EXPECT_TRUE(test::says(fault, {"b.json", GetParam().word}));
  EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
}

INSTANTIATE_TEST_SUITE_P(
    Baseline, BaselineFile,
    testing::Values(
        FileFault{"Schema", "gnbv-baseline-1", "gnbv-baseline-2", "schema"},
        FileFault{"Termination", "\"termination\": \"entropy_change\"", "\"termination\": 1",
                  "termination"},
        FileFault{"NoJson", "{", "", "JSON"},
        FileFault{"MetricMissing", "\"chamfer_m\"", "\"shamfer_m\"", "metrics.chamfer_m"},
        FileFault{"Tolerance", "\"tolerance\": 0.02", "\"tolerance\": \"0.02\"",
                  "metrics.coverage_0.05.tolerance"},
        FileFault{"NegativeTolerance", "\"tolerance\": 0.02", "\"tolerance\": -1",
                  "metrics.coverage_0.05.tolerance"},
        FileFault{"InfiniteTolerance", "\"tolerance\": 0.02", "\"tolerance\": 1e999", "JSON"},
        FileFault{"Value", "\"value\": 0.5", "\"value\": null", "metrics.coverage_0.05.value"},
        FileFault{"Better", "\"higher\"", "\"more\"", "more"},
        FileFault{"Seed", "\"seed\": 3", "\"seed\": -3", "of.seed"},
        FileFault{"Subject", "\"utility\"", "\"untility\"", "of.utility"}),
    [](const auto& fault) { return std::string(fault.param.name); });

TEST(Baseline, WithAMetricThatIsNoneIsRefused) {
  TempFolder temp;
  const fs::path file = temp.path() / "b.json";
  std::string text = to_json(make_baseline(run()));
  text.replace(text.find("\"metrics\": {"), 12,
               "\"metrics\": {\"beauty\": {\"value\": 1, \"tolerance\": 1, \"better\": \"same\"},");
  std::ofstream(file) << text;
  EXPECT_TRUE(test::says(test::fault_of([&] { read_baseline(file); }), {"metrics.beauty"}));
}

}  // namespace
}  // namespace gnbv
