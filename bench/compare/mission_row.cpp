#include "bench/compare/mission_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bench/compare/paper_figures.hpp"
#include "bench/score/voxel_set.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kAllViews = std::numeric_limits<std::size_t>::max();

void add_coverage(std::string_view prefix, const std::array<double, 3>& by_size, Figures& figures) {
  for (std::size_t i = 0; i < by_size.size(); ++i) {
    figures[fmt::format("{}coverage_{}", prefix, size_name(kCoverageSizes_m[i]))] = by_size[i];
  }
}

void add_more(std::string_view prefix, const RunFigures& run, auto&& share_of, Figures& figures) {
  for (const SizedCoverage& at : run.more) {
    figures[fmt::format("{}coverage_{}", prefix, size_name(at.size_m))] = share_of(at);
  }
}

/// After so many views, or at the end of a run that took fewer.
void add_after(std::string_view prefix, const RunFigures& run, std::size_t views,
               Figures& figures) {
  const CoverageCurve& curve = run.curve;
  const bool is_cut = curve.views() > views;
  const auto name = [&](std::string_view what) { return fmt::format("{}{}", prefix, what); };
  figures[name("iterations")] = is_cut ? static_cast<double>(views) : run.iterations;
  figures[name("distance_m")] = is_cut ? curve.metres[views] : run.straight_m;
  if (curve.seconds.size() > 1) {
    figures[name("time_min")] = seconds_of_views(curve, std::min(views, curve.views())) / 60.0;
  }
  add_coverage(prefix, is_cut ? curve.coverage[views] : run.coverage_final, figures);
  if (run.coverage_accurate && (!is_cut || views < curve.accurate.size())) {
    add_coverage(name("accurate_"), is_cut ? curve.accurate[views] : *run.coverage_accurate,
                 figures);
  }
  add_more(
      prefix, run,
      [&](const SizedCoverage& at) { return views < at.curve.size() ? at.curve[views] : at.final; },
      figures);
}

/// What is reached beyond a budget is not reached; the budget is that of the views, whatever was
/// spent before them.
void add_efforts(const RunFigures& run, double ceiling, Figures& figures) {
  const CoverageCurve& curve = run.curve;
  for (std::size_t i = 0; i < kReachShares.size(); ++i) {
    const auto reached = entry_that_covers(curve, kReachShares[i] * ceiling);
    const auto add = [&](Effort effort, Effort judged) {
      if (!is_known(curve, effort)) return;
      const double budget = run.budgets[static_cast<std::size_t>(judged)];
      const bool is_within =
          reached && (budget <= 0.0 || effort_at(curve, run.before, judged, *reached) <= budget);
      figures[figure_to_reach(effort, kReachNames[i])] =
          is_within ? effort_at(curve, run.before, effort, *reached)
                    : std::numeric_limits<double>::infinity();
      if (effort != Effort::wh_with_profile) return;
      figures[fmt::format("{}{}", kOneBatteryTo, kReachNames[i])] =
          is_within && curve.on_one_battery[*reached] ? 1.0 : 0.0;
    };
    add(Effort::views, Effort::views);
    add(Effort::metres, Effort::metres);
    add(Effort::metres_with_profile, Effort::metres);
    add(Effort::seconds, Effort::seconds);
    add(Effort::seconds_with_profile, Effort::seconds);
    add(Effort::wh_with_profile, Effort::seconds);
  }
}

void add_budgets(const RunFigures& run, Figures& figures) {
  for (std::size_t i = 0; i < run.budgets.size() && !run.curve.coverage.empty(); ++i) {
    if (run.budgets[i] <= 0.0) continue;
    figures[fmt::format("budget_{}", kEffortNames[i])] = run.budgets[i];
    figures[fmt::format("mean_coverage_{}", kEffortNames[i])] =
        area_under_coverage(run.curve, static_cast<Effort>(i), 0, run.budgets[i]);
  }
  const auto& [views, metres, seconds] = run.budgets;
  const BeforeViews& before = run.before;
  if (metres > 0.0) {
    figures["budget_metres_with_profile"] = before.profile_m + before.transfer_m + metres;
  }
  if (seconds > 0.0) {
    const double all_s = before.profile_end_s + seconds;
    figures["budget_seconds_with_profile"] = all_s;
    if (run.flight_time_s > 0.0) {
      figures["budget_wh_with_profile"] = all_s * run.energy_wh / run.flight_time_s;
    }
  }
}

Figures figures_of(const RunFigures& run) {
  Figures figures = {{"entropy_reduction", run.entropy_reduction_nat},
                     {"density_points_per_voxel", run.density_points_per_voxel},
                     {"flown_m", run.flown_m},
                     {"flight_time_s", run.flight_time_s},
                     {"energy_wh", run.energy_wh},
                     {"wall_s", run.wall_s},
                     {"noisy", run.is_noisy ? 1.0 : 0.0},
                     {"area_samples", static_cast<double>(run.area_samples)},
                     {"profile_distance_m", run.before.profile_m}};
  if (run.distances.at[1].distance_m > 0.0) {  // runs that an older version scored have none
    figures["f_0.05"] = run.distances.at[1].f;
    figures["chamfer_m"] = run.distances.chamfer_m;
  }
  add_after(kAtEnd, run, kAllViews, figures);
  add_coverage(kProfile, run.coverage_profile, figures);
  add_more(
      kProfile, run, [](const SizedCoverage& at) { return at.profile; }, figures);
  add_coverage("raw_", run.coverage_final_raw, figures);
  if (!run.curve.accurate.empty()) {
    add_coverage("profile_accurate_", run.curve.accurate.front(), figures);
  }
  const PaperTable* const paper = find_paper_table(run.scenario);
  const PaperRow* const row = paper == nullptr ? nullptr : find_row(*paper, run.utility);
  const auto papers_views = static_cast<std::size_t>(row ? row->iterations.value_or(0) : 0);
  if (papers_views > 0 && run.curve.views() > papers_views) {
    add_after(kCut, run, papers_views, figures);
  }
  const auto budget = static_cast<std::size_t>(run.budgets[0]);
  add_after(kWithin, run, budget > 0 ? budget : kAllViews, figures);
  add_budgets(run, figures);
  return figures;
}

}  // namespace

std::string figure_to_reach(Effort effort, std::string_view share) {
  std::string_view unit = name_of(effort);
  constexpr std::string_view kBehind = "_with_profile";
  const bool is_behind = unit.ends_with(kBehind);
  if (is_behind) unit.remove_suffix(kBehind.size());
  return fmt::format("{}_to_{}{}", unit, share, is_behind ? kBehind : "");
}

std::optional<double> MissionRow::find(std::string_view name) const {
  const auto at = figures.find(name);
  return at == figures.end() ? std::nullopt : std::optional(at->second);
}

std::optional<double> largest_figure(std::span<const MissionRow> missions,
                                     std::string_view scenario, std::string_view figure) {
  std::optional<double> largest;
  for (const MissionRow& mission : missions) {
    if (mission.scenario == scenario) largest = std::max(largest, mission.find(figure));
  }
  return largest;
}

MissionRow mission_row(const RunFigures& run) {
  return {.scenario = run.scenario,
          .method = run.utility,
          .seed = run.seed,
          .structure = run.structure,
          .termination = run.termination,
          .result_sha256 = run.result_sha256,
          .figures = figures_of(run)};
}

void add_ceiling(const RunFigures& run, const Ceiling& ceiling, MissionRow& row) {
  if (ceiling.leaf_counted[0] <= 0.0) return;
  for (std::size_t i = 0; i < (ceiling.is_given ? 1 : kCoverageSizes_m.size()); ++i) {
    const std::string size = size_name(kCoverageSizes_m[i]);
    row.figures["ceiling_" + size] = ceiling.leaf_counted[i];
    if (!ceiling.is_given) row.figures["physical_ceiling_" + size] = ceiling.counted[i];
  }
  row.figures["within_share_of_ceiling"] =
      row.figures["within_coverage_0.05"] / ceiling.leaf_counted[0];
  if (!run.curve.coverage.empty()) add_efforts(run, ceiling.leaf_counted[0], row.figures);
}

Figures with_prefix(const Figures& figures, std::string_view prefix) {
  if (prefix.empty()) return figures;
  Figures out;
  for (auto at = figures.lower_bound(prefix); at != figures.end(); ++at) {
    if (!at->first.starts_with(prefix)) break;
    out.emplace(at->first.substr(prefix.size()), at->second);
  }
  return out;
}

}  // namespace gnbv
