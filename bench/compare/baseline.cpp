#include "bench/compare/baseline.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bench/score/surface_reference.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view kSchema = "gnbv-baseline-1";
constexpr std::string_view kCoverage = "coverage_";
constexpr std::array<const char*, 3> kBetterNames = {"higher", "lower", "same"};
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
    share(fmt::format("{}{}", kCoverage, size_name(at.size_m)), at.final);
  }
  return metrics;
}

auto find_metric(const std::vector<BaselineMetric>& metrics, const std::string& name) {
  return std::find_if(metrics.begin(), metrics.end(),
                      [&](const BaselineMetric& metric) { return metric.name == name; });
}

/// Whether it is coverage at a size that not every run is scored at.
bool is_sized_coverage(const std::string& name) {
  if (!name.starts_with(kCoverage)) return false;
  const double size_m = std::strtod(name.c_str() + kCoverage.size(), nullptr);
  return size_m > 0.0 && name == fmt::format("{}{}", kCoverage, size_name(size_m));
}

BaselineSubject subject_of(const RunFigures& run) {
  const std::string counted = run.area_samples == 0 ? "" : fmt::format(" {}", run.area_samples);
  return {
      run.scenario, fs::path(run.structure).filename().string(), run.utility, run.preset, run.seed,
      run.version,  reference_name(run.area_samples) + counted};
}

/// One baseline file, for messages.
class File {
 public:
  explicit File(const fs::path& path)
      : path_(path), json_(Json::parse(read_file(path), nullptr, false)) {
    if (!json_.is_object()) throw BadInput(fmt::format("{}: is no JSON object", path_.string()));
    const std::string schema = text({"schema"});
    if (schema != kSchema) refuse({"schema"}, fmt::format("must be \"{}\"", kSchema));
  }

  Baseline baseline() const {
    Baseline baseline{
        .of = {text({"of", "scenario"}), text({"of", "structure"}), text({"of", "utility"}),
               text({"of", "preset"}), seed(), text({"of", "version"}), text({"of", "reference"})},
        .termination = text({"termination"})};
    for (const BaselineMetric& known : gated_metrics({})) {
      baseline.metrics.push_back(metric(known.name));
    }
    for (const auto& [name, value] : at({"metrics"}).items()) {
      if (find_metric(baseline.metrics, name) != baseline.metrics.end()) continue;
      if (!is_sized_coverage(name)) refuse({"metrics", name}, "is no metric");
      baseline.metrics.push_back(metric(name));
    }
    if (json_.contains("result_sha256")) baseline.result_sha256 = text({"result_sha256"});
    return baseline;
  }

 private:
  using Keys = std::vector<std::string>;

  const Json& at(const Keys& keys) const {
    const Json* value = &json_;
    for (const std::string& key : keys) {
      if (!value->is_object() || !value->contains(key)) {
        throw BadInput(fmt::format("{}: {}: is missing", path_.string(), fmt::join(keys, ".")));
      }
      value = &value->at(key);
    }
    return *value;
  }
  std::string text(const Keys& keys) const {
    if (!at(keys).is_string()) refuse(keys, "is no text");
    return at(keys).get<std::string>();
  }
  std::uint64_t seed() const {
    const Keys keys = {"of", "seed"};
    if (!at(keys).is_number_unsigned()) refuse(keys, "is no count");
    return at(keys).get<std::uint64_t>();
  }
  double number(const Keys& keys) const {
    const Json& value = at(keys);
    if (!value.is_number() || !std::isfinite(value.get<double>())) refuse(keys, "is no number");
    return value.get<double>();
  }
  BaselineMetric metric(const std::string& name) const {
    const Keys tolerance = {"metrics", name, "tolerance"}, better = {"metrics", name, "better"};
    const auto* const found = std::find(kBetterNames.begin(), kBetterNames.end(), text(better));
    if (found == kBetterNames.end()) {
      refuse(better, "must be \"higher\", \"lower\" or \"same\"");
    }
    if (number(tolerance) < 0.0) refuse(tolerance, "is below 0");
    return {name, number({"metrics", name, "value"}), number(tolerance),
            static_cast<Better>(found - kBetterNames.begin())};
  }
  [[noreturn]] void refuse(const Keys& keys, const std::string& what) const {
    throw BadInput(
        fmt::format("{}: {}: {} {}", path_.string(), fmt::join(keys, "."), at(keys).dump(), what));
  }

  fs::path path_;
  Json json_;
};

void need_same(const BaselineSubject& baseline, const BaselineSubject& run, bool needs_version,
               const fs::path& path) {
  std::string differences;
  const auto compare = [&](const char* what, const auto& of_baseline, const auto& of_run) {
    if (of_baseline == of_run) return;
    differences += fmt::format("{} {} {}, the run's is {}", differences.empty() ? "" : ";", what,
                               of_baseline, of_run);
  };
  compare("scenario", baseline.scenario, run.scenario);
  compare("structure", baseline.structure, run.structure);
  compare("utility", baseline.utility, run.utility);
  compare("preset", baseline.preset, run.preset);
  compare("seed", baseline.seed, run.seed);
  compare("reference", baseline.reference, run.reference);
  if (needs_version) compare("version", baseline.version, run.version);
  if (differences.empty()) return;
  throw BadInput(fmt::format("{}: is of something else:{}", path.string(), differences));
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
    const auto now = find_metric(all, metric.name);
    if (now == all.end()) {
      throw BadInput(
          fmt::format("{}: metrics.{}: the run was not scored at that size; score.sizes_m names it",
                      path.string(), metric.name));
    }
    changes.push_back({metric, now->value, judge(metric, now->value)});
  }
  return changes;
}

}  // namespace

Baseline read_baseline(const fs::path& path) { return File(path).baseline(); }

std::string to_json(const Baseline& baseline) {
  Json metrics;
  for (const BaselineMetric& metric : baseline.metrics) {
    metrics[metric.name] = {{"value", metric.value},
                            {"tolerance", metric.tolerance},
                            {"better", kBetterNames[static_cast<std::size_t>(metric.better)]}};
  }
  const BaselineSubject& of = baseline.of;
  Json json = {{"schema", kSchema},
               {"of",
                {{"scenario", of.scenario},
                 {"structure", of.structure},
                 {"utility", of.utility},
                 {"preset", of.preset},
                 {"seed", of.seed},
                 {"version", of.version},
                 {"reference", of.reference}}},
               {"termination", baseline.termination},
               {"metrics", metrics}};
  if (baseline.result_sha256) json["result_sha256"] = *baseline.result_sha256;
  return json.dump(2) + "\n";
}

Baseline make_baseline(const RunFigures& run) {
  return {.of = subject_of(run), .termination = run.termination, .metrics = gated_metrics(run)};
}

Baseline updated_baseline(const RunFigures& run, const Baseline& before, const fs::path& path) {
  need_same(before.of, subject_of(run), false, path);
  Baseline baseline = make_baseline(run);
  if (before.result_sha256) baseline.result_sha256 = run.result_sha256;
  changes_of(before.metrics, run, path);  // each of them has to be there
  for (BaselineMetric& metric : baseline.metrics) {
    const auto known = find_metric(before.metrics, metric.name);
    if (known == before.metrics.end()) continue;
    metric.tolerance = known->tolerance;
    metric.better = known->better;
  }
  return baseline;
}

BaselineCheck check_against(const Baseline& baseline, const fs::path& path, const RunFigures& run,
                            Versions versions) {
  need_same(baseline.of, subject_of(run), versions == Versions::have_to_agree, path);
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
