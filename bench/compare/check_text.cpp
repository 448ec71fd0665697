#include "bench/compare/check_text.hpp"

#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

std::string_view name_of(GateVerdict verdict) {
  switch (verdict) {
    case GateVerdict::kept:
      return "kept";
    case GateVerdict::better:
      return "better";
    case GateVerdict::regressed:
      return "regressed";
  }
  GNBV_CHECK(false, "verdict {}", static_cast<int>(verdict));
}

}  // namespace

std::string check_text(const Baseline& baseline, const BaselineCheck& check) {
  std::string text;
  std::size_t kept = 0;
  for (const MetricChange& change : check.metrics) {
    if (change.verdict == GateVerdict::kept) {
      ++kept;
      continue;
    }
    if (text.empty()) {
      text = fmt::format("{:<10}{:<24}{:>12}{:>12}{:>12}{:>12}\n", "", "metric", "baseline", "now",
                         "change", "allowed");
    }
    const BaselineMetric& metric = change.baseline;
    text += fmt::format("{:<10}{:<24}{:>12.6g}{:>12.6g}{:>+12.4g}{:>12.4g}\n",
                        name_of(change.verdict), metric.name, metric.value, change.now,
                        change.now - metric.value, metric.tolerance);
  }
  if (check.is_termination_wrong) {
    text += fmt::format("regressed termination: {}, the baseline's is {}\n", check.termination,
                        baseline.termination);
  }
  if (check.is_hash_wrong) text += "regressed result_sha256: is another\n";
  return text +
         fmt::format("{} of {} metrics within their tolerance\n", kept, check.metrics.size());
}

std::string check_json(const Baseline& baseline, const BaselineCheck& check) {
  nlohmann::ordered_json metrics = nlohmann::ordered_json::array();
  for (const MetricChange& change : check.metrics) {
    metrics.push_back({{"metric", change.baseline.name},
                       {"baseline", change.baseline.value},
                       {"now", change.now},
                       {"allowed", change.baseline.tolerance},
                       {"verdict", name_of(change.verdict)}});
  }
  const nlohmann::ordered_json json = {{"schema", "gnbv-check-1"},
                                       {"regressed", regressed(check).size()},
                                       {"termination",
                                        {{"baseline", baseline.termination},
                                         {"now", check.termination},
                                         {"regressed", check.is_termination_wrong}}},
                                       {"result_sha256_differs", check.is_hash_wrong},
                                       {"metrics", metrics}};
  return json.dump(2) + "\n";
}

}  // namespace gnbv
