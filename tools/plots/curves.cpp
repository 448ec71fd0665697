#include "tools/plots/curves.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "scenarios/write.hpp"
#include "sim/core/error.hpp"
#include "tools/run_files/run_names.hpp"

namespace gnbv {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

Values values_without_seed(const RunRecord& run) {
  Scenario scenario = run.scenario;
  scenario.seed = 0;
  return scenario_values(scenario);
}

std::string value_of(const Values& values, std::string_view key) {
  const auto at = std::find_if(values.begin(), values.end(),
                               [&](const auto& value) { return value.first == key; });
  return at == values.end() ? "" : at->second;
}

constexpr std::array<std::string_view, 3> kNames = {"name", "planner.utility.name",
                                                    "planner.preset"};

bool differ_in(const std::vector<Values>& groups, std::string_view key) {
  return std::any_of(groups.begin(), groups.end(), [&](const Values& values) {
    return value_of(values, key) != value_of(groups.front(), key);
  });
}

/// The keys, names apart, in which any two of the groups differ.
std::vector<std::string> differing_keys(const std::vector<Values>& groups) {
  std::vector<std::string> keys;
  for (const Values& values : groups) {
    for (const auto& [key, value] : values) {
      const bool is_known = std::find(keys.begin(), keys.end(), key) != keys.end() ||
                            std::find(kNames.begin(), kNames.end(), key) != kNames.end();
      if (!is_known && differ_in(groups, key)) keys.push_back(key);
    }
  }
  return keys;
}

/// What everybody knows methods by, as far as they differ in it.
std::string names_of(const Values& values, const std::vector<Values>& groups) {
  std::string names;
  for (const std::string_view key : kNames) {
    if (!differ_in(groups, key)) continue;
    names += (names.empty() ? "" : ", ") + value_of(values, key);
  }
  return names;
}

/// The last part of a key, or all of it where others end alike.
std::string short_key(const std::string& key, const std::vector<std::string>& keys) {
  const auto last = [](const std::string& k) { return k.substr(k.rfind('.') + 1); };
  const auto alike = std::count_if(keys.begin(), keys.end(),
                                   [&](const std::string& k) { return last(k) == last(key); });
  return alike > 1 ? key : last(key);
}

/// By names; those that have them in common by the keys in which they differ, or by their folders
/// where these are too many to read.
std::vector<std::string> labels_of(const std::vector<Values>& groups,
                                   const std::vector<std::string>& folders) {
  constexpr std::size_t kReadable = 2;
  if (groups.size() == 1) {
    return {value_of(groups[0], "name") + ", " + value_of(groups[0], "planner.utility.name")};
  }
  std::vector<std::string> labels;
  for (const Values& own : groups) {
    const std::string names = names_of(own, groups);
    std::vector<Values> namesakes;
    std::copy_if(groups.begin(), groups.end(), std::back_inserter(namesakes),
                 [&](const Values& other) { return names_of(other, groups) == names; });
    const std::vector<std::string> keys = differing_keys(namesakes);
    std::vector<std::string> words;
    if (!names.empty()) words.push_back(names);
    if (keys.size() > kReadable) words.push_back(folders[labels.size()]);
    for (const std::string& key : keys) {
      if (keys.size() > kReadable) break;
      words.push_back(short_key(key, keys) + "=" + value_of(own, key));
    }
    labels.push_back(fmt::format("{}", fmt::join(words, ", ")));
  }
  return labels;
}

}  // namespace

std::vector<Phase> frontier_phases(std::span<const ViewRecord> views) {
  std::vector<Phase> phases;
  bool is_open = false;
  for (const ViewRecord& view : views) {
    const bool is_frontier = view.decision.sampler == "fvs";
    if (is_frontier && !is_open) phases.push_back({view.iteration, view.iteration});
    if (is_frontier) phases.back().last = view.iteration;
    is_open = is_frontier;
  }
  return phases;
}

std::vector<double> moving_mean(std::span<const double> values, std::size_t window) {
  GNBV_CHECK(window % 2 == 1, "a window of {}", window);
  std::vector<double> means;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t reach = std::min({window / 2, i, values.size() - 1 - i});
    means.push_back(mean_of(values.subspan(i - reach, 2 * reach + 1)));
  }
  return means;
}

double whole_effort(const CoverageCurve& curve, Effort effort) {
  return effort_at(curve, effort, curve.views());
}

double coverage_at(const CoverageCurve& curve, Effort effort, std::size_t size, double at) {
  std::size_t next = 0;
  while (next < curve.coverage.size() && effort_at(curve, effort, next) <= at) ++next;
  if (next == 0) return curve.coverage.front()[size];
  const double before = curve.coverage[next - 1][size];
  if (next == curve.coverage.size()) return before;
  const double begin = effort_at(curve, effort, next - 1);
  const double share = (at - begin) / (effort_at(curve, effort, next) - begin);
  return before + share * (curve.coverage[next][size] - before);
}

std::vector<RunGroup> group_runs(std::span<const RunRecord> runs, std::vector<std::string>& notes) {
  std::vector<RunGroup> groups;
  std::vector<Values> values;
  for (const RunRecord& run : runs) {
    if (!run.figures || run.figures->curve.coverage.empty()) {
      notes.push_back(fmt::format("{}: has no figures: left out of coverage", run.folder.string()));
      continue;
    }
    const Values own = values_without_seed(run);
    const auto at = std::find(values.begin(), values.end(), own) - values.begin();
    if (at == std::ssize(values)) {
      values.push_back(own);
      groups.emplace_back();
    }
    RunGroup& group = groups[static_cast<std::size_t>(at)];
    const auto same = std::find_if(
        group.runs.begin(), group.runs.end(),
        [&](const RunRecord* other) { return other->scenario.seed == run.scenario.seed; });
    if (same != group.runs.end()) {
      notes.push_back(fmt::format("{}: the same mission as {}, counted once", run.folder.string(),
                                  (*same)->folder.string()));
      continue;
    }
    group.runs.push_back(&run);
  }
  if (groups.empty()) return groups;
  std::vector<std::filesystem::path> folders;
  for (const RunGroup& group : groups) folders.push_back(group.runs.front()->folder);
  const std::vector<std::string> labels = labels_of(values, run_names(folders));
  for (std::size_t i = 0; i < groups.size(); ++i) groups[i].label = labels[i];
  return groups;
}

std::vector<CoveragePoint> mean_coverage(const RunGroup& group, Effort effort, std::size_t size) {
  constexpr std::size_t kSteps = 200;
  double longest = 0.0;
  std::size_t most_views = 0;
  for (const RunRecord* run : group.runs) {
    longest = std::max(longest, whole_effort(run->figures->curve, effort));
    most_views = std::max(most_views, run->figures->curve.views());
  }
  const bool is_single = group.runs.size() == 1;
  const bool by_views = is_single || effort == Effort::views || most_views == 0;
  const std::size_t steps = by_views ? most_views : kSteps;
  std::vector<CoveragePoint> points;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double at = is_single ? effort_at(group.runs.front()->figures->curve, effort, i)
                                : longest * static_cast<double>(i) /
                                      static_cast<double>(std::max<std::size_t>(steps, 1));
    std::vector<double> shares;
    for (const RunRecord* run : group.runs) {
      // two views at one place take no metres: a run's own point is the view's
      shares.push_back(is_single ? run->figures->curve.coverage[i][size]
                                 : coverage_at(run->figures->curve, effort, size, at));
    }
    points.push_back({at, estimate_mean(shares)});
  }
  return points;
}

}  // namespace gnbv
