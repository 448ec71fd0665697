#include "bench/suite/standings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSignificant = 0.05;

std::string unit_of(const SuiteTrack& track) { return track.effort == Effort::metres ? "m" : "s"; }

TableCell percent(double share) { return {fmt::format("{:.1f}", 100.0 * share), {share}}; }
TableCell amount(const std::optional<double>& value, int decimals) {
  return value ? TableCell{grouped(*value, decimals), {value}} : TableCell{};
}

bool has_set(const Suite& suite, const SuiteTrack& track, const char* set) {
  return std::ranges::any_of(suite.tasks_of(track.name), [&](const SuiteTask& task) {
    return suite.structure_of(task).set == set;
  });
}

std::vector<TableColumn> columns_of(const Suite& suite, const SuiteTrack& track) {
  const auto number = [](const std::string& head, const std::string& key) {
    return TableColumn{.head = head, .key = key, .kind = ColumnKind::number};
  };
  const std::string unit = unit_of(track);
  std::vector<TableColumn> columns = {{.head = "Planner", .key = "planner"},
                                      number("Score (%)", "score"),
                                      number("from", "score_low"),
                                      number("to", "score_high")};
  if (has_set(suite, track, "held_out")) {
    columns.push_back(number("public (%)", "public_score"));
    columns.push_back(number("held out (%)", "held_out_score"));
  }
  columns.push_back(number("Coverage (%)", "coverage"));
  columns.push_back(number(fmt::format("to 90 % ({})", unit), "to_90_" + unit));
  columns.push_back(number(fmt::format("to 95 % ({})", unit), "to_95_" + unit));
  columns.push_back(number("Planning (s/view)", "plan_s"));
  columns.push_back({.head = "Against the first", .key = "against_first"});
  return columns;
}

TextTable table_of(const Suite& suite, const SuiteTrack& track,
                   const std::vector<Standing>& sorted) {
  TextTable table{.title = fmt::format("Track {}, suite version {}", track.name, suite.version),
                  .columns = columns_of(suite, track)};
  for (const Standing& standing : sorted) {
    const Submission& entry = *standing.entry;
    const TrackFigures& f = entry.figures;
    std::vector<TableCell> row = {{printable(entry.name)},
                                  percent(f.score.mean),
                                  percent(f.score.low),
                                  percent(f.score.high)};
    if (has_set(suite, track, "held_out")) {
      row.push_back(percent(f.public_score));
      row.push_back(percent(f.held_out_score));
    }
    row.push_back(percent(f.coverage.mean));
    row.push_back(amount(f.to_90, 1));
    row.push_back(amount(f.to_95, 1));
    row.push_back(amount(f.plan_s, 3));
    row.push_back({verdict_of(standing, &standing == &sorted.front())});
    table.rows.push_back(std::move(row));
  }
  table.notes = {
      fmt::format("score: accurate coverage at 0.05 m over the budget, as a share of the best "
                  "known planner's; mean of {} structures, 95 % bootstrap interval over them",
                  suite.tasks_of(track.name).size()),
      "to 90 %, to 95 %: of the ceiling, medians; -: half of the missions do not get there within "
      "the budget",
      "numbers as submitted; `gnbv bench verify` flies them again; planning times are stated"};
  return table;
}

}  // namespace

std::string verdict_of(const Standing& standing, bool is_first) {
  if (is_first) return "-";
  if (standing.test.n == 0) return "equal";
  if (least_wilcoxon_p(standing.test.n) >= kSignificant) return "too few structures";
  const char* const verdict = standing.p >= kSignificant ? "not told apart"
                              : standing.test.is_above() ? "behind"
                                                         : "ahead by ranks";
  const std::string p = standing.p < 0.001 ? "p < 0.001" : fmt::format("p = {:.3f}", standing.p);
  return fmt::format("{} ({})", verdict, p);
}

std::vector<Standing> standings(const Suite& suite, const std::vector<Submission>& entries,
                                const std::string& track) {
  std::vector<Standing> sorted;
  for (const Submission& entry : entries) {
    if (entry.track != track) continue;
    need_of_suite(entry, suite);
    for (const Standing& other : sorted) {
      if (other.entry->name != entry.name) continue;
      throw BadInput("{}, {}: two entries of the name '{}'", other.entry->file.string(),
                     entry.file.string(), entry.name);
    }
    sorted.push_back({&entry});
  }
  std::ranges::sort(sorted, [](const Standing& a, const Standing& b) {
    const double of_a = a.entry->figures.score.mean, of_b = b.entry->figures.score.mean;
    return of_a != of_b ? of_a > of_b : a.entry->name < b.entry->name;
  });
  std::vector<double> p;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    std::vector<double> differences;
    for (std::size_t k = 0; k < sorted[i].entry->missions.size(); ++k) {
      differences.push_back(sorted[0].entry->missions[k].figures.share -
                            sorted[i].entry->missions[k].figures.share);
    }
    sorted[i].test = wilcoxon_signed_rank(differences);
    p.push_back(sorted[i].test.p);
  }
  p = holm_adjusted(p);
  for (std::size_t i = 1; i < sorted.size(); ++i) sorted[i].p = p[i - 1];
  return sorted;
}

std::vector<TextTable> standings_tables(const Suite& suite,
                                        const std::vector<Submission>& entries) {
  std::vector<TextTable> tables;
  for (const Submission& entry : entries) need_of_suite(entry, suite);
  for (const SuiteTrack& track : suite.tracks) {
    const std::vector<Standing> sorted = standings(suite, entries, track.name);
    if (!sorted.empty()) tables.push_back(table_of(suite, track, sorted));
  }
  return tables;
}

std::string standings_json(
    const Suite& suite, const std::vector<Submission>& entries,
    const std::function<std::string(const Submission&, const std::string& task)>& link) {
  Json tracks = Json::array();
  for (const SuiteTrack& track : suite.tracks) {
    const std::vector<Standing> sorted = standings(suite, entries, track.name);
    if (sorted.empty()) continue;
    Json rows = Json::array();
    for (const Standing& standing : sorted) {
      const Submission& entry = *standing.entry;
      const TrackFigures& f = entry.figures;
      Json missions = Json::array();
      for (const SubmittedMission& mission : entry.missions) {
        missions.push_back({{"task", mission.figures.task},
                            {"share", mission.figures.share},
                            {"coverage", mission.figures.coverage},
                            {"views", mission.figures.views},
                            {"termination", mission.figures.termination},
                            {"link", link(entry, mission.figures.task)}});
      }
      rows.push_back({{"name", entry.name},
                      {"kind", kEntryKindNames.at(static_cast<std::size_t>(entry.kind))},
                      {"description", entry.description},
                      {"licence", entry.licence},
                      {"machine", entry.machine},
                      {"settings", entry.settings},
                      {"score", f.score.mean},
                      {"low", f.score.low},
                      {"high", f.score.high},
                      {"public", f.public_score},
                      {"held_out", f.held_out_score},
                      {"coverage", f.coverage.mean},
                      {"to_90", f.to_90 ? Json(*f.to_90) : Json(nullptr)},
                      {"to_95", f.to_95 ? Json(*f.to_95) : Json(nullptr)},
                      {"plan_s", f.plan_s},
                      {"verdict", verdict_of(standing, &standing == &sorted.front())},
                      {"missions", missions}});
    }
    tracks.push_back({{"name", track.name},
                      {"what", track.what},
                      {"unit", unit_of(track)},
                      {"has_held_out", has_set(suite, track, "held_out")},
                      {"entries", rows}});
  }
  return Json{{"version", suite.version}, {"tracks", tracks}}.dump(1, ' ', false,
                                                                   Json::error_handler_t::replace);
}

}  // namespace gnbv
