#include "bench/compare/paper_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

#include "bench/compare/paper_groups.hpp"
#include "bench/compare/statistics.hpp"
#include "bench/score/surface_reference.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

using Row = std::vector<TableCell>;

constexpr const char* kCutRow = "ours, cut";
constexpr const char* kPlaceRow = "ours below";
constexpr const char* kAccurateKey = "accurate_coverage_0.05";
constexpr const char* kCutNote = "ours, cut: after as many views as the paper's row";

/// The columns, with one for each size beside the paper's that some of the runs have, and without
/// those of some keys.
std::vector<TableColumn> columns_of(std::span<const MissionRow> missions,
                                    const std::set<std::string>& without) {
  constexpr auto estimate = ColumnKind::estimate;
  std::vector<TableColumn> columns = {{"Utility", "utility"},
                                      {"Row", "row"},
                                      {"Runs", "runs", ColumnKind::number},
                                      {"Iterations", "iterations", estimate},
                                      {"Entropy reduction", "entropy_reduction", estimate},
                                      {"Distance (m)", "distance_m", estimate, 1},
                                      {"Time (min)", "time_min", estimate, 1}};
  if (std::ranges::any_of(missions, [](const MissionRow& mission) {
        return mission.find("noisy").value_or(0.0) > 0.0;
      })) {
    columns.push_back({"Accurate 0.05 m", kAccurateKey, estimate, 1, true});
  }
  std::vector<std::string> sizes;
  for (const double size_m : kCoverageSizes_m) sizes.push_back(size_name(size_m));
  std::map<double, std::string> more;
  for (const MissionRow& mission : missions) {
    for (const auto& [size, figure] : with_prefix(mission.figures, "coverage_")) {
      if (std::ranges::count(sizes, size) == 0) more[std::strtod(size.c_str(), nullptr)] = size;
    }
  }
  for (const auto& [size_m, size] : more) sizes.push_back(size);
  for (const std::string& size : sizes) {
    columns.push_back({"Coverage " + size + " m", "coverage_" + size, estimate, 1, true});
  }
  columns.push_back({"Of ceiling", "share_of_ceiling", estimate, 1, true});
  columns.push_back({"Points/voxel", "density_points_per_voxel", estimate});
  std::erase_if(columns, [&](const TableColumn& column) { return without.contains(column.key); });
  return columns;
}

/// A row of what all of `reached` know, estimated over them.
void add_row(const std::string& label, const std::string& kind, const std::vector<Figures>& reached,
             TextTable& table) {
  Row& row = table.rows.emplace_back(Row{{label}, {kind}});
  for (const TableColumn& column : std::span(table.columns).subspan(row.size())) {
    std::vector<double> values;
    for (const Figures& one : reached) {
      if (const auto at = one.find(column.key); at != one.end()) values.push_back(at->second);
    }
    const bool is_known = !values.empty() && values.size() == reached.size();
    row.push_back(!is_known
                      ? TableCell{}
                      : estimate_cell(estimate_mean(values), column.decimals, column.is_share));
    if (column.key == "runs" && kind.starts_with("ours")) {
      row.back() = {std::to_string(reached.size()), {static_cast<double>(reached.size())}};
    }
  }
}

void add_papers_row(const std::string& label, const PaperRow& row, TextTable& table) {
  add_row(label, "paper", {printed_in(row)}, table);
  for (std::size_t c = 0; is_doubtful(row) && c < table.columns.size(); ++c) {
    const std::string& key = table.columns[c].key;
    if (key == "coverage_0.05" || key == "coverage_0.10") table.rows.back()[c].text += "†";
  }
}

/// What each mission had reached by then, with its share of the ceiling; nothing where one was not
/// cut.
std::vector<Figures> reached_by(const PaperGroup& group, std::string_view prefix) {
  std::vector<Figures> all;
  for (const MissionRow* const mission : group.missions) {
    Figures figures = with_prefix(mission->figures, prefix);
    if (figures.empty()) figures = mission->figures;  // it ended before
    if (prefix == kCut) {
      for (const char* key : {"entropy_reduction", "density_points_per_voxel"}) figures.erase(key);
    }
    const auto ceiling = mission->find("ceiling_0.05");
    if (ceiling) figures["share_of_ceiling"] = figures["coverage_0.05"] / *ceiling;
    all.push_back(std::move(figures));
  }
  return all;
}

/// Ours, and ours after as many views as the paper's row took where a mission took more.
void add_ours(const PaperGroup& group, TextTable& table) {
  add_row(group.name, "ours", reached_by(group, kAtEnd), table);
  const bool is_longer = std::ranges::any_of(group.missions, [](const MissionRow* mission) {
    return !with_prefix(mission->figures, kCut).empty();
  });
  if (is_longer) add_row(group.name, kCutRow, reached_by(group, kCut), table);
}

/// The profile does not depend on the method: one mission a seed. A row a setting, and one for all
/// settings that had the same profiles.
void add_profiles(const std::vector<PaperGroup>& groups, TextTable& table) {
  std::map<std::string, std::map<std::uint64_t, const MissionRow*>> by_setting;
  std::vector<std::string> settings;
  for (const PaperGroup& group : groups) {
    if (!by_setting.contains(group.setting)) settings.push_back(group.setting);
    for (const MissionRow* const mission : group.missions) {
      by_setting[group.setting].emplace(mission->seed, mission);
    }
  }
  const auto first = static_cast<std::ptrdiff_t>(table.rows.size());
  std::vector<std::string> labels;
  for (const std::string& setting : settings) {
    PaperGroup profiles;
    for (const auto& [seed, mission] : by_setting[setting]) profiles.missions.push_back(mission);
    add_row("Profile", "ours", reached_by(profiles, kProfile), table);
    const auto last = table.rows.end() - 1;
    if (std::find(table.rows.begin() + first, last, *last) == last) {
      labels.push_back(setting.empty() ? "Profile" : "Profile, " + setting);
    } else {
      table.rows.pop_back();
    }
  }
  for (std::size_t i = 0; labels.size() > 1 && i < labels.size(); ++i) {
    table.rows[static_cast<std::size_t>(first) + i][0].text = labels[i];
  }
}

/// Of missions whose ceiling a search found.
void add_ceiling(std::span<const MissionRow> missions, TextTable& table) {
  const auto known = std::ranges::find_if(missions, [](const MissionRow& mission) {
    return mission.find("physical_ceiling_0.05").has_value();
  });
  if (known == missions.end()) return;
  const auto add = [&](const char* row, std::string_view prefix) {
    Figures figures;
    for (const auto& [size, share] : with_prefix(known->figures, prefix)) {
      figures["coverage_" + size] = share;
    }
    add_row("Ceiling", row, {figures}, table);
  };
  add("physical", "physical_ceiling_");
  add("leaf filter", "ceiling_");
  table.notes.emplace_back(
      "ceiling: the most that any planner could cover from allowed positions with exact sensors; "
      "physical: what can be seen; leaf filter: what the cloud keeps of that; noise can lift a "
      "mission above it; of ceiling: coverage at 0.05 m divided by the row leaf filter");
}

/// "max_iterations", or "max_iterations (4), collision (1)".
std::string terminations(const PaperGroup& group) {
  std::map<std::string, int> counts;
  for (const MissionRow* const mission : group.missions) ++counts[mission->termination];
  std::string text;
  for (const auto& [name, count] : counts) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", name);
    if (counts.size() > 1) text += fmt::format(" ({})", count);
  }
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

/// What the columns have no room for.
std::string missions_note(const PaperGroup& group) {
  const auto values = [&](std::string_view name) {
    std::vector<double> all;
    for (const MissionRow* const mission : group.missions) {
      all.push_back(mission->find(name).value_or(0.0));
    }
    return all;
  };
  const auto mean = [&](std::string_view name) { return mean_of(values(name)); };
  std::string note = fmt::format(
      "{}: ended by {} after {}; flown {:.1f} m; all surface, also inner: {:.1f} / {:.1f} / {:.1f} "
      "%; {:.1f} s of wall time",
      group.name, terminations(group),
      counted(static_cast<std::size_t>(std::lround(mean("iterations"))), "view", "views"),
      mean("flown_m"), 100.0 * mean("raw_coverage_0.05"), 100.0 * mean("raw_coverage_0.10"),
      100.0 * mean("raw_coverage_0.50"), mean("wall_s"));
  if (group.missions.size() > 1) {
    const auto finest = values("coverage_0.05");
    note += fmt::format(", each a mean of {}; at 0.05 m from {:.1f} to {:.1f} %", finest.size(),
                        100.0 * std::ranges::min(finest), 100.0 * std::ranges::max(finest));
  }
  return note;
}

std::size_t area_samples_of(const MissionRow& mission) {
  return static_cast<std::size_t>(mission.find("area_samples").value_or(0.0));
}

std::vector<std::string> notes_of(const TextTable& table, const PaperTable& paper,
                                  const std::vector<PaperGroup>& groups, bool prints_time) {
  const auto has_row = [&](const char* kind) {
    return std::ranges::any_of(table.rows, [&](const Row& row) { return row[1].text == kind; });
  };
  std::vector<std::string> notes = {
      fmt::format("coverage: of voxels of that size, ours of those {}",
                  reference_words(groups.empty() ? 0 : area_samples_of(*groups[0].missions[0])))};
  if (std::ranges::count(table.columns, kAccurateKey, &TableColumn::key) > 0) {
    notes.emplace_back(
        "accurate: of the same, those with a point within 0.01 m of the surface, so that noise "
        "fills none");
  }
  if (has_row(kCutRow)) notes.emplace_back(kCutNote);
  notes.push_back(fmt::format(
      "ours: entropy reduction in nat; distance in straight lines between views, profile apart{}",
      prints_time ? "; time from the first view on, as the distance" : ""));
  if (std::ranges::any_of(groups, [](const PaperGroup& g) { return g.missions.size() > 1; })) {
    notes.emplace_back(
        "±: half width of the 95 % interval of the mean over the seeds (Student's t)");
  }
  if (has_row(kPlaceRow)) {
    notes.emplace_back(
        "ours below: share of our runs that lie below the paper's figure, of which it prints one "
        "run; after as many views, entropy reduction and points/voxel at the end");
  }
  const bool is_one_setting = std::ranges::all_of(
      groups, [&](const PaperGroup& group) { return group.setting == groups.front().setting; });
  if (const std::string order = is_one_setting ? order_note(paper, groups) : ""; !order.empty()) {
    notes.push_back("the paper's order in single runs of ours, one of each method: " + order);
  }
  notes.insert(notes.end(), table.notes.begin(), table.notes.end());
  if (std::any_of(paper.rows.begin(), paper.rows.end(), is_doubtful)) {
    notes.emplace_back(
        "† as printed: more coverage at 0.05 m than at 0.10 m is hardly possible by the paper's "
        "own definition; the two columns may have changed places");
  }
  std::vector<std::string> names;
  for (const Row& row : table.rows) names.push_back(row[0].text);
  if (auto note = formulas_note(names)) notes.push_back(std::move(*note));
  for (const PaperGroup& group : groups) notes.push_back(missions_note(group));
  return notes;
}

/// Without those that were flown for one share of the ceiling.
std::vector<PaperGroup> whole_groups(const PaperTable& paper,
                                     std::span<const MissionRow> missions) {
  std::vector<PaperGroup> groups = paper_groups(paper, missions);
  std::erase_if(groups, [](const PaperGroup& g) { return g.setting.starts_with(kForShare); });
  return groups;
}

/// A group's missions with the least efforts of all that its method flew with their seeds, also for
/// single shares of the ceiling.
std::vector<MissionRow> least_efforts(const PaperGroup& group,
                                      std::span<const MissionRow> missions) {
  std::vector<MissionRow> least;
  for (const MissionRow* const mission : group.missions) {
    MissionRow& row = least.emplace_back(*mission);
    for (const MissionRow& other : missions) {
      const bool is_of_share = other.setting.starts_with(kForShare);
      if (other.method != row.method || other.seed != row.seed || !is_of_share) continue;
      for (auto& [name, value] : row.figures) {
        if (name.find("_to_") == std::string::npos) continue;
        const double others = other.find(name).value_or(value);
        value = name.starts_with(kOneBatteryTo) ? std::max(value, others) : std::min(value, others);
      }
    }
  }
  return least;
}

/// The median, how many got there, and the mean in which the others have spent the budget.
TableCell effort_cell(std::span<const MissionRow> missions, std::string_view name,
                      std::optional<double> budget) {
  std::vector<double> efforts, restricted;
  for (const MissionRow& mission : missions) {
    const auto effort = mission.find(name);
    if (!effort) return {};  // nobody knows
    efforts.push_back(*effort);
    restricted.push_back(std::min(*effort, budget.value_or(*effort)));
  }
  const auto there = static_cast<double>(
      std::ranges::count_if(efforts, [](double effort) { return std::isfinite(effort); }));
  const std::optional<double> median = median_effort(efforts);
  const double mean = mean_of(restricted);
  return {fmt::format("{} ({:.0f} of {}){}", median ? grouped(*median, 1) : "-", there,
                      efforts.size(), std::isfinite(mean) ? ", " + grouped(mean, 1) : ""),
          {median, there}};
}

/// How many got there on one battery, of those of which it is known of all.
TableCell battery_cell(std::span<const MissionRow> missions, std::string_view name) {
  double there = 0.0;
  for (const MissionRow& mission : missions) {
    const auto is_there = mission.find(name);
    if (!is_there) return {};
    there += *is_there;
  }
  return {fmt::format("{:.0f} of {}", there, missions.size()), {there}};
}

struct EffortWords {
  const char* title;
  const char* unit;
  const char* short_unit;
  const char* from;
};

constexpr std::array<EffortWords, kEfforts.size()> kEffortWords = {
    {{"Views", "views", "views", "the first view"},
     {"Metres", "metres", "m", "the first view"},
     {"Seconds", "seconds", "s", "the end of the profile"},
     {"Metres", "metres", "m", "take-off"},
     {"Seconds", "seconds", "s", "take-off"},
     {"Wh", "Wh", "Wh", "take-off"}}};

std::string budget_of(Effort effort) { return fmt::format("budget_{}", name_of(effort)); }

/// A column a share and effort, behind its head the words given with it; without those that nobody
/// knows.
TextTable effort_columns(const PaperTable& paper,
                         const std::vector<std::pair<Effort, const char*>>& efforts,
                         std::span<const std::string_view> shares,
                         std::span<const MissionRow> missions) {
  TextTable table{.columns = {{"Utility", "utility"}, {"Row", "row"}}};
  std::vector<std::vector<MissionRow>> groups;
  for (const PaperGroup& group : whole_groups(paper, missions)) {
    if (!group.missions[0]->find("ceiling_0.05")) continue;
    table.rows.push_back({{group.name}, {"ours"}});
    const bool is_plain = group.setting.empty();
    groups.push_back(least_efforts(group, is_plain ? missions : std::span<const MissionRow>()));
  }
  const auto add = [&](TableColumn column, const auto& cell_of) {
    std::vector<TableCell> cells;
    for (const auto& group : groups) cells.push_back(cell_of(group));
    if (std::ranges::count(cells, TableCell{}) == std::ssize(cells)) return;
    table.columns.push_back(std::move(column));
    for (std::size_t i = 0; i < cells.size(); ++i) table.rows[i].push_back(std::move(cells[i]));
  };
  for (const std::string_view share : shares) {
    for (const auto& [effort, behind] : efforts) {
      const std::string percent(share.substr(2));
      const std::string head = *behind == '\0' ? "" : "To ";
      // one for all rows, whatever each flew before its first view
      const auto budget = largest_figure(missions, paper.scenario, budget_of(effort));
      add({fmt::format("{}{}%{}", head, percent, behind),
           fmt::format("{}_to_{}", name_of(effort), percent), ColumnKind::counted},
          [&, effort = effort](const auto& group) {  // clang 14 captures no binding
            return effort_cell(group, figure_to_reach(effort, share), budget);
          });
      if (effort != Effort::wh_with_profile) continue;
      add({fmt::format("{}{}% on one battery", head, percent),
           fmt::format("{}{}", kOneBatteryTo, percent), ColumnKind::number},
          [&](const auto& group) {
            return battery_cell(group, fmt::format("{}{}", kOneBatteryTo, share));
          });
    }
  }
  return table;
}

}  // namespace

TextTable comparison_table(const PaperTable& paper, std::span<const MissionRow> missions) {
  const bool prints_time =
      std::any_of(paper.rows.begin(), paper.rows.end(),
                  [](const PaperRow& row) { return row.time_min.has_value(); });
  TextTable table{.title = std::string(paper.source),
                  .columns = columns_of(missions, {prints_time ? "" : "time_min"})};
  const std::vector<PaperGroup> groups = whole_groups(paper, missions);
  for (const PaperRow& row : paper.rows) {
    for (const PaperGroup& group : groups) {
      if (group.method == row.utility) add_ours(group, table);
    }
    add_papers_row(std::string(row.label), row, table);
    for (const PaperGroup& group : groups) {
      if (group.method != row.utility || group.missions.size() < 2) continue;
      Row& place = table.rows.emplace_back(Row{{group.name}, {kPlaceRow}});
      const auto cells = place_cells(group, row, std::span(table.columns).subspan(place.size()));
      place.insert(place.end(), cells.begin(), cells.end());
    }
  }
  for (const PaperGroup& group : groups) {
    if (find_row(paper, group.method) == nullptr) add_ours(group, table);
  }
  add_profiles(groups, table);
  if (paper.profile) add_papers_row("Profile", *paper.profile, table);
  add_ceiling(missions, table);
  table.notes = notes_of(table, paper, groups, prints_time);
  return table;
}

TextTable effort_table(const PaperTable& paper, Effort effort,
                       std::span<const MissionRow> missions) {
  const EffortWords& words = kEffortWords.at(static_cast<std::size_t>(effort));
  TextTable table = effort_columns(paper, {{effort, ""}}, kReachNames, missions);
  table.title = fmt::format("{}{} to reach the ceiling", words.title,
                            is_from_take_off(effort) ? " from take-off" : "");
  if (table.rows.empty()) return table;
  const auto budget = is_from_take_off(effort) ? std::nullopt : missions[0].find(budget_of(effort));
  table.notes = {fmt::format(
      "{} from {} on until the cloud first covered so much of its ceiling at 0.05 m: median, "
      "where a mission that did not get there{} counts as more than all others; how many got "
      "there; mean, where it counts as the {}budget; an oracle of few metres or seconds flies once "
      "for each share, and the least counts{}",
      words.unit, words.from,
      budget ? fmt::format(" within the budget of {:g} {}", *budget, words.short_unit) : "",
      is_from_take_off(effort) ? "largest " : "",
      effort == Effort::wh_with_profile ? "; on one battery: with the way home" : "")};
  return table;
}

TextTable take_off_table(const PaperTable& paper, std::span<const MissionRow> missions) {
  constexpr std::array<std::string_view, 1> kShare = {"0.95"};
  TextTable table = effort_columns(paper,
                                   {{Effort::seconds_with_profile, " (s)"},
                                    {Effort::metres_with_profile, " (m)"},
                                    {Effort::wh_with_profile, " (Wh)"}},
                                   kShare, missions);
  if (table.columns.size() > kSharedColumns) {
    table.notes = {
        "to 95%: from take-off, with the profile, until the cloud first covered 95 % of its "
        "ceiling at 0.05 m: median, how many got there, mean; on one battery: with the way home"};
  }
  return table;
}

std::string one_row_summary(const MissionRow& mission, bool has_papers_setting, std::size_t width) {
  const PaperTable* const paper = find_paper_table(mission.scenario);
  const PaperRow* row = paper == nullptr ? nullptr : find_row(*paper, mission.method);
  if (row != nullptr && !is_papers_structure(*paper, mission.structure)) row = nullptr;
  // no ceiling here: finding it may take longer than the mission
  TextTable table{.columns = columns_of({&mission, 1}, {"runs", "time_min", "share_of_ceiling"})};
  const PaperGroup group{mission.method, mission.setting, mission.method, {&mission}};
  add_row(group.name, "ours", reached_by(group, kAtEnd), table);
  const bool is_beside = row != nullptr && has_papers_setting;
  if (is_beside && !with_prefix(mission.figures, kCut).empty()) {
    add_row(group.name, kCutRow, reached_by(group, kCut), table);
    table.notes.emplace_back(kCutNote);
  }
  if (is_beside) {
    add_papers_row(group.name, *row, table);
    if (is_doubtful(*row)) table.notes.emplace_back("† as printed; hardly possible");
  } else if (row != nullptr) {
    table.notes.push_back(fmt::format("without the paper's row: {}", kOtherSetting));
  }
  const std::size_t area_samples = area_samples_of(mission);
  if (area_samples > 0) {
    table.notes.push_back("coverage: ours of voxels " + reference_words(area_samples));
  }
  table.notes.push_back(missions_note(group));
  return terminal_text(table, width);
}

}  // namespace gnbv
