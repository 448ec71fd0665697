#include "bench/compare/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr double kLevel = 0.05;

/// The values of one metric in one scenario: by method, then by seed.
using Values = std::vector<std::map<std::uint64_t, double>>;

/// Of a name, which is added where it is new.
std::size_t index_in(std::vector<std::string>& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  const auto index = static_cast<std::size_t>(at - names.begin());
  if (at == names.end()) names.push_back(name);
  return index;
}

Values values_of(Comparison& comparison, std::span<const ComparedRun> runs,
                 const Ceilings& ceilings, std::size_t scenario, std::size_t metric) {
  Values values(comparison.methods.size());
  for (const ComparedRun& run : runs) {
    if (run.scenario != comparison.scenarios[scenario]) continue;
    MetricContext context{.budgets = comparison.budgets[scenario]};
    const auto ceiling = ceilings.find({run.scenario, run.method});
    if (ceiling != ceilings.end()) context.ceiling = ceiling->second;
    const auto value = comparison.metrics[metric].value(run.figures, context);
    if (!value) continue;
    auto& of_method = values[index_in(comparison.methods, run.method)];
    const bool is_new = of_method.emplace(run.seed, *value).second;
    GNBV_CHECK(is_new, "two runs of {}, {}, seed {}", run.scenario, run.method, run.seed);
  }
  return values;
}

/// Ranks of the methods, a row a seed that all of them have.
std::vector<std::vector<double>> rank_blocks(const Values& values, bool higher_is_better) {
  std::vector<std::vector<double>> blocks;
  for (const auto& [seed, first] : values[0]) {
    std::vector<double> costs;
    for (const auto& of_method : values) {
      const auto at = of_method.find(seed);
      if (at != of_method.end()) costs.push_back(higher_is_better ? -at->second : at->second);
    }
    if (costs.size() == values.size()) blocks.push_back(ranks_of(costs));
  }
  return blocks;
}

std::optional<Contrast> contrast_of(const std::map<std::uint64_t, double>& method,
                                    const std::map<std::uint64_t, double>& baseline) {
  std::vector<double> differences;
  std::vector<double> finite;
  std::vector<double> base;  // of the finite ones
  for (const auto& [seed, value] : method) {
    const auto at = baseline.find(seed);
    if (at == baseline.end()) continue;
    differences.push_back(value == at->second ? 0.0
                                              : value - at->second);  // inf - inf is no number
    if (std::isinf(value) || std::isinf(at->second)) continue;
    finite.push_back(differences.back());
    base.push_back(at->second);
  }
  if (differences.empty()) return std::nullopt;
  Contrast contrast;
  contrast.pairs = differences.size();
  if (!finite.empty()) {
    contrast.baseline_mean = mean_of(base);
    contrast.difference = estimate_mean(finite);
  }
  const SignedRankTest test = wilcoxon_signed_rank(differences);
  contrast.differing = test.n;
  contrast.is_above = test.w_plus > 0.25 * static_cast<double>(test.n * (test.n + 1));
  contrast.p = test.p;
  if (contrast.pairs > 1 && contrast.differing == 0) contrast.verdict = Verdict::equal;
  return contrast;
}

/// Of all pairs: a mean over those where both got there says nothing of the others.
bool interval_excludes_zero(const Contrast& contrast) {
  const MeanEstimate& d = contrast.difference;
  return d.n == contrast.pairs && d.half_width && std::abs(d.mean) > *d.half_width;
}

/// Holm's adjustment over the family, and what follows.
void judge(std::vector<Contrast*>& family) {
  std::vector<double> p;
  for (const Contrast* contrast : family) p.push_back(contrast->p);
  const std::vector<double> adjusted = holm_adjusted(p);
  for (std::size_t i = 0; i < family.size(); ++i) {
    Contrast& contrast = *family[i];
    contrast.p_holm = adjusted[i];
    contrast.family = family.size();
    if (contrast.verdict == Verdict::equal || contrast.pairs < 2) continue;
    contrast.verdict = contrast.p_holm <= kLevel ? Verdict::significant
                       : least_p_holm(contrast) > kLevel && interval_excludes_zero(contrast)
                           ? Verdict::interval_only
                           : Verdict::not_significant;
  }
}

MeanEstimate estimate_of_finite(const std::map<std::uint64_t, double>& by_seed) {
  std::vector<double> values;
  for (const auto& [seed, value] : by_seed) {
    if (std::isfinite(value)) values.push_back(value);
  }
  return values.empty() ? MeanEstimate{} : estimate_mean(values);
}

std::optional<double> mean_rank(const std::vector<std::vector<double>>& blocks,
                                std::size_t method) {
  std::vector<double> ranks;
  for (const auto& block : blocks) ranks.push_back(block[method]);
  return ranks.empty() ? std::nullopt : std::optional(mean_of(ranks));
}

void add_figures(Comparison& comparison, std::size_t scenario, std::size_t metric,
                 const Values& values, const std::vector<std::vector<double>>& blocks) {
  const std::size_t first = comparison.figures.size();
  for (std::size_t method = 0; method < values.size(); ++method) {
    if (values[method].empty()) continue;
    MethodFigure& figure = comparison.figures.emplace_back();
    figure = {.scenario = scenario,
              .metric = metric,
              .method = method,
              .runs = values[method].size(),
              .estimate = estimate_of_finite(values[method]),
              .rank = mean_rank(blocks, method)};
    if (method != comparison.baseline) {
      figure.contrast = contrast_of(values[method], values[comparison.baseline]);
    }
  }
  std::vector<Contrast*> family;
  for (std::size_t i = first; i < comparison.figures.size(); ++i) {
    if (comparison.figures[i].contrast) family.push_back(&*comparison.figures[i].contrast);
  }
  judge(family);
}

/// Whether two methods flew the same missions wherever both flew, once at least.
bool flew_the_same(std::span<const ComparedRun> runs, const std::string& a, const std::string& b) {
  std::size_t shared = 0;
  for (const ComparedRun& one : runs) {
    for (const ComparedRun& other : runs) {
      if (one.method != a || other.method != b) continue;
      if (one.scenario != other.scenario || one.seed != other.seed) continue;
      const std::string& hash = one.figures.result_sha256;
      if (hash.empty() || hash != other.figures.result_sha256) return false;
      ++shared;
    }
  }
  return shared > 0;
}

}  // namespace

double least_p_holm(const Contrast& contrast) {
  // Holm's first step asks for the smallest p times the size of the family
  return static_cast<double>(contrast.family) * least_wilcoxon_p(contrast.differing);
}

Comparison compare(std::span<const ComparedRun> runs, const std::string& baseline,
                   const Ceilings& ceilings) {
  Comparison comparison;
  auto& [metrics, scenarios, area_samples, methods, base, budgets, figures, ranks, same_missions] =
      comparison;
  std::vector<const RunFigures*> all;
  std::vector<std::vector<const RunFigures*>> by_scenario;
  for (const ComparedRun& run : runs) {
    const std::size_t scenario = index_in(scenarios, run.scenario);
    by_scenario.resize(scenarios.size());
    area_samples.resize(scenarios.size(), run.figures.area_samples);
    by_scenario[scenario].push_back(&run.figures);
    all.push_back(&run.figures);
    index_in(methods, run.method);
  }
  metrics = metrics_of(all);
  for (const auto& of_scenario : by_scenario) budgets.push_back(common_budgets(of_scenario));
  const std::size_t known = methods.size();
  base = index_in(methods, baseline);
  GNBV_CHECK(base < known, "no run of the baseline '{}'", baseline);
  for (std::size_t later = 1; later < methods.size(); ++later) {
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      if (!flew_the_same(runs, methods[earlier], methods[later])) continue;
      same_missions.push_back({later, earlier});
      break;
    }
  }
  for (std::size_t metric = 0; metric < metrics.size(); ++metric) {
    std::vector<std::vector<double>> of_all;
    for (std::size_t s = 0; s < scenarios.size(); ++s) {
      const Values values = values_of(comparison, runs, ceilings, s, metric);
      const auto blocks = rank_blocks(values, metrics[metric].higher_is_better);
      add_figures(comparison, s, metric, values, blocks);
      of_all.insert(of_all.end(), blocks.begin(), blocks.end());
    }
    for (std::size_t method = 0; method < methods.size() && !of_all.empty(); ++method) {
      ranks.push_back({metric, method, of_all.size(), *mean_rank(of_all, method)});
    }
  }
  std::stable_sort(figures.begin(), figures.end(),
                   [](const auto& a, const auto& b) { return a.scenario < b.scenario; });
  return comparison;
}

const MethodFigure* find_figure(const Comparison& comparison, std::size_t scenario,
                                std::string_view metric, std::size_t method) {
  const auto figure = std::find_if(
      comparison.figures.begin(), comparison.figures.end(), [&](const MethodFigure& f) {
        return f.scenario == scenario && comparison.metrics[f.metric].name == metric &&
               f.method == method;
      });
  return figure == comparison.figures.end() ? nullptr : &*figure;
}

}  // namespace gnbv
