#include "bench/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr double kLevel = 0.05;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// What a method came to on one side of a pair.
struct Measured {
  double value = 0.0;            // kNever for an effort that did not get there within the budget
  double mean = 0.0;             // the same as means count it: of such an effort the budget
  std::string_view result = {};  // of one mission, by which it is known again
};

/// Whether this is no pair of missions that was seen before.
class Observations {
 public:
  bool are_new(const Measured& one, const Measured& other) {
    if (one.result.empty() || other.result.empty()) return true;
    return seen_.emplace(one.result, other.result).second;
  }

 private:
  std::set<std::pair<std::string_view, std::string_view>> seen_;
};

/// A seed of a scenario; or a structure. Sums go by this order, whatever that of the runs.
using Pair = std::pair<std::string, std::uint64_t>;

/// By one metric: by method, then by pair.
using Values = std::vector<std::map<Pair, Measured>>;

/// Of a name, which is added where it is new.
std::size_t index_in(std::vector<std::string>& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  const auto index = static_cast<std::size_t>(at - names.begin());
  if (at == names.end()) names.push_back(name);
  return index;
}

/// `limit`: of an effort, what counts for a mission that did not get there.
std::optional<Measured> measured(const RunMetric& metric, const MissionRow& mission,
                                 std::optional<double> limit) {
  const std::optional<double> value = metric.value(mission);
  if (!value || !metric.is_effort()) {
    return value ? std::optional(Measured{*value, *value, mission.result_sha256}) : std::nullopt;
  }
  if (!limit) return std::nullopt;
  return Measured{*value, std::min(*value, *limit), mission.result_sha256};
}

Values values_of(Comparison& comparison, std::span<const MissionRow> missions, std::size_t scenario,
                 std::size_t metric) {
  Values values(comparison.methods.size());
  const RunMetric& its = comparison.metrics[metric];
  const std::string& name = comparison.scenarios[scenario];
  // one for all: who flies less before the first view would else look faster for not getting there
  const auto limit = largest_figure(missions, name, its.limit_key);
  for (const MissionRow& mission : missions) {
    if (mission.scenario != name) continue;
    const auto value = measured(its, mission, limit);
    if (!value) continue;
    auto& of_method = values[index_in(comparison.methods, mission.method)];
    const bool is_new = of_method.emplace(Pair(mission.scenario, mission.seed), *value).second;
    GNBV_CHECK(is_new, "two missions of {}, {}, seed {}", mission.scenario, mission.method,
               mission.seed);
  }
  return values;
}

/// What each method came to in each structure, over all its runs there. `structures`: by scenario.
Values over_structures(std::span<const Values> by_scenario, std::span<const std::string> structures,
                       bool is_effort) {
  Values all(by_scenario[0].size());
  for (std::size_t method = 0; method < all.size(); ++method) {
    std::map<std::string, std::map<Pair, Measured>> runs;
    for (std::size_t s = 0; s < by_scenario.size(); ++s) {
      const auto& of_scenario = by_scenario[s][method];
      if (!of_scenario.empty()) runs[structures[s]].insert(of_scenario.begin(), of_scenario.end());
    }
    for (const auto& [structure, of_structure] : runs) {
      std::vector<double> values, means;
      for (const auto& [seed, run] : of_structure) {
        values.push_back(run.value);
        means.push_back(run.mean);
      }
      const double mean = mean_of(means);
      const double value = is_effort ? median_effort(values).value_or(kNever) : mean;
      all[method][{structure, 0}] = {value, mean};
    }
  }
  return all;
}

/// What differs in its last bits alone is equal: they depend on the order of a sum.
double difference_of(double one, double other) {
  if (one == other) return 0.0;  // infinite - infinite is no number
  const double difference = one - other;
  return std::abs(difference) < 1e-9 * std::max(std::abs(one), std::abs(other)) ? 0.0 : difference;
}

/// Ranks of the methods, a row a pair that all of them have.
std::vector<std::vector<double>> rank_blocks(const Values& values, bool higher_is_better) {
  std::vector<std::vector<double>> blocks;
  for (const auto& [pair, first] : values[0]) {
    std::vector<double> costs;
    for (const auto& of_method : values) {
      const auto at = of_method.find(pair);
      if (at == of_method.end()) continue;
      const double cost = higher_is_better ? -at->second.value : at->second.value;
      const auto same = std::ranges::find_if(
          costs, [&](double earlier) { return difference_of(earlier, cost) == 0.0; });
      costs.push_back(same == costs.end() ? cost : *same);
    }
    if (costs.size() == values.size()) blocks.push_back(ranks_of(costs));
  }
  return blocks;
}

std::optional<Contrast> contrast_of(const std::map<Pair, Measured>& method,
                                    const std::map<Pair, Measured>& baseline) {
  std::vector<double> differences, of_means, base;
  Observations pairs;
  for (const auto& [pair, its] : method) {
    const auto at = baseline.find(pair);
    if (at == baseline.end() || !pairs.are_new(its, at->second)) continue;
    const Measured& other = at->second;
    differences.push_back(difference_of(its.value, other.value));
    of_means.push_back(difference_of(its.mean, other.mean));
    base.push_back(other.mean);
  }
  if (base.empty()) return std::nullopt;
  return Contrast{.baseline_mean = mean_of(base),
                  .difference = estimate_mean(of_means),
                  .test = wilcoxon_signed_rank(differences)};
}

Verdict verdict_of(const Contrast& contrast) {
  if (contrast.difference.n < 2) return Verdict::untested;
  if (contrast.test.n == 0) return Verdict::equal;
  if (contrast.p_holm <= kLevel) return Verdict::significant;
  return least_p_holm(contrast) > kLevel ? Verdict::too_few : Verdict::not_significant;
}

/// Holm's adjustment over the family, and what follows.
void judge(std::vector<Contrast*>& family) {
  std::vector<double> p;
  for (const Contrast* contrast : family) p.push_back(contrast->test.p);
  const std::vector<double> adjusted = holm_adjusted(p);
  for (std::size_t i = 0; i < family.size(); ++i) {
    family[i]->p_holm = adjusted[i];
    family[i]->family = family.size();
    family[i]->verdict = verdict_of(*family[i]);
  }
}

std::optional<double> mean_rank(const std::vector<std::vector<double>>& blocks,
                                std::size_t method) {
  std::vector<double> ranks;
  for (const auto& block : blocks) ranks.push_back(block[method]);
  return ranks.empty() ? std::nullopt : std::optional(mean_of(ranks));
}

MethodFigure figure_of(const std::map<Pair, Measured>& of_method, bool is_effort) {
  std::vector<double> values, means;
  Observations missions;
  for (const auto& [pair, its] : of_method) {
    if (!missions.are_new(its, its)) continue;
    values.push_back(its.value);
    means.push_back(its.mean);
  }
  const auto missed = std::count(values.begin(), values.end(), kNever);
  return {.reached = values.size() - static_cast<std::size_t>(missed),
          .estimate = estimate_mean(means),
          .median = is_effort ? median_effort(values) : std::nullopt};
}

void add_figures(Comparison& comparison, std::size_t scenario, std::size_t metric,
                 const Values& values) {
  const RunMetric& its = comparison.metrics[metric];
  const bool is_judged = comparison.is_judged(scenario, metric);
  const auto blocks = rank_blocks(values, its.higher_is_better);
  const std::size_t first = comparison.figures.size();
  for (std::size_t method = 0; method < values.size(); ++method) {
    if (values[method].empty()) continue;
    MethodFigure& figure = comparison.figures.emplace_back();
    figure = figure_of(values[method], its.is_effort());
    figure.scenario = scenario;
    figure.metric = metric;
    figure.method = method;
    if (is_judged) figure.rank = mean_rank(blocks, method);
    if (method == comparison.baseline) continue;
    figure.contrast = contrast_of(values[method], values[comparison.baseline]);
  }
  if (!is_judged || !comparison.is_tested(scenario)) return;
  std::vector<Contrast*> family;
  for (std::size_t i = first; i < comparison.figures.size(); ++i) {
    if (comparison.figures[i].contrast) family.push_back(&*comparison.figures[i].contrast);
  }
  judge(family);
}

/// Whether two methods flew the same missions wherever both flew, once at least.
bool flew_the_same(std::span<const MissionRow> missions, const std::string& a,
                   const std::string& b) {
  std::size_t shared = 0;
  for (const MissionRow& one : missions) {
    for (const MissionRow& other : missions) {
      if (one.method != a || other.method != b) continue;
      if (one.scenario != other.scenario || one.seed != other.seed) continue;
      if (one.result_sha256.empty() || one.result_sha256 != other.result_sha256) return false;
      ++shared;
    }
  }
  return shared > 0;
}

Varies what_varies(std::span<const MissionRow> missions, const std::string& scenario) {
  std::map<std::string, std::vector<std::string>> results;  // by method
  bool is_noisy = false;
  for (const MissionRow& mission : missions) {
    if (mission.scenario != scenario) continue;
    results[mission.method].push_back(mission.result_sha256);
    is_noisy = is_noisy || mission.find("seeds_key_noise").value_or(0.0) > 0.0;
  }
  std::erase_if(results, [](const auto& of) { return of.second.size() < 2; });
  const auto same = std::ranges::count_if(results, [](const auto& of) {
    const std::string& first = of.second.front();
    return !first.empty() && std::ranges::count(of.second, first) == std::ssize(of.second);
  });
  if (same > 0 && same == std::ssize(results)) return Varies::nothing;
  if (is_noisy) return Varies::start_and_noise;
  return same > 0 ? Varies::draws : Varies::start;
}

/// All that is not a figure, the baseline apart. The structure of each scenario.
std::vector<std::string> add_scenarios(Comparison& comparison,
                                       std::span<const MissionRow> missions) {
  std::vector<std::string> structures;
  for (const MissionRow& mission : missions) {
    const std::size_t scenario = index_in(comparison.scenarios, mission.scenario);
    const std::string& id = mission.structure_id();
    const std::string& structure = id.empty() ? mission.scenario : id;
    if (scenario == structures.size()) {
      structures.push_back(structure);
      comparison.area_samples.push_back(
          static_cast<std::size_t>(mission.find("area_samples").value_or(0.0)));
      comparison.varies.push_back(what_varies(missions, mission.scenario));
      comparison.is_over_budget.push_back(false);
      Budgets& budgets = comparison.budgets.emplace_back();
      for (std::size_t i = 0; i < budgets.size(); ++i) {
        budgets[i] = mission.find(fmt::format("budget_{}", kEffortNames[i])).value_or(0.0);
      }
    }
    structures[scenario] = std::min(structures[scenario], structure);
    const auto within = mission.find("within_iterations");
    if (within && mission.find("iterations") > within) comparison.is_over_budget[scenario] = true;
    index_in(comparison.methods, mission.method);
  }
  comparison.metrics = metrics_of(missions);
  comparison.structures = std::set(structures.begin(), structures.end()).size();
  if (comparison.structures > 1) {
    const std::vector<bool>& over = comparison.is_over_budget;
    comparison.is_over_budget.push_back(std::ranges::count(over, true) > 0);
    comparison.scenarios.push_back(fmt::format("all {} structures", comparison.structures));
  }
  return structures;
}

}  // namespace

double least_p_holm(const Contrast& contrast) {
  // Holm's first step asks for the smallest p times the size of the family
  return static_cast<double>(contrast.family) * least_wilcoxon_p(contrast.test.n);
}

Comparison compare(std::span<const MissionRow> missions, const std::string& baseline) {
  Comparison comparison;
  std::vector<std::string>& methods = comparison.methods;
  const std::vector<std::string> structures = add_scenarios(comparison, missions);
  const std::size_t known = methods.size();
  comparison.baseline = index_in(methods, baseline);
  GNBV_CHECK(comparison.baseline < known, "no mission of the baseline '{}'", baseline);
  for (std::size_t later = 1; later < methods.size(); ++later) {
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      if (!flew_the_same(missions, methods[earlier], methods[later])) continue;
      comparison.same_missions.push_back({later, earlier});
      break;
    }
  }
  for (std::size_t metric = 0; metric < comparison.metrics.size(); ++metric) {
    std::vector<Values> by_scenario;
    for (std::size_t s = 0; s < structures.size(); ++s) {
      by_scenario.push_back(values_of(comparison, missions, s, metric));
      add_figures(comparison, s, metric, by_scenario.back());
    }
    if (comparison.structures < 2) continue;
    const bool is_effort = comparison.metrics[metric].is_effort();
    add_figures(comparison, structures.size(), metric,
                over_structures(by_scenario, structures, is_effort));
  }
  std::ranges::stable_sort(comparison.figures, {}, &MethodFigure::scenario);
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
