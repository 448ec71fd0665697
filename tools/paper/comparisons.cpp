#include "tools/paper/comparisons.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "bench/score/run_figures.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

using Missions = std::vector<const PaperMission*>;
using Value = std::optional<double>;

const CoverageCurve& curve_of(const PaperMission& mission) { return mission.record.figures->curve; }

Value entropy_reduction(const PaperMission& m, std::size_t views) {
  const std::vector<ViewRecord>& all = m.record.views;
  if (views == 0 || views > all.size()) return std::nullopt;
  // what was left to find out after so many views, and at the end
  const double later_nat = all[views - 1].entropy_nat - all.back().entropy_nat;
  return m.record.figures->entropy_reduction_nat - later_nat;
}

Value metres(const PaperMission& m, std::size_t views) {
  if (views >= curve_of(m).metres.size()) return std::nullopt;
  return curve_of(m).metres[views];
}

Value minutes(const PaperMission& m, std::size_t views) {
  if (views >= curve_of(m).seconds.size()) return std::nullopt;
  return seconds_of_views(curve_of(m), views) / 60.0;
}

template <std::size_t Size>
Value coverage_percent(const PaperMission& m, std::size_t views) {
  if (views >= curve_of(m).coverage.size()) return std::nullopt;
  return 100.0 * curve_of(m).coverage[views][Size];
}

template <std::size_t Size>
Value printed_coverage(const PaperRow& row) {
  return row.coverage_percent ? Value((*row.coverage_percent)[Size]) : std::nullopt;
}

template <std::size_t Size>
Value profile_coverage(const PaperMission& m) {
  return 100.0 * m.record.figures->coverage_profile[Size];
}

Value density(const PaperMission& m, std::size_t views) {
  if (views == 0 || views > m.record.views.size()) return std::nullopt;
  return m.record.views[views - 1].density_points_per_voxel;
}

Value none_of(const PaperMission&) { return std::nullopt; }

const std::array<PaperFigure, 7> kFigures = {{
    {"Entropy reduction", 0, false, [](const PaperRow& r) { return r.entropy_reduction; },
     entropy_reduction, none_of},
    {"Distance (m)", 1, false, [](const PaperRow& r) { return r.distance_m; }, metres,
     [](const PaperMission& m) { return Value(m.record.figures->before.profile_m); }},
    {"Time (min)", 1, false, [](const PaperRow& r) { return r.time_min; }, minutes, none_of},
    {"0.05 m (%)", 1, true, printed_coverage<0>, coverage_percent<0>, profile_coverage<0>},
    {"0.10 m (%)", 1, true, printed_coverage<1>, coverage_percent<1>, profile_coverage<1>},
    {"0.50 m (%)", 1, true, printed_coverage<2>, coverage_percent<2>, profile_coverage<2>},
    {"Points/voxel", 0, false, [](const PaperRow& r) { return r.density_points_per_voxel; },
     density, none_of},
}};

/// How many views of a mission are compared with a row.
std::size_t views_of(const PaperMission& mission, const PaperRow& row) {
  const std::size_t flown = mission.record.views.size();
  if (!row.iterations) return flown;
  return std::min(flown, static_cast<std::size_t>(*row.iterations));
}

bool is_any_cut(const Missions& missions, const PaperRow& row) {
  return std::any_of(missions.begin(), missions.end(),
                     [&](const PaperMission* mission) { return is_cut(*mission, row); });
}

ComparedFigure compared(const PaperFigure& figure, const Value& printed,
                        const std::vector<double>& ours) {
  ComparedFigure both{.printed = printed};
  if (ours.empty()) return both;
  both.ours = estimate_mean(ours);
  if (!printed) return both;
  both.agreement = agreement(*both.ours, *printed,
                             figure.is_coverage ? kCoverageScale : scale_of_amount(*printed));
  return both;
}

ComparedRow compare_row(const PaperRow& row, const Missions& missions) {
  ComparedRow all{.label = std::string(row.label),
                  .utility = std::string(row.utility),
                  .missions = missions.size(),
                  .printed_views = row.iterations,
                  .is_doubtful = is_doubtful(row),
                  .figures = {}};
  for (const PaperMission* mission : missions) {
    all.views = std::max(all.views, static_cast<int>(views_of(*mission, row)));
    all.flown_views = std::max(all.flown_views, static_cast<int>(mission->record.views.size()));
  }
  const bool has_cut = is_any_cut(missions, row);
  for (const PaperFigure& figure : kFigures) {
    std::vector<double> values;
    for (const PaperMission* mission : missions) {
      const Value value = figure.ours(*mission, views_of(*mission, row));
      if (value) values.push_back(*value);
    }
    all.figures.push_back(compared(figure, figure.printed(row), values));
    std::optional<Agreement>& agreement = all.figures.back().agreement;
    if (has_cut && agreement == Agreement::differs) agreement = Agreement::cut;
  }
  return all;
}

/// The profile does not depend on the utility: one mission a seed.
ComparedRow compare_profile(const PaperRow& row, const PaperMaterial& material,
                            const PaperTable& table) {
  std::map<std::uint64_t, const PaperMission*> by_seed;
  for (const PaperRow& planner : table.rows) {
    for (const PaperMission* mission : missions_of(material, table.scenario, planner.utility)) {
      by_seed.emplace(mission->seed, mission);
    }
  }
  ComparedRow all{
      .label = std::string(row.label), .utility = "", .missions = by_seed.size(), .figures = {}};
  for (const PaperFigure& figure : kFigures) {
    std::vector<double> values;
    for (const auto& [seed, mission] : by_seed) {
      if (const Value value = figure.profile(*mission)) values.push_back(*value);
    }
    all.figures.push_back(compared(figure, figure.printed(row), values));
  }
  return all;
}

/// The first's minus the second's, over the seeds that both have.
std::vector<double> paired_differences(const PaperFigure& figure, const PaperRow& first,
                                       const Missions& of_first, const PaperRow& second,
                                       const Missions& of_second) {
  std::vector<double> differences;
  for (const PaperMission* a : of_first) {
    for (const PaperMission* b : of_second) {
      if (a->seed != b->seed) continue;
      const Value of_a = figure.ours(*a, views_of(*a, first));
      const Value of_b = figure.ours(*b, views_of(*b, second));
      if (of_a && of_b) differences.push_back(*of_a - *of_b);
    }
  }
  return differences;
}

}  // namespace

bool is_cut(const PaperMission& mission, const PaperRow& row) {
  constexpr std::array<std::string_view, 5> kLimits = {"max_iterations", "max_distance",
                                                       "max_flight_time", "battery", "interrupted"};
  const bool has_fewer =
      row.iterations && mission.record.views.size() < static_cast<std::size_t>(*row.iterations);
  return has_fewer && std::find(kLimits.begin(), kLimits.end(),
                                mission.record.figures->termination) != kLimits.end();
}

std::span<const PaperFigure> compared_figures() { return kFigures; }

std::vector<ComparedRow> compare_rows(const PaperMaterial& material, const PaperTable& table) {
  std::vector<ComparedRow> rows;
  for (const PaperRow& row : table.rows) {
    rows.push_back(compare_row(row, missions_of(material, table.scenario, row.utility)));
  }
  if (table.profile) rows.push_back(compare_profile(*table.profile, material, table));
  return rows;
}

std::vector<ComparedPair> compare_pairs(const PaperMaterial& material, const PaperTable& table) {
  std::vector<ComparedPair> pairs;
  // from the last row, which is Proposed, to the others
  for (std::size_t a = table.rows.size(); a-- > 0;) {
    for (std::size_t b = 0; b < a; ++b) {
      const PaperRow& first = table.rows[a];
      const PaperRow& second = table.rows[b];
      const Missions of_a = missions_of(material, table.scenario, first.utility);
      const Missions of_b = missions_of(material, table.scenario, second.utility);
      const bool has_cut = is_any_cut(of_a, first) || is_any_cut(of_b, second);
      for (std::size_t i = 0; i < kFigures.size(); ++i) {
        const Value of_first = kFigures[i].printed(first);
        const Value of_second = kFigures[i].printed(second);
        if (!of_first || !of_second) continue;
        const std::vector<double> ours = paired_differences(kFigures[i], first, of_a, second, of_b);
        if (ours.empty()) continue;
        const double printed = *of_first - *of_second;
        pairs.push_back({std::string(first.label), std::string(second.label), i, printed,
                         estimate_mean(ours),
                         has_cut ? PairOrder::undecided : pair_order(printed, ours)});
      }
    }
  }
  return pairs;
}

std::vector<DrawnGroup> mean_densities(const PaperMaterial& material, const PaperTable& table) {
  std::vector<DrawnGroup> all;
  for (const PaperRow& row : table.rows) {
    const Missions missions = missions_of(material, table.scenario, row.utility);
    if (missions.empty()) continue;
    std::vector<std::vector<double>> seeds;
    for (const PaperMission* mission : missions) {
      seeds.emplace_back();
      while (const Value value = density(*mission, seeds.back().size() + 1)) {
        seeds.back().push_back(*value);
      }
    }
    const std::string method(row.utility);  // of the paper's, which have looks of their own
    auto densities =
        density_group(std::string(row.label), method_looks({&method, 1}).front(), std::move(seeds));
    if (densities) all.push_back(std::move(*densities));
  }
  return all;
}

}  // namespace gnbv
