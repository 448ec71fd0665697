#include "tools/paper/comparisons.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/score/effort_to_reach.hpp"
#include "tools/figures/group_figures.hpp"
#include "tools/paper/verdicts.hpp"
#include "tools/run/words.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
using Missions = std::vector<const PaperMission*>;

struct Column {
  const char* head;
  int decimals;
  bool is_coverage;
};
constexpr std::array<Column, 7> kColumns = {{{"Entropy reduction", 0, false},
                                             {"Distance (m)", 1, false},
                                             {"Time (min)", 1, false},
                                             {"0.05 m (%)", 1, true},
                                             {"0.10 m (%)", 1, true},
                                             {"0.50 m (%)", 1, true},
                                             {"Points/voxel", 0, false}}};
using Values = std::array<std::optional<double>, kColumns.size()>;  // each may be missing

Values printed_values(const PaperRow& row) {
  Values values = {row.entropy_reduction, row.distance_m, row.time_min};
  for (std::size_t size = 0; row.coverage_percent && size < 3; ++size) {
    values[3 + size] = (*row.coverage_percent)[size];
  }
  values[6] = row.density_points_per_voxel;
  return values;
}

/// Of a mission after its first views: as many as the row has, or all where there are fewer.
std::size_t compared_views(const PaperMission& mission, const PaperRow& row) {
  const std::size_t flown = mission.record.views.size();
  return row.iterations ? std::min(flown, static_cast<std::size_t>(*row.iterations)) : flown;
}

Values our_values(const PaperMission& mission, const PaperRow& row) {
  const RunFigures& figures = *mission.record.figures;
  const std::vector<ViewRecord>& flown = mission.record.views;
  const std::size_t views = compared_views(mission, row);
  Values values;
  if (views > 0) {
    const ViewRecord& last = flown[views - 1];
    // less what was found out after it
    values[0] = figures.entropy_reduction_nat - (last.entropy_nat - flown.back().entropy_nat);
    values[6] = last.density_points_per_voxel;
  }
  if (views > figures.curve.views() || figures.curve.coverage.empty()) return values;
  values[1] = figures.curve.metres[views];
  values[2] = seconds_of_views(figures.curve, views) / 60.0;
  for (std::size_t size = 0; size < 3; ++size) {
    values[3 + size] = 100.0 * figures.curve.coverage[views][size];
  }
  return values;
}

Values profile_values(const PaperMission& mission) {
  const RunFigures& figures = *mission.record.figures;
  Values values;
  values[1] = figures.before.profile_m;
  for (std::size_t size = 0; size < 3; ++size) {
    values[3 + size] = 100.0 * figures.coverage_profile[size];
  }
  return values;
}

template <typename Value>
Json known(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

bool is_any_cut(const Missions& missions, const PaperRow& row) {
  return std::any_of(missions.begin(), missions.end(),
                     [&](const PaperMission* mission) { return is_cut(*mission, row); });
}

/// Ours beside what a row prints, column by column; `ours` are the values of its missions.
Json compared_figures(const PaperRow& row, const std::vector<Values>& ours, bool has_cut) {
  const Values printed = printed_values(row);
  Json figures = Json::array();
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    std::vector<double> values;
    for (const Values& of_mission : ours) {
      if (of_mission[i]) values.push_back(*of_mission[i]);
    }
    Json& figure = figures.emplace_back(Json{{"printed", known(printed[i])},
                                             {"ours", nullptr},
                                             {"half_width", nullptr},
                                             {"difference", nullptr},
                                             {"verdict", nullptr}});
    if (values.empty()) continue;
    const MeanEstimate mean = estimate_mean(values);
    figure["ours"] = mean.mean;
    figure["half_width"] = known(mean.half_width);
    if (!printed[i]) continue;
    const double away = mean.mean - *printed[i];
    const PaperVerdict verdict = agreement(mean, *printed[i], kColumns[i].is_coverage);
    figure["difference"] = kColumns[i].is_coverage ? away : 100.0 * away / std::abs(*printed[i]);
    figure["verdict"] = has_cut && verdict == PaperVerdict::differs ? PaperVerdict::cut : verdict;
  }
  return figures;
}

Json compared_row(const PaperRow& row, const Missions& missions) {
  std::vector<Values> ours;
  std::size_t views = 0, flown_views = 0;
  for (const PaperMission* mission : missions) {
    ours.push_back(our_values(*mission, row));
    views = std::max(views, compared_views(*mission, row));
    flown_views = std::max(flown_views, mission->record.views.size());
  }
  return {{"label", row.label},
          {"utility", row.utility},
          {"doubtful", is_doubtful(row)},
          {"missions", missions.size()},
          {"printed_views", known(row.iterations)},
          {"views", views},
          {"flown_views", flown_views},
          {"figures", compared_figures(row, ours, is_any_cut(missions, row))}};
}

/// The profile does not depend on the utility: one mission a seed.
Json compared_profile(const PaperMaterial& material, const PaperTable& table) {
  std::map<std::uint64_t, const PaperMission*> by_seed;
  for (const PaperRow& row : table.rows) {
    for (const PaperMission* mission : missions_of(material, table.scenario, row.utility)) {
      by_seed.emplace(mission->seed, mission);
    }
  }
  std::vector<Values> ours;
  for (const auto& [seed, mission] : by_seed) ours.push_back(profile_values(*mission));
  Json row = compared_row(*table.profile, {});
  row["missions"] = ours.size();
  row["figures"] = compared_figures(*table.profile, ours, false);
  return row;
}

/// The first's minus the second's, paired by seed, column by column; null where one has none.
Json compared_pair(const PaperRow& first, const Missions& of_first, const PaperRow& second,
                   const Missions& of_second) {
  const Values printed_first = printed_values(first), printed_second = printed_values(second);
  const bool has_cut = is_any_cut(of_first, first) || is_any_cut(of_second, second);
  Json figures = Json::array();
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    std::vector<double> differences;
    for (const PaperMission* a : of_first) {
      for (const PaperMission* b : of_second) {
        if (a->seed != b->seed) continue;
        const auto of_a = our_values(*a, first)[i], of_b = our_values(*b, second)[i];
        if (of_a && of_b) differences.push_back(*of_a - *of_b);
      }
    }
    Json& figure = figures.emplace_back(nullptr);
    if (!printed_first[i] || !printed_second[i] || differences.empty()) continue;
    const double printed = *printed_first[i] - *printed_second[i];
    const MeanEstimate ours = estimate_mean(differences);
    figure = {{"printed", printed},
              {"ours", ours.mean},
              {"half_width", known(ours.half_width)},
              {"verdict", has_cut ? PaperVerdict::undecided : order_of_pair(printed, differences)}};
  }
  return {{"first", first.label}, {"second", second.label}, {"figures", std::move(figures)}};
}

}  // namespace

Json compared_columns() {
  Json columns = Json::array();
  for (const Column& column : kColumns) {
    columns.push_back(
        {{"head", column.head}, {"decimals", column.decimals}, {"coverage", column.is_coverage}});
  }
  return columns;
}

bool is_cut(const PaperMission& mission, const PaperRow& row) {
  constexpr std::array<std::string_view, 5> kLimits = {"max_iterations", "max_distance",
                                                       "max_flight_time", "battery", "interrupted"};
  const bool has_fewer =
      row.iterations && mission.record.views.size() < static_cast<std::size_t>(*row.iterations);
  return has_fewer && std::find(kLimits.begin(), kLimits.end(),
                                mission.record.figures->termination) != kLimits.end();
}

Json compared_table(const PaperMaterial& material, const PaperTable& table) {
  std::vector<Missions> missions;  // of each row
  Json rows = Json::array(), pairs = Json::array();
  for (const PaperRow& row : table.rows) {
    missions.push_back(missions_of(material, table.scenario, row.utility));
    rows.push_back(compared_row(row, missions.back()));
  }
  if (table.profile) rows.push_back(compared_profile(material, table));
  // from the last row, which is Proposed, to the others
  for (std::size_t a = table.rows.size(); a-- > 0;) {
    for (std::size_t b = 0; b < a; ++b) {
      if (missions[a].empty() || missions[b].empty()) continue;
      pairs.push_back(compared_pair(table.rows[a], missions[a], table.rows[b], missions[b]));
    }
  }
  return {{"scenario", table.scenario},
          {"name", human_name(table.scenario)},
          {"source", table.source},
          {"rows", std::move(rows)},
          {"pairs", std::move(pairs)}};
}

std::vector<DrawnGroup> mean_densities(const PaperMaterial& material, const PaperTable& table) {
  std::vector<DrawnGroup> all;
  for (const PaperRow& row : table.rows) {
    std::vector<std::vector<double>> seeds;
    for (const PaperMission* mission : missions_of(material, table.scenario, row.utility)) {
      std::vector<double>& densities = seeds.emplace_back();
      for (const ViewRecord& view : mission->record.views) {
        densities.push_back(view.density_points_per_voxel);
      }
    }
    const std::string method(row.utility);  // of the paper's, which have looks of their own
    auto group =
        density_group(std::string(row.label), method_looks({&method, 1}).front(), std::move(seeds));
    if (group) all.push_back(std::move(*group));
  }
  return all;
}

}  // namespace gnbv
