#include "bench/compare/paper_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "bench/score/run_figures.hpp"
#include "bench/score/surface_reference.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

using Row = std::vector<TableCell>;

constexpr const char* kCut = "ours, cut";
constexpr const char* kPlace = "ours below";
constexpr const char* kCutNote = "ours, cut: after as many views as the paper's row";

/// Runs that differ in their seeds alone.
using Seeds = std::vector<const RunFigures*>;

/// What a mission had reached, or the paper prints, by the keys of columns. What is not known is
/// not there.
using Reached = std::map<std::string, double>;

std::string coverage_key(double size_m) { return "coverage_" + size_name(size_m); }

/// After so many views, or at its end if that was before. Of entropy and density only the end is
/// known.
Reached after_views(const RunFigures& run, std::size_t views) {
  const CoverageCurve& curve = run.curve;
  const bool is_cut = curve.views() > views;
  Reached reached = {{"iterations", is_cut ? static_cast<double>(views) : run.iterations},
                     {"distance_m", is_cut ? curve.metres[views] : run.straight_m}};
  if (curve.seconds.size() > 1) {
    reached["time_min"] = seconds_of_views(curve, std::min(views, curve.views())) / 60.0;
  }
  for (std::size_t i = 0; i < kCoverageSizes_m.size(); ++i) {
    reached[coverage_key(kCoverageSizes_m[i])] =
        is_cut ? curve.coverage[views][i] : run.coverage_final[i];
  }
  for (const SizedCoverage& at : run.more) {
    reached[coverage_key(at.size_m)] = views < at.curve.size() ? at.curve[views] : at.final;
  }
  return reached;
}

Reached at_end(const RunFigures& run) {
  Reached reached = after_views(run, std::numeric_limits<std::size_t>::max());
  reached["entropy_reduction"] = run.entropy_reduction_nat;
  reached["density_points_per_voxel"] = run.density_points_per_voxel;
  return reached;
}

Reached after_profile(const RunFigures& run) {
  Reached reached = {{"distance_m", run.before.profile_m}};
  for (std::size_t i = 0; i < kCoverageSizes_m.size(); ++i) {
    reached[coverage_key(kCoverageSizes_m[i])] = run.coverage_profile[i];
  }
  for (const SizedCoverage& at : run.more) reached[coverage_key(at.size_m)] = at.profile;
  return reached;
}

/// Coverage by the paper's sizes, as fractions of `whole`.
Reached covered(const std::array<double, 3>& coverage, double whole = 1.0) {
  Reached reached;
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    reached[coverage_key(kCoverageSizes_m[i])] = coverage[i] / whole;
  }
  return reached;
}

Reached printed_in(const PaperRow& row) {
  Reached printed;
  if (row.coverage_percent) printed = covered(*row.coverage_percent, 100.0);
  const auto add = [&](const char* key, const auto& value) {
    if (value) printed[key] = *value;
  };
  add("iterations", row.iterations);
  add("entropy_reduction", row.entropy_reduction);
  add("distance_m", row.distance_m);
  add("time_min", row.time_min);
  add("density_points_per_voxel", row.density_points_per_voxel);
  return printed;
}

/// The columns, with one for each size beside the paper's that some of the runs have, and without
/// those of some keys.
std::vector<TableColumn> columns_of(std::span<const RunFigures> runs,
                                    const std::set<std::string>& without) {
  constexpr auto estimate = ColumnKind::estimate;
  std::vector<TableColumn> columns = {{"Utility", "utility"},
                                      {"Row", "row"},
                                      {"Runs", "runs", ColumnKind::number},
                                      {"Iterations", "iterations", estimate},
                                      {"Entropy reduction", "entropy_reduction", estimate},
                                      {"Distance (m)", "distance_m", estimate, 1},
                                      {"Time (min)", "time_min", estimate, 1}};
  std::set<double> more_m;
  for (const RunFigures& run : runs) {
    for (const SizedCoverage& at : run.more) more_m.insert(at.size_m);
  }
  std::vector<double> sizes_m(kCoverageSizes_m.begin(), kCoverageSizes_m.end());
  sizes_m.insert(sizes_m.end(), more_m.begin(), more_m.end());
  for (const double size_m : sizes_m) {
    columns.push_back(
        {"Coverage " + size_name(size_m) + " m", coverage_key(size_m), estimate, 1, true});
  }
  columns.push_back({"Of ceiling", "share_of_ceiling", estimate, 1, true});
  columns.push_back({"Points/voxel", "density_points_per_voxel", estimate});
  std::erase_if(columns, [&](const TableColumn& column) { return without.contains(column.key); });
  return columns;
}

/// A row of what all of `reached` know, estimated over them.
void add_row(const std::string& label, const std::string& kind, const std::vector<Reached>& reached,
             TextTable& table) {
  Row& row = table.rows.emplace_back(Row{{label}, {kind}});
  for (const TableColumn& column : std::span(table.columns).subspan(row.size())) {
    std::vector<double> values;
    for (const Reached& one : reached) {
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

/// With the share of the ceiling, where it is above 0.
template <typename ReachedOf>
std::vector<Reached> reached_by(const Seeds& runs, double ceiling, const ReachedOf& reached_of) {
  std::vector<Reached> all;
  for (const RunFigures* const run : runs) {
    Reached& reached = all.emplace_back(reached_of(*run));
    if (ceiling > 0.0) reached["share_of_ceiling"] = reached["coverage_0.05"] / ceiling;
  }
  return all;
}

/// Runs of one row.
struct Group {
  std::string utility;
  std::string setting;
  std::string name;  // of the row: "Proposed, leaf_m=0.07"
  Seeds runs = {};
};

std::string named(const std::string& name, const std::string& setting) {
  return setting.empty() ? name : name + ", " + setting;
}

/// Those of the paper's utilities in its order, then the others in that of their first runs.
std::vector<Group> groups_of(const PaperTable& paper, std::span<const RunFigures> runs,
                             std::span<const std::string> settings) {
  GNBV_CHECK(settings.empty() || settings.size() == runs.size(), "{} settings of {} runs",
             settings.size(), runs.size());
  std::vector<Group> groups;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string& utility = runs[i].utility;
    const std::string setting = settings.empty() ? "" : settings[i];
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
      return g.utility == utility && g.setting == setting;
    });
    if (group == groups.end()) {
      group = groups.insert(groups.end(),
                            {utility, setting, named(name_in_table(paper, utility), setting)});
    }
    group->runs.push_back(&runs[i]);
  }
  const auto place_of = [&](const Group& group) {
    const PaperRow* const row = find_row(paper, group.utility);
    return row == nullptr ? std::ssize(paper.rows) : row - paper.rows.data();
  };
  std::stable_sort(groups.begin(), groups.end(),
                   [&](const Group& a, const Group& b) { return place_of(a) < place_of(b); });
  return groups;
}

/// What the runs had reached where they stand beside the paper's row: after as many views, or at
/// the end of those that took fewer; entropy and density at the end.
std::vector<Reached> reached_beside(const Seeds& runs, const PaperRow& paper) {
  const auto views = static_cast<std::size_t>(paper.iterations.value_or(0));
  return reached_by(runs, 0.0, [&](const RunFigures& run) {
    Reached reached = views > 0 ? after_views(run, views) : Reached{};
    reached.merge(at_end(run));
    return reached;
  });
}

/// Of each figure that the paper prints, the share of our runs that lie below it.
void add_place(const std::string& name, const Seeds& runs, const PaperRow& paper,
               TextTable& table) {
  const std::vector<Reached> ours = reached_beside(runs, paper);
  Row& row = table.rows.emplace_back(Row{{name}, {kPlace}});
  const Reached printed = printed_in(paper);
  for (const TableColumn& column : std::span(table.columns).subspan(row.size())) {
    TableCell& cell = row.emplace_back();
    const auto at = printed.find(column.key);
    if (at == printed.end() || column.key == "iterations") continue;
    std::vector<double> values;
    for (const Reached& one : ours) {
      if (const auto mine = one.find(column.key); mine != one.end()) {
        values.push_back(mine->second);
      }
    }
    if (values.size() < ours.size()) continue;
    const double share = share_below(values, at->second);
    cell = {fmt::format("{:.0f} % below", 100.0 * share), {share}};
  }
}

/// "coverage at 0.05 m Proposed > Isler: 31 %, ...", of what the paper prints for each of its
/// methods: how many sets of single runs, one of each method, have its order.
std::string order_note(const PaperTable& paper, const std::vector<Group>& groups) {
  constexpr std::array<std::pair<const char*, const char*>, 3> kOrdered = {
      {{"coverage_0.05", "coverage at 0.05 m"},
       {"distance_m", "distance"},
       {"entropy_reduction", "entropy reduction"}}};
  std::string note;
  for (const auto& [key, words] : kOrdered) {
    std::vector<std::pair<double, const Group*>> printed;
    for (const Group& group : groups) {
      const PaperRow* const row = find_row(paper, group.utility);
      if (row == nullptr || group.runs.size() < 2) continue;
      const Reached figures = printed_in(*row);
      if (const auto at = figures.find(key); at != figures.end()) {
        printed.emplace_back(at->second, &group);
      }
    }
    std::ranges::stable_sort(printed, std::greater{}, &std::pair<double, const Group*>::first);
    if (printed.size() < 2) continue;
    std::vector<std::vector<double>> values;
    std::string order;
    for (const auto& [figure, group] : printed) {
      order += (order.empty() ? "" : " > ") + group->name;
      std::vector<double>& of_group = values.emplace_back();
      for (const Reached& one : reached_beside(group->runs, *find_row(paper, group->utility))) {
        of_group.push_back(one.at(key));
      }
    }
    note += fmt::format("{}{} {}: {:.0f} %", note.empty() ? "" : ", ", words, order,
                        100.0 * share_descending(values));
  }
  return note;
}

/// Ours, and ours after as many views as the paper's row took where a run took more.
void add_ours(const std::string& name, const Seeds& runs, const PaperRow* paper, double ceiling,
              TextTable& table) {
  add_row(name, "ours", reached_by(runs, ceiling, at_end), table);
  const auto views = static_cast<std::size_t>(paper == nullptr ? 0 : paper->iterations.value_or(0));
  const bool is_longer = std::any_of(
      runs.begin(), runs.end(), [&](const RunFigures* run) { return run->curve.views() > views; });
  if (views == 0 || !is_longer) return;
  const auto cut = [&](const RunFigures& run) { return after_views(run, views); };
  add_row(name, kCut, reached_by(runs, ceiling, cut), table);
}

/// The profile does not depend on the utility: one run a seed. A row a setting, and one for all
/// settings that had the same profiles.
void add_profiles(const std::vector<Group>& groups, double ceiling, TextTable& table) {
  std::map<std::string, std::map<std::uint64_t, const RunFigures*>> by_setting;
  std::vector<std::string> settings;
  for (const Group& group : groups) {
    if (!by_setting.contains(group.setting)) settings.push_back(group.setting);
    for (const RunFigures* const run : group.runs)
      by_setting[group.setting].emplace(run->seed, run);
  }
  const auto first = static_cast<std::ptrdiff_t>(table.rows.size());
  std::vector<std::string> labels;
  for (const std::string& setting : settings) {
    Seeds runs;
    for (const auto& [seed, run] : by_setting[setting]) runs.push_back(run);
    add_row("Profile", "ours", reached_by(runs, ceiling, after_profile), table);
    const auto last = table.rows.end() - 1;
    if (std::find(table.rows.begin() + first, last, *last) == last) {
      labels.push_back(named("Profile", setting));
    } else {
      table.rows.pop_back();
    }
  }
  for (std::size_t i = 0; labels.size() > 1 && i < labels.size(); ++i) {
    table.rows[static_cast<std::size_t>(first) + i][0].text = labels[i];
  }
}

std::string three_percent(const std::array<double, 3>& fractions) {
  return fmt::format("{:.1f} / {:.1f} / {:.1f} %", 100.0 * fractions[0], 100.0 * fractions[1],
                     100.0 * fractions[2]);
}

/// "max_iterations", or "max_iterations (4), collision (1)".
std::string terminations(const Seeds& runs) {
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
std::string runs_note(const std::string& name, const Seeds& runs) {
  const auto values = [&](const auto& value_of) {
    std::vector<double> all;
    for (const RunFigures* const run : runs) all.push_back(value_of(*run));
    return all;
  };
  const auto mean = [&](const auto& value_of) { return mean_of(values(value_of)); };
  std::array<double, 3> raw{};
  for (std::size_t i = 0; i < raw.size(); ++i) {
    raw[i] = mean([&](const RunFigures& r) { return r.coverage_final_raw[i]; });
  }
  const double views = mean([](const RunFigures& r) { return r.iterations; });
  std::string note = fmt::format(
      "{}: ended by {} after {}; flown {:.1f} m; all surface, also inner: {}; {:.1f} s "
      "of wall time",
      name, terminations(runs),
      counted(static_cast<std::size_t>(std::lround(views)), "view", "views"),
      mean([](const RunFigures& r) { return r.flown_m; }), three_percent(raw),
      mean([](const RunFigures& r) { return r.wall_s; }));
  if (runs.size() > 1) {
    const auto finest = values([](const RunFigures& r) { return r.coverage_final[0]; });
    note += fmt::format(", each a mean of {}; at 0.05 m from {:.1f} to {:.1f} %", runs.size(),
                        100.0 * *std::min_element(finest.begin(), finest.end()),
                        100.0 * *std::max_element(finest.begin(), finest.end()));
  }
  return note;
}

void add_notes(TextTable& table, const PaperTable& paper, const std::vector<Group>& groups,
               bool prints_time, const std::optional<Ceiling>& ceiling) {
  std::vector<std::string>& notes = table.notes;
  notes.push_back(
      fmt::format("coverage: of voxels of that size, ours of those {}",
                  reference_words(groups.empty() ? 0 : groups[0].runs[0]->area_samples)));
  if (std::any_of(table.rows.begin(), table.rows.end(),
                  [](const Row& row) { return row[1].text == kCut; })) {
    notes.emplace_back(kCutNote);
  }
  notes.push_back(fmt::format(
      "ours: entropy reduction in nat; distance in straight lines between views, profile apart{}",
      prints_time ? "; time from the first view on, as the distance" : ""));
  if (std::any_of(groups.begin(), groups.end(),
                  [](const Group& group) { return group.runs.size() > 1; })) {
    notes.emplace_back(
        "±: half width of the 95 % interval of the mean over the seeds (Student's t)");
  }
  if (std::any_of(table.rows.begin(), table.rows.end(),
                  [](const Row& row) { return row[1].text == kPlace; })) {
    notes.emplace_back(
        "ours below: share of our runs that lie below the paper's figure, of which it prints one "
        "run; after as many views, entropy reduction and points/voxel at the end");
  }
  const bool is_one_setting = std::all_of(groups.begin(), groups.end(), [&](const Group& group) {
    return group.setting == groups.front().setting;
  });
  if (const std::string order = is_one_setting ? order_note(paper, groups) : ""; !order.empty()) {
    notes.push_back("the paper's order in single runs of ours, one of each method: " + order);
  }
  if (ceiling && !ceiling->is_given) {
    notes.push_back(fmt::format(
        "ceiling: what legal viewpoints and the profile see, and what of it the cloud's leaf "
        "filter can keep, of exact sensors: noise can lift a mission above it; of ceiling: "
        "coverage at 0.05 m over the latter's; all surface, also inner: {}, behind the leaf filter "
        "{}",
        three_percent(ceiling->raw), three_percent(ceiling->leaf_raw)));
  }
  if (std::any_of(paper.rows.begin(), paper.rows.end(), is_doubtful)) {
    notes.emplace_back(
        "† as printed: more coverage at 0.05 m than at 0.10 m is hardly possible by the paper's "
        "own definition; the two columns may have changed places");
  }
  for (const Group& group : groups) notes.push_back(runs_note(group.name, group.runs));
}

TableCell effort_cell(const Seeds& runs, Effort effort, double coverage) {
  std::vector<double> efforts;
  double there = 0.0;
  for (const RunFigures* const run : runs) {
    if (run->curve.coverage.empty()) return {};  // nobody knows
    const auto spent = effort_to_reach(run->curve, run->before, coverage);
    const auto views = static_cast<std::size_t>(spent ? spent->views : 0.0);
    efforts.push_back(!spent                     ? std::numeric_limits<double>::infinity()
                      : effort == Effort::metres ? spent->metres
                      : views == 0               ? 0.0
                                                 : seconds_of_views(run->curve, views));
    there += spent ? 1.0 : 0.0;
  }
  const std::optional<double> median = median_effort(efforts);
  return {fmt::format("{} ({:.0f} of {})", median ? grouped(*median, 1) : "-", there, runs.size()),
          {median, there}};
}

}  // namespace

TextTable comparison_table(const PaperTable& paper, std::span<const RunFigures> runs,
                           const std::optional<Ceiling>& ceiling,
                           std::span<const std::string> settings) {
  const bool prints_time =
      std::any_of(paper.rows.begin(), paper.rows.end(),
                  [](const PaperRow& row) { return row.time_min.has_value(); });
  TextTable table{.title = std::string(paper.source),
                  .columns = columns_of(runs, {prints_time ? "" : "time_min"})};
  const double most = ceiling ? ceiling->leaf_counted[0] : 0.0;
  const std::vector<Group> groups = groups_of(paper, runs, settings);
  for (const PaperRow& row : paper.rows) {
    for (const Group& group : groups) {
      if (group.utility == row.utility) add_ours(group.name, group.runs, &row, most, table);
    }
    add_papers_row(std::string(row.label), row, table);
    for (const Group& group : groups) {
      if (group.utility != row.utility || group.runs.size() < 2) continue;
      add_place(group.name, group.runs, row, table);
    }
  }
  for (const Group& group : groups) {
    const bool is_papers = find_row(paper, group.utility) != nullptr;
    if (!is_papers) add_ours(group.name, group.runs, nullptr, most, table);
  }
  add_profiles(groups, most, table);
  if (paper.profile) add_papers_row("Profile", *paper.profile, table);
  if (ceiling && !ceiling->is_given) {
    add_row("Ceiling", "physical", {covered(ceiling->counted)}, table);
    add_row("Ceiling", "leaf filter", {covered(ceiling->leaf_counted)}, table);
  }
  add_notes(table, paper, groups, prints_time, ceiling);
  return table;
}

TextTable effort_table(const PaperTable& paper, Effort effort, std::span<const RunFigures> runs,
                       const std::optional<Ceiling>& ceiling, std::span<const std::string> settings,
                       const RunsByShare& by_share) {
  const std::string unit = effort == Effort::metres ? "metres" : "seconds";
  TextTable table{
      .title = fmt::format("{} to reach the ceiling", unit == "metres" ? "Metres" : "Seconds"),
      .columns = {{"Utility", "utility"}, {"Row", "row"}}};
  for (const double share : kReachShares) {
    table.columns.push_back({fmt::format("{:.0f}%", 100.0 * share),
                             fmt::format("{}_to_{:.0f}", unit, 100.0 * share),
                             ColumnKind::counted});
  }
  if (runs.empty() || !ceiling || ceiling->leaf_counted[0] <= 0.0) return table;
  for (const Group& group : groups_of(paper, runs, settings)) {
    Row& row = table.rows.emplace_back(Row{{group.name}, {"ours"}});
    for (std::size_t i = 0; i < kReachShares.size(); ++i) {
      Seeds of_share;
      for (const RunFigures& run : by_share[i]) {
        if (run.utility == group.utility) of_share.push_back(&run);
      }
      row.push_back(effort_cell(of_share.empty() ? group.runs : of_share, effort,
                                kReachShares[i] * ceiling->leaf_counted[0]));
    }
  }
  table.notes.push_back(fmt::format(
      "{} to 80 to 99% of the ceiling: median over the runs, from the first view on, until the "
      "cloud first covered so much at 0.05 m of what it can hold, and how many runs got there; one "
      "that did not counts as more than all others; an oracle of few metres or seconds flies for "
      "each share alone",
      unit));
  return table;
}

std::string one_row_summary(const RunFigures& run, bool has_papers_setting, std::size_t width) {
  const PaperTable* const paper = find_paper_table(run.scenario);
  const PaperRow* row = paper == nullptr ? nullptr : find_row(*paper, run.utility);
  if (row != nullptr && !is_papers_structure(*paper, run.structure)) row = nullptr;
  // no ceiling here: finding it may take longer than the mission
  TextTable table{.columns = columns_of({&run, 1}, {"runs", "time_min", "share_of_ceiling"})};
  add_ours(run.utility, {&run}, has_papers_setting ? row : nullptr, 0.0, table);
  if (table.rows.size() > 1) table.notes.emplace_back(kCutNote);
  if (row != nullptr && has_papers_setting) {
    add_papers_row(run.utility, *row, table);
    if (is_doubtful(*row)) table.notes.emplace_back("† as printed; hardly possible");
  } else if (row != nullptr) {
    table.notes.push_back(fmt::format("without the paper's row: {}", kOtherSetting));
  }
  if (run.area_samples > 0) {
    table.notes.push_back("coverage: ours of voxels " + reference_words(run.area_samples));
  }
  table.notes.push_back(runs_note(run.utility, {&run}));
  return terminal_text(table, width);
}

}  // namespace gnbv
