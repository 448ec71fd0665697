#include "tools/paper/comparisons.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/score/run_figures.hpp"
#include "sim/core/text.hpp"
#include "tools/figures/group_figures.hpp"
#include "tools/paper/verdicts.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

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

/// A row of the paper's, and what the missions of it came to.
struct FlownRow {
  const PaperRow& printed;
  std::map<std::uint64_t, Values> ours = {};  // by seed
  std::size_t views = 0;                      // that are compared, and
  std::size_t flown_views = 0;                // all of them: the most of any mission
  bool has_cut = false;
};

FlownRow flown_row(const PaperMaterial& material, const PaperTable& table, const PaperRow& row) {
  FlownRow flown{row};
  for (const PaperMission* mission : missions_of(material, table.scenario, row.utility)) {
    flown.ours.emplace(mission->seed, our_values(*mission, row));
    flown.views = std::max(flown.views, compared_views(*mission, row));
    flown.flown_views = std::max(flown.flown_views, mission->record.views.size());
    flown.has_cut = flown.has_cut || is_cut(*mission, row);
  }
  return flown;
}

/// The profile does not depend on the utility: one mission a seed.
FlownRow flown_profile(const PaperMaterial& material, const PaperTable& table) {
  FlownRow flown{*table.profile};
  for (const PaperMission& mission : material.missions) {
    if (mission.scenario != table.scenario) continue;
    flown.ours.emplace(mission.seed, profile_values(mission));
  }
  return flown;
}

/// Of one column.
Json compared_number(const std::optional<double>& printed, const std::vector<double>& ours,
                     bool is_coverage, bool has_cut) {
  Json number = {{"printed", known(printed)},
                 {"ours", nullptr},
                 {"half_width", nullptr},
                 {"difference", nullptr},
                 {"verdict", nullptr}};
  if (ours.empty()) return number;
  const MeanEstimate mean = estimate_mean(ours);
  number["ours"] = mean.mean;
  number["half_width"] = known(mean.half_width);
  if (!printed) return number;
  const double away = mean.mean - *printed;
  const PaperVerdict verdict = agreement(mean, *printed, is_coverage);
  number["difference"] = is_coverage ? away : 100.0 * away / std::abs(*printed);
  number["verdict"] = has_cut && verdict == PaperVerdict::differs ? PaperVerdict::cut : verdict;
  return number;
}

Json compared_row(const FlownRow& row) {
  const Values printed = printed_values(row.printed);
  Json figures = Json::array();
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    std::vector<double> ours;
    for (const auto& [seed, values] : row.ours) {
      if (values[i]) ours.push_back(*values[i]);
    }
    figures.push_back(compared_number(printed[i], ours, kColumns[i].is_coverage, row.has_cut));
  }
  return {{"label", row.printed.label},
          {"utility", row.printed.utility},
          {"doubtful", is_doubtful(row.printed)},
          {"missions", row.ours.size()},
          {"printed_views", known(row.printed.iterations)},
          {"views", row.views},
          {"flown_views", row.flown_views},
          {"figures", std::move(figures)}};
}

/// The first's minus the second's, paired by seed, column by column; null where one has none.
/// `pairs`: how many the table has.
Json compared_pair(const FlownRow& first, const FlownRow& second, std::size_t pairs) {
  const Values of_first = printed_values(first.printed), of_second = printed_values(second.printed);
  Json figures = Json::array();
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    std::vector<double> differences;
    for (const auto& [seed, values] : first.ours) {
      const auto other = second.ours.find(seed);
      if (other == second.ours.end() || !values[i] || !other->second[i]) continue;
      differences.push_back(*values[i] - *other->second[i]);
    }
    Json& figure = figures.emplace_back(nullptr);
    if (!of_first[i] || !of_second[i] || differences.empty()) continue;
    const double printed = *of_first[i] - *of_second[i];
    const MeanEstimate ours = estimate_mean(differences);
    const bool has_cut = first.has_cut || second.has_cut;
    figure = {{"printed", printed},
              {"ours", ours.mean},
              {"half_width", known(ours.half_width)},
              {"verdict",
               has_cut ? PaperVerdict::undecided : order_of_pair(printed, differences, pairs)}};
  }
  return {{"first", first.printed.label},
          {"second", second.printed.label},
          {"figures", std::move(figures)}};
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
  std::vector<FlownRow> flown;
  for (const PaperRow& row : table.rows) flown.push_back(flown_row(material, table, row));
  Json rows = Json::array(), pairs = Json::array();
  for (const FlownRow& row : flown) rows.push_back(compared_row(row));
  if (table.profile) rows.push_back(compared_row(flown_profile(material, table)));
  const auto n = static_cast<std::size_t>(
      std::ranges::count_if(flown, [](const FlownRow& row) { return !row.ours.empty(); }));
  // from the last row, which is Proposed, to the others
  for (std::size_t a = flown.size(); a-- > 0;) {
    for (std::size_t b = 0; b < a; ++b) {
      if (flown[a].ours.empty() || flown[b].ours.empty()) continue;
      pairs.push_back(compared_pair(flown[a], flown[b], n * (n - 1) / 2));
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
