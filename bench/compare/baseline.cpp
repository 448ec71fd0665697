#include "bench/compare/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/score/surface_reference.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::array<const char*, 3> kVerdictNames = {"kept", "better", "regressed"};

std::vector<BaselineMetric> gated_metrics(const RunFigures& run) {
  std::vector<BaselineMetric> metrics;
  const auto share = [&](const std::string& name, double value) {
    metrics.push_back({name, value, 0.02, Better::higher});
  };
  const auto amount = [&](const char* name, double value, Better better) {
    metrics.push_back({name, value, 0.1 * std::abs(value), better});
  };
  const DistanceScore& at_5_cm = run.distances.at[1];
  share("coverage_0.05", run.coverage_final[0]);
  share("coverage_0.10", run.coverage_final[1]);
  share("coverage_0.50", run.coverage_final[2]);
  share("precision", at_5_cm.precision);
  share("recall", at_5_cm.recall);
  share("f", at_5_cm.f);
  metrics.push_back({"chamfer_m", run.distances.chamfer_m, 0.001, Better::lower});
  amount("density", run.density.mean_points, Better::higher);
  amount("straight_m", run.straight_m, Better::lower);
  amount("flight_time_s", run.flight_time_s, Better::lower);
  amount("iterations", run.iterations, Better::lower);
  amount("entropy_reduction_nat", run.entropy_reduction_nat, Better::higher);
  for (const SizedCoverage& at : run.more) {
    share("coverage_" + size_name(at.size_m), at.final);
  }
  return metrics;
}

/// Of the key; nothing where it is missing.
template <typename Value>
Value value_of(const std::map<std::string, Value>& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? Value{} : found->second;
}

void need_same(const BaselineSubject& was, const BaselineSubject& is, const fs::path& path) {
  std::string differences;
  const auto add = [&](const std::string& key, const std::string& then, const std::string& now) {
    differences += fmt::format("\n  {}: {} -> {}", key, then.empty() ? "nothing" : then,
                               now.empty() ? "nothing" : now);
  };
  if (was.reference != is.reference) add("reference", was.reference, is.reference);
  BaselineSubject::Values all = was.configuration;
  for (const auto& [key, value] : is.configuration) all.emplace(key, value_of(is.defaults, key));
  for (const auto& [key, then] : all) {
    const std::string now = value_of(is.configuration, key);
    if (then != now) add(key, then, now);
  }
  const auto told = [](const BaselineSubject::Content& file) {
    return file.sha256.empty() ? "" : fmt::format("{} {}", file.name, file.sha256);
  };
  auto files = was.files;
  files.insert(is.files.begin(), is.files.end());
  for (const auto& [key, file] : files) {
    const auto then = value_of(was.files, key), now = value_of(is.files, key);
    if (then.sha256 != now.sha256) add(key, told(then), told(now));
  }
  if (differences.empty()) return;
  throw BadInput("{}: is of something else than the run; to gate that from now on, {}:{}",
                 path.string(), how_to_renew(path), differences);
}

GateVerdict judge(const BaselineMetric& metric, double now) {
  const double gain = metric.better == Better::lower ? metric.value - now : now - metric.value;
  if (std::abs(gain) <= metric.tolerance) return GateVerdict::kept;
  return gain > 0.0 && metric.better != Better::same ? GateVerdict::better : GateVerdict::regressed;
}

/// The baseline's metrics as they are now. Throws BadInput when the run was not scored at a size.
std::vector<MetricChange> changes_of(const std::vector<BaselineMetric>& baseline,
                                     const RunFigures& run, const fs::path& path) {
  const std::vector<BaselineMetric> all = gated_metrics(run);
  std::vector<MetricChange> changes;
  for (const BaselineMetric& metric : baseline) {
    const auto now = std::ranges::find(all, metric.name, &BaselineMetric::name);
    if (now == all.end()) {
      throw BadInput("{}: metrics.{}: the run was not scored at that size; score.sizes_m names it",
                     path.string(), metric.name);
    }
    changes.push_back({metric, now->value, judge(metric, now->value)});
  }
  return changes;
}

}  // namespace

std::string how_to_renew(const fs::path& path) {
  return fmt::format("remove it, and `gnbv check RUN --against {} --update` writes it anew",
                     shell_word(path.string()));
}

Baseline make_baseline(const RunFigures& run, const BaselineSubject& of) {
  Baseline made{.of = of, .termination = run.termination, .metrics = gated_metrics(run)};
  const std::string counted = run.area_samples == 0 ? "" : fmt::format(" {}", run.area_samples);
  made.of.version = run.version;
  made.of.reference = reference_name(run.area_samples) + counted;
  return made;
}

Baseline updated_baseline(const RunFigures& run, const BaselineSubject& of, const Baseline& before,
                          const fs::path& path) {
  Baseline baseline = make_baseline(run, of);
  need_same(before.of, baseline.of, path);
  if (before.result_sha256) baseline.result_sha256 = run.result_sha256;
  changes_of(before.metrics, run, path);  // each of them has to be there
  for (BaselineMetric& metric : baseline.metrics) {
    const auto known = std::ranges::find(before.metrics, metric.name, &BaselineMetric::name);
    if (known == before.metrics.end()) continue;
    metric.tolerance = known->tolerance;
    metric.better = known->better;
  }
  return baseline;
}

BaselineCheck check_against(const Baseline& baseline, const fs::path& path, const RunFigures& run,
                            const BaselineSubject& of) {
  need_same(baseline.of, make_baseline(run, of).of, path);
  return {.metrics = changes_of(baseline.metrics, run, path),
          .termination = run.termination,
          .baseline_termination = baseline.termination,
          .is_termination_wrong =
              run.termination == "collision" || run.termination != baseline.termination,
          .is_hash_wrong = baseline.result_sha256 && *baseline.result_sha256 != run.result_sha256};
}

std::vector<std::string> regressed(const BaselineCheck& check) {
  std::vector<std::string> names;
  if (check.is_termination_wrong) names.emplace_back("termination");
  if (check.is_hash_wrong) names.emplace_back("result_sha256");
  for (const MetricChange& change : check.metrics) {
    if (change.verdict == GateVerdict::regressed) names.push_back(change.baseline.name);
  }
  return names;
}

TextTable check_table(const BaselineCheck& check) {
  using enum ColumnKind;
  TextTable table{.columns = {{"Verdict", "verdict"},
                              {"Metric", "metric"},
                              {"Baseline", "baseline", number},
                              {"Now", "now", number},
                              {"Change", "change", number},
                              {"Allowed", "allowed", number}}};
  for (const auto& [metric, now, verdict] : check.metrics) {
    if (verdict == GateVerdict::kept) continue;
    table.rows.push_back({{kVerdictNames[static_cast<std::size_t>(verdict)]},
                          {metric.name},
                          {fmt::format("{:.6g}", metric.value)},
                          {fmt::format("{:.6g}", now)},
                          {fmt::format("{:+.4g}", now - metric.value)},
                          {fmt::format("{:.4g}", metric.tolerance)}});
  }
  if (check.is_termination_wrong) {
    table.notes.push_back(fmt::format("regressed termination: {}, the baseline's is {}",
                                      check.termination, check.baseline_termination));
  }
  if (check.is_hash_wrong) table.notes.emplace_back("regressed result_sha256: is another");
  table.notes.push_back(fmt::format("{} of {} metrics within their tolerance",
                                    check.metrics.size() - table.rows.size(),
                                    check.metrics.size()));
  return table;
}

std::string check_json(const BaselineCheck& check) {
  Json metrics = Json::array();
  for (const auto& [metric, now, verdict] : check.metrics) {
    metrics.push_back({{"metric", metric.name},
                       {"baseline", metric.value},
                       {"now", now},
                       {"allowed", metric.tolerance},
                       {"verdict", kVerdictNames[static_cast<std::size_t>(verdict)]}});
  }
  const Json json = {{"schema", "gnbv-check-1"},
                     {"regressed", regressed(check).size()},
                     {"termination",
                      {{"baseline", check.baseline_termination},
                       {"now", check.termination},
                       {"regressed", check.is_termination_wrong}}},
                     {"result_sha256_differs", check.is_hash_wrong},
                     {"metrics", metrics}};
  return json.dump(2) + "\n";
}

}  // namespace gnbv
