#include "bench/compare/baseline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view kSchema = "gnbv-baseline-1";
constexpr std::size_t kScoreIndex = 1;  // 0.05 m of kScoreDistances_m

/// A metric by name: how to read it from a run, and its tolerance in a new baseline.
struct Metric {
  std::string_view name;
  double (*of)(const RunFigures& run);
  Better better;
  double tolerance;        // absolute,
  double tolerance_share;  // and this share of the value besides
};

constexpr double kShareTolerance = 0.02;
constexpr double kRelativeTolerance = 0.1;

constexpr std::array<Metric, 12> kGatedMetrics = {{
    {"coverage_0.05", [](const RunFigures& r) { return r.coverage_final[0]; }, Better::higher,
     kShareTolerance, 0.0},
    {"coverage_0.10", [](const RunFigures& r) { return r.coverage_final[1]; }, Better::higher,
     kShareTolerance, 0.0},
    {"coverage_0.50", [](const RunFigures& r) { return r.coverage_final[2]; }, Better::higher,
     kShareTolerance, 0.0},
    {"precision", [](const RunFigures& r) { return r.distances.at[kScoreIndex].precision; },
     Better::higher, kShareTolerance, 0.0},
    {"recall", [](const RunFigures& r) { return r.distances.at[kScoreIndex].recall; },
     Better::higher, kShareTolerance, 0.0},
    {"f", [](const RunFigures& r) { return r.distances.at[kScoreIndex].f; }, Better::higher,
     kShareTolerance, 0.0},
    {"chamfer_m", [](const RunFigures& r) { return r.distances.chamfer_m; }, Better::lower, 0.001,
     0.0},
    {"density", [](const RunFigures& r) { return r.density.mean_points; }, Better::higher, 0.0,
     kRelativeTolerance},
    {"straight_m", [](const RunFigures& r) { return r.straight_m; }, Better::lower, 0.0,
     kRelativeTolerance},
    {"flight_time_s", [](const RunFigures& r) { return r.flight_time_s; }, Better::lower, 0.0,
     kRelativeTolerance},
    {"iterations", [](const RunFigures& r) { return static_cast<double>(r.iterations); },
     Better::lower, 0.0, kRelativeTolerance},
    {"entropy_reduction_nat", [](const RunFigures& r) { return r.entropy_reduction_nat; },
     Better::higher, 0.0, kRelativeTolerance},
}};

constexpr std::string_view kCoverage = "coverage_";

/// Of a run, beside the gated metrics: the coverage at each further size.
std::string name_of_more(const SizedCoverage& at) {
  return fmt::format("{}{}", kCoverage, size_name(at.size_m));
}

/// The value of any metric of a baseline; nothing when the run was not scored at that size.
std::optional<double> value_of(const RunFigures& run, std::string_view name) {
  for (const Metric& metric : kGatedMetrics) {
    if (metric.name == name) return metric.of(run);
  }
  for (const SizedCoverage& at : run.more) {
    if (name_of_more(at) == name) return at.final;
  }
  return std::nullopt;
}

constexpr std::array<std::string_view, 3> kBetterNames = {"higher", "lower", "same"};

BaselineSubject subject_of(const RunFigures& run) {
  return {run.scenario, fs::path(run.structure).filename().string(),
          run.utility,  run.preset,
          run.seed,     run.version};
}

/// One baseline file, for messages.
class File {
 public:
  explicit File(const fs::path& path)
      : path_(path), json_(Json::parse(read_file(path), nullptr, false)) {
    if (!json_.is_object()) throw BadInput(fmt::format("{}: is no JSON object", path_.string()));
    const Json& schema = at(json_, "schema", "schema");
    if (schema != kSchema) refuse("schema", schema, fmt::format("must be \"{}\"", kSchema));
  }

  BaselineSubject subject() const {
    const Json& of = at(json_, "of", "of");
    const Json& seed = at(of, "seed", "of.seed");
    if (!seed.is_number_unsigned()) refuse("of.seed", seed, "is no count");
    return {text(of, "scenario"), text(of, "structure"),     text(of, "utility"),
            text(of, "preset"),   seed.get<std::uint64_t>(), text(of, "version")};
  }

  std::string termination() const {
    return text_of(at(json_, "termination", "termination"), "termination");
  }

  std::vector<BaselineMetric> metrics() const {
    const Json& all = at(json_, "metrics", "metrics");
    std::vector<BaselineMetric> out;
    for (const Metric& metric : kGatedMetrics)
      out.push_back(metric_of(all, std::string(metric.name)));
    for (const auto& [name, value] : all.items()) {
      const auto is_it = [&name = name](const Metric& metric) { return metric.name == name; };
      if (std::any_of(kGatedMetrics.begin(), kGatedMetrics.end(), is_it)) continue;
      const double size_m =
          name.starts_with(kCoverage) ? std::strtod(name.c_str() + kCoverage.size(), nullptr) : 0.0;
      if (size_m > 0.0 && name == name_of_more({.size_m = size_m})) {
        out.push_back(metric_of(all, name));
      } else {
        throw BadInput(fmt::format("{}: metrics.{}: is no metric", path_.string(), name));
      }
    }
    return out;
  }

  std::optional<std::string> result_sha256() const {
    if (!json_.contains("result_sha256")) return std::nullopt;
    return text_of(json_.at("result_sha256"), "result_sha256");
  }

 private:
  BaselineMetric metric_of(const Json& all, const std::string& name) const {
    const std::string key = "metrics." + name;
    const Json& entry = at(all, name, key);
    BaselineMetric metric{.name = name,
                          .value = number(entry, "value", key),
                          .tolerance = number(entry, "tolerance", key)};
    if (metric.tolerance < 0.0) {
      refuse(key + ".tolerance", entry.at("tolerance"), "is below 0");
    }
    const std::string better = text_of(at(entry, "better", key + ".better"), key + ".better");
    const auto* const found = std::find(kBetterNames.begin(), kBetterNames.end(), better);
    if (found == kBetterNames.end()) {
      refuse(key + ".better", better, "must be \"higher\", \"lower\" or \"same\"");
    }
    metric.better = static_cast<Better>(found - kBetterNames.begin());
    return metric;
  }

  const Json& at(const Json& object, const std::string& name, const std::string& key) const {
    if (!object.is_object() || !object.contains(name)) {
      throw BadInput(fmt::format("{}: {}: is missing", path_.string(), key));
    }
    return object.at(name);
  }
  double number(const Json& entry, const std::string& name, const std::string& key) const {
    const Json& value = at(entry, name, key + "." + name);
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      refuse(key + "." + name, value, "is no number");
    }
    return value.get<double>();
  }
  std::string text_of(const Json& value, const std::string& key) const {
    if (!value.is_string()) refuse(key, value, "is no text");
    return value.get<std::string>();
  }
  std::string text(const Json& of, const std::string& name) const {
    return text_of(at(of, name, "of." + name), "of." + name);
  }
  [[noreturn]] void refuse(const std::string& key, const Json& value,
                           const std::string& what) const {
    throw BadInput(fmt::format("{}: {}: {} {}", path_.string(), key, value.dump(), what));
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
  if (needs_version) compare("version", baseline.version, run.version);
  if (differences.empty()) return;
  throw BadInput(fmt::format("{}: is of something else:{}", path.string(), differences));
}

GateVerdict judge(const BaselineMetric& metric, double now) {
  const double gain = metric.better == Better::lower ? metric.value - now : now - metric.value;
  if (std::abs(gain) <= metric.tolerance) return GateVerdict::kept;
  return gain > 0.0 && metric.better != Better::same ? GateVerdict::better : GateVerdict::regressed;
}

/// Throws BadInput when the run has no such value.
double gated_value(const RunFigures& run, const BaselineMetric& metric, const fs::path& path) {
  const std::optional<double> value = value_of(run, metric.name);
  if (value) return *value;
  throw BadInput(
      fmt::format("{}: metrics.{}: the run was not scored at that size; score.sizes_m names it",
                  path.string(), metric.name));
}

}  // namespace

Baseline read_baseline(const fs::path& path) {
  const File file(path);
  return {file.subject(), file.termination(), file.metrics(), file.result_sha256()};
}

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
                 {"version", of.version}}},
               {"termination", baseline.termination},
               {"metrics", metrics}};
  if (baseline.result_sha256) json["result_sha256"] = *baseline.result_sha256;
  return json.dump(2) + "\n";
}

Baseline make_baseline(const RunFigures& run) {
  Baseline baseline{.of = subject_of(run),
                    .termination = run.termination,
                    .metrics = {},
                    .result_sha256 = std::nullopt};
  for (const Metric& metric : kGatedMetrics) {
    const double value = metric.of(run);
    baseline.metrics.push_back(
        {.name = std::string(metric.name),
         .value = value,
         .tolerance = metric.tolerance + metric.tolerance_share * std::abs(value),
         .better = metric.better});
  }
  for (const SizedCoverage& at : run.more) {
    baseline.metrics.push_back({.name = name_of_more(at),
                                .value = at.final,
                                .tolerance = kShareTolerance,
                                .better = Better::higher});
  }
  return baseline;
}

Baseline updated_baseline(const RunFigures& run, const Baseline& before, const fs::path& path) {
  need_same(before.of, subject_of(run), false, path);
  Baseline baseline = make_baseline(run);
  if (before.result_sha256) baseline.result_sha256 = run.result_sha256;
  for (const BaselineMetric& known : before.metrics) gated_value(run, known, path);
  for (BaselineMetric& metric : baseline.metrics) {
    for (const BaselineMetric& known : before.metrics) {
      if (known.name != metric.name) continue;
      metric.tolerance = known.tolerance;
      metric.better = known.better;
    }
  }
  return baseline;
}

BaselineCheck check_against(const Baseline& baseline, const fs::path& path, const RunFigures& run,
                            Versions versions) {
  need_same(baseline.of, subject_of(run), versions == Versions::have_to_agree, path);
  BaselineCheck check{.metrics = {}, .termination = run.termination};
  for (const BaselineMetric& metric : baseline.metrics) {
    const double now = gated_value(run, metric, path);
    check.metrics.push_back({metric, now, judge(metric, now)});
  }
  check.is_termination_wrong =
      run.termination == "collision" || run.termination != baseline.termination;
  check.is_hash_wrong = baseline.result_sha256 && *baseline.result_sha256 != run.result_sha256;
  return check;
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

}  // namespace gnbv
