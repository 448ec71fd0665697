#include "bench/compare/baseline.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

RunFigures run() {
  RunFigures run;
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

BaselineSubject subject() {
  return {.configuration = {{"seed", "3"}, {"planner.x", "3"}, {"cameras.0.name", "rgbd"}},
          .files = {{"structure", {"plane.obj", "0a1b"}}}};
}

Baseline baseline_of_run() { return make_baseline(run(), subject()); }

BaselineCheck check_of(const Baseline& baseline, const RunFigures& now) {
  return check_against(baseline, "b.json", now, subject());
}

std::vector<std::string> with_verdict(const BaselineCheck& check, GateVerdict verdict) {
  std::vector<std::string> names;
  for (const MetricChange& change : check.metrics) {
    if (change.verdict == verdict) names.push_back(change.baseline.name);
  }
  return names;
}

TEST(Baseline, AnotherEndRegressesAndACollisionAlways) {
  const auto is_wrong = [](const char* was, const char* is) {
    Baseline baseline = baseline_of_run();
    baseline.termination = was;
    RunFigures now = run();
    now.termination = is;
    return check_of(baseline, now).is_termination_wrong;
  };
  EXPECT_FALSE(is_wrong("max_iterations", "max_iterations"));
  EXPECT_TRUE(is_wrong("max_iterations", "battery"));
  EXPECT_TRUE(is_wrong("battery", "max_iterations"));
  EXPECT_TRUE(is_wrong("max_iterations", "collision"));
  EXPECT_TRUE(is_wrong("collision", "collision"));
}

/// Every figure of the baseline, one at a time, a little within and beyond its tolerance.
TEST(Baseline, EachMetricRegressesAndImprovesBeyondItsToleranceOnly) {
  Baseline baseline = baseline_of_run();
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
        const BaselineCheck check = check_of(baseline, run());
        EXPECT_EQ(check.metrics[i].verdict, expected) << metric.name << " " << steps;
        EXPECT_EQ(with_verdict(check, GateVerdict::kept).size(),
                  baseline.metrics.size() - (is_beyond ? 1 : 0));
      }
    }
    metric.value = value;
  }
}

TEST(Baseline, OfAnotherConfigurationOrMeshNamesEveryDifference) {
  const Baseline baseline = baseline_of_run();
  BaselineSubject other = subject();
  other.configuration["planner.x"] = "4";
  other.configuration.erase("cameras.0.name");
  other.configuration["planner.y"] = "on";
  other.files["structure"].sha256 = "2c3d";
  other.files["terrain"] = {"hill.ply", "4e5f"};
  RunFigures sampled = run();
  sampled.area_samples = 5000;
  const std::initializer_list<std::string_view> differences = {
      "b.json",
      "planner.x: 3 -> 4\n",
      "cameras.0.name: rgbd -> nothing\n",
      "planner.y: nothing -> on\n",
      "structure: plane.obj 0a1b -> plane.obj 2c3d\n",
      "terrain: nothing -> hill.ply 4e5f",
      "reference: outside -> area_samples 5000\n"};
  for (const std::string& fault :
       {test::fault_of([&] { check_against(baseline, "b.json", sampled, other); }),
        test::fault_of([&] { updated_baseline(sampled, other, baseline, "b.json"); })}) {
    EXPECT_TRUE(test::says(fault, differences)) << fault;
    EXPECT_EQ(fault.find("seed"), fault.npos) << fault;  // which is the same
  }
}

/// A key that came later was what it is by default now; a mesh may be called otherwise.
TEST(Baseline, OfAnotherVersionIsComparedAsFarAsItGoes) {
  RunFigures now = run();
  now.version = "1.3.0";
  BaselineSubject of = subject();
  of.files["structure"].name = "ship.obj";
  of.configuration["planner.y"] = of.defaults["planner.y"] = "off";
  EXPECT_EQ(regressed(check_against(baseline_of_run(), "b.json", now, of)),
            std::vector<std::string>{});
  EXPECT_EQ(updated_baseline(now, of, baseline_of_run(), "b.json").of.version, "1.3.0");
  of.configuration["planner.y"] = "on";
  EXPECT_TRUE(
      test::says(test::fault_of([&] { check_against(baseline_of_run(), "b.json", now, of); }),
                 {"planner.y: off -> on"}));
}

TEST(Baseline, AFileWithAFaultIsRefusedByKey) {
  struct Fault {
    const char* was;
    const char* is;
    const char* word;  // of the complaint
  };
  for (const auto& [was, is, word] : std::vector<Fault>{
           {"gnbv-baseline-2", "gnbv-baseline-1", "b.json --update` writes it anew"},
           {"\"termination\": \"entropy_change\"", "\"termination\": 1", "termination"},
           {"{", "", "JSON"},
           {"\"chamfer_m\"", "\"shamfer_m\"", "metrics.chamfer_m"},
           {"\"tolerance\": 0.02", "\"tolerance\": \"0.02\"", "metrics.coverage_0.05.tolerance"},
           {"\"tolerance\": 0.02", "\"tolerance\": -1", "metrics.coverage_0.05.tolerance"},
           {"\"tolerance\": 0.02", "\"tolerance\": 1e999", "JSON"},
           {"\"value\": 0.5", "\"value\": null", "metrics.coverage_0.05.value"},
           {"\"higher\"", "\"more\"", "more"},
           {"\"seed\": \"3\"", "\"seed\": 3", "of.configuration.seed"},
           {"\"sha256\"", "\"sha265\"", "of.files.structure.sha256"},
           {"\"metrics\": {", "\"metrics\": {\"beauty\": {},", "metrics.beauty"}}) {
    SCOPED_TRACE(is);
    const TempFolder temp;
    std::string text = to_json(baseline_of_run());
    text.replace(text.find(was), std::string_view(was).size(), is);
    std::ofstream(temp.path() / "b.json") << text;
    const std::string fault = test::fault_of([&] { read_baseline(temp.path() / "b.json"); });
    EXPECT_TRUE(test::says(fault, {"b.json", word}));
    EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
  }
  const TempFolder temp;
  const std::size_t deep = 200000;  // more than the stack holds of what recurses
  std::ofstream(temp.path() / "b.json")
      << R"({"schema":)" + std::string(deep, '[') + std::string(deep, ']') + '}';
  EXPECT_TRUE(test::says(test::fault_of([&] { read_baseline(temp.path() / "b.json"); }),
                         {"b.json: schema: a list is no text"}));
}

/// What people and programs read of a check: the changes beyond their tolerance, and all of them.
TEST(Baseline, ACheckIsATableOfWhatChangedAndJsonOfAll) {
  RunFigures now = run();
  now.coverage_final[0] = 0.4;
  now.straight_m = 10.0;
  now.termination = "battery";
  const BaselineCheck check = check_of(baseline_of_run(), now);
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
