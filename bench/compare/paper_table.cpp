#include "bench/compare/paper_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "bench/compare/row_figures.hpp"
#include "bench/compare/table_groups.hpp"
#include "bench/compare/terminal_table.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

using Row = std::vector<TableCell>;

constexpr std::string_view kCut = "ours, cut";
constexpr const char* kCutNote = "ours, cut: after as many views as the paper's row";

/// "92.8 ±0.6%" of 0.928 and 0.006 with factor 100 and unit "%".
TableCell cell(const std::optional<MeanEstimate>& e, int decimals, double factor = 1.0,
               const std::string& unit = "") {
  if (!e) return {.text = "-"};
  std::string text = grouped(factor * e->mean, decimals);
  if (e->half_width) text += " ±" + grouped(factor * *e->half_width, decimals);
  return {.text = text + unit, .values = {e->mean, e->half_width}};
}

std::vector<TableColumn> all_columns(const std::set<double>& more_m) {
  using enum ColumnKind;
  std::vector<TableColumn> columns = {{"Utility", "utility", text},
                                      {"Row", "row", text},
                                      {"Runs", "runs", number},
                                      {"Iterations", "iterations", estimate},
                                      {"Entropy reduction", "entropy_reduction", estimate},
                                      {"Distance (m)", "distance_m", estimate},
                                      {"Time (min)", "time_min", estimate},
                                      {"Coverage 0.05 m", "coverage_0.05", estimate},
                                      {"Coverage 0.10 m", "coverage_0.10", estimate},
                                      {"Coverage 0.50 m", "coverage_0.50", estimate},
                                      {"Of ceiling", "share_of_ceiling", estimate},
                                      {"Points/voxel", "density_points_per_voxel", estimate}};
  const auto after = std::find_if(columns.begin(), columns.end(),
                                  [](const TableColumn& c) { return c.key == "share_of_ceiling"; });
  std::vector<TableColumn> more;
  for (const double size_m : more_m) {
    const std::string name = size_name(size_m);
    more.push_back({"Coverage " + name + " m", "coverage_" + name, estimate});
  }
  columns.insert(after, more.begin(), more.end());
  return columns;
}

Row all_cells(const RowFigures& f, const std::set<double>& more_m) {
  Row row = {{.text = f.label}, {.text = f.kind}, {.text = "-"}};
  if (f.runs) row[2] = {std::to_string(*f.runs), {static_cast<double>(*f.runs), std::nullopt}};
  row.push_back(cell(f.iterations, 0));
  row.push_back(cell(f.entropy_reduction, 0));
  row.push_back(cell(f.distance_m, 1));
  row.push_back(cell(f.time_min, 1));
  for (std::size_t size = 0; size < f.coverage.size(); ++size) {
    row.push_back(cell(f.coverage[size], 1, 100.0, "%"));
    if (size < 2) row.back().text += f.mark;
  }
  for (const double size_m : more_m) {
    const auto at = f.more.find(size_m);
    row.push_back(at == f.more.end() ? TableCell{.text = "-"} : cell(at->second, 1, 100.0, "%"));
  }
  row.push_back(cell(f.share_of_ceiling, 1, 100.0, "%"));
  row.push_back(cell(f.density, 0));
  return row;
}

void drop_column(TextTable& table, std::string_view key) {
  const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                   [&](const TableColumn& c) { return c.key == key; });
  GNBV_CHECK(column != table.columns.end(), "no column '{}'", key);
  const auto at = column - table.columns.begin();
  table.columns.erase(column);
  for (Row& row : table.rows) row.erase(row.begin() + at);
}

/// A row a setting, and one for all settings that had the same profiles.
std::vector<RowFigures> our_profiles(const std::vector<TableGroup>& groups,
                                     const std::optional<Ceiling>& ceiling,
                                     const std::set<double>& more_m) {
  std::vector<TableGroup> by_setting;
  for (const TableGroup& group : groups) {
    auto same = std::find_if(by_setting.begin(), by_setting.end(),
                             [&](const TableGroup& g) { return g.setting == group.setting; });
    if (same == by_setting.end()) same = by_setting.insert(same, {"", group.setting});
    same->runs.insert(same->runs.end(), group.runs.begin(), group.runs.end());
  }
  std::vector<RowFigures> rows;
  std::vector<std::string> labels;
  for (const TableGroup& group : by_setting) {
    const RowFigures row = our_profile(group.runs, ceiling);
    const auto is_same = [&](const RowFigures& other) {
      return all_cells(other, more_m) == all_cells(row, more_m);
    };
    if (std::any_of(rows.begin(), rows.end(), is_same)) continue;
    rows.push_back(row);
    labels.push_back(group.label(row.label));
  }
  for (std::size_t i = 0; i < rows.size() && rows.size() > 1; ++i) rows[i].label = labels[i];
  return rows;
}

std::string three_percent(const std::array<double, 3>& fractions) {
  return fmt::format("{:.1f} / {:.1f} / {:.1f} %", 100.0 * fractions[0], 100.0 * fractions[1],
                     100.0 * fractions[2]);
}

/// "max_iterations", or "max_iterations (4), collision (1)".
std::string terminations(const RunsOfRow& runs) {
  std::map<std::string, int> counts;
  for (const RunFigures* run : runs) ++counts[run->termination];
  std::string text;
  for (const auto& [name, count] : counts) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", name);
    if (counts.size() > 1) text += fmt::format(" ({})", count);
  }
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

/// What the columns have no room for.
std::string runs_note(const std::string& utility, const RunsOfRow& runs) {
  const auto mean = [&](const auto& value_of) { return estimate(runs, value_of).mean; };
  std::array<double, 3> raw{};
  double least = 1.0;
  double most = 0.0;
  for (const RunFigures* run : runs) {
    for (std::size_t size = 0; size < 3; ++size) {
      raw[size] += run->coverage_final_raw[size] / static_cast<double>(runs.size());
    }
    least = std::min(least, run->coverage_final[0]);
    most = std::max(most, run->coverage_final[0]);
  }
  const auto views =
      static_cast<std::size_t>(std::lround(mean([](const RunFigures& r) { return r.iterations; })));
  std::string note = fmt::format(
      "{}: ended by {} after {}; flown {:.1f} m; all surface, also inner: {}; {:.1f} s "
      "of wall time",
      utility, terminations(runs), counted(views, "view", "views"),
      mean([](const RunFigures& r) { return r.flown_m; }), three_percent(raw),
      mean([](const RunFigures& r) { return r.wall_s; }));
  if (runs.size() > 1) {
    note += fmt::format(", each a mean of {}; at 0.05 m from {:.1f} to {:.1f} %", runs.size(),
                        100.0 * least, 100.0 * most);
  }
  return note;
}

bool prints_time(const PaperTable& paper) {
  return std::any_of(paper.rows.begin(), paper.rows.end(),
                     [](const PaperRow& row) { return row.time_min.has_value(); });
}

void add_notes(TextTable& table, const PaperTable& paper, bool several_runs,
               const std::optional<Ceiling>& ceiling) {
  table.notes.emplace_back(
      "coverage: of voxels of that size, ours of those with visible surface of a tenth of their "
      "face");
  const auto is_cut = [](const Row& row) { return row[1].text == kCut; };
  if (std::any_of(table.rows.begin(), table.rows.end(), is_cut)) {
    table.notes.emplace_back(kCutNote);
  }
  table.notes.push_back(fmt::format(
      "ours: entropy reduction in nat; distance in straight lines between views, profile apart{}",
      prints_time(paper) ? "; time from the first view on, as the distance" : ""));
  if (several_runs) {
    table.notes.emplace_back(
        "±: half width of the 95 % interval of the mean over the seeds (Student's t)");
  }
  if (ceiling && !ceiling->is_given) {
    table.notes.push_back(fmt::format(
        "ceiling: what legal viewpoints and the profile see, and what of it the cloud's leaf "
        "filter can keep, of exact sensors: noise can lift a mission above it; of ceiling: "
        "coverage at 0.05 m over the latter's; all surface, also inner: {}, behind the leaf filter "
        "{}",
        three_percent(ceiling->raw), three_percent(ceiling->leaf_raw)));
  }
  if (std::any_of(paper.rows.begin(), paper.rows.end(), is_doubtful)) {
    table.notes.emplace_back(
        "† as printed: more coverage at 0.05 m than at 0.10 m is hardly possible by the paper's "
        "own definition; the two columns may have changed places");
  }
}

}  // namespace

TextTable comparison_table(const PaperTable& paper, std::span<const RunFigures> runs,
                           const std::optional<Ceiling>& ceiling,
                           std::span<const std::string> settings) {
  TextTable table;
  table.title = std::string(paper.source);
  const std::set<double> more_m = more_sizes(runs);
  table.columns = all_columns(more_m);
  const auto add = [&](const RowFigures& f) { table.rows.push_back(all_cells(f, more_m)); };
  const std::vector<TableGroup> groups = table_groups(runs, settings);
  for (const PaperRow& row : paper.rows) {
    for (const TableGroup& group : groups) {
      if (group.utility != row.utility) continue;
      const std::string label = group.label(std::string(row.label));
      add(our_figures(label, group.runs, ceiling));
      if (const auto cut = our_figures_as_long(label, group.runs, row, ceiling)) add(*cut);
    }
    add(paper_figures(row));
  }
  for (const TableGroup& group : groups) {
    if (find_row(paper, group.utility) != nullptr) continue;
    add(our_figures(group.label(name_in_table(paper, group.utility)), group.runs, ceiling));
  }
  for (const RowFigures& profile : our_profiles(groups, ceiling, more_m)) add(profile);
  if (paper.profile) add(paper_figures(*paper.profile));
  if (ceiling && !ceiling->is_given) {
    add(ceiling_figures("physical", ceiling->outside));
    add(ceiling_figures("leaf filter", ceiling->leaf_outside));
  }
  if (!prints_time(paper)) drop_column(table, "time_min");
  const bool several_runs = std::any_of(
      groups.begin(), groups.end(), [](const TableGroup& group) { return group.runs.size() > 1; });
  add_notes(table, paper, several_runs, ceiling);
  for (const TableGroup& group : groups) {
    table.notes.push_back(runs_note(group.label(name_in_table(paper, group.utility)), group.runs));
  }
  return table;
}

std::string one_row_summary(const RunFigures& run, bool has_papers_setting, std::size_t width) {
  const PaperTable* const paper = find_paper_table(run.scenario);
  const PaperRow* row = paper == nullptr ? nullptr : find_row(*paper, run.utility);
  if (row != nullptr && !is_papers_structure(*paper, run.structure)) row = nullptr;
  TextTable table;
  const std::set<double> more_m = more_sizes({&run, 1});
  table.columns = all_columns(more_m);
  table.rows.push_back(all_cells(our_figures(run.utility, {&run}, {}), more_m));
  if (row != nullptr && !has_papers_setting) {
    table.notes.push_back(fmt::format("without the paper's row: {}", kOtherSetting));
  } else if (row != nullptr) {
    if (const auto cut = our_figures_as_long(run.utility, {&run}, *row, {})) {
      table.rows.push_back(all_cells(*cut, more_m));
      table.notes.emplace_back(kCutNote);
    }
    RowFigures printed_row = paper_figures(*row);
    printed_row.label = run.utility;
    table.rows.push_back(all_cells(printed_row, more_m));
    if (is_doubtful(*row)) table.notes.emplace_back("† as printed; hardly possible");
  }
  // no ceiling here: finding it may take longer than the mission
  for (const std::string_view key : {"runs", "time_min", "share_of_ceiling"}) {
    drop_column(table, key);
  }
  table.notes.push_back(runs_note(run.utility, {&run}));
  return terminal_text(table, width);
}

}  // namespace gnbv
