#include "tools/page/report.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/compare/paper_table.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/figures/groups.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/page/packs.hpp"
#include "tools/page/page_text.hpp"
#include "tools/run/run_files.hpp"
#include "tools/scene/looks.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

// What a laptop draws fluently.
constexpr std::size_t kMaxPoints = 500'000;  // of one run
constexpr std::size_t kAllPoints = 800'000;
constexpr std::size_t kLeastRunBytes = 200'000;  // where names and views alone fill the page

/// Of a page of `kMaxReportBytes`, for each run: what text, structures and plots leave, in equal
/// shares.
RunBudget budget_of(const std::vector<RunRecord>& records, std::size_t packed_bytes) {
  std::size_t text = page_template().size() + page_style().size() + page_script().size();
  for (const RunRecord& record : records) {
    std::error_code ignored;
    const auto yaml = fs::file_size(record.folder / kScenarioFile, ignored);
    text += 50'000 + 600 * record.views.size() + (ignored ? 0 : yaml);  // JSON, with tables
  }
  // base64 makes four bytes of three
  const std::size_t blocks = (kMaxReportBytes - std::min(kMaxReportBytes, text)) / 4 * 3;
  const std::size_t bytes = (blocks - std::min(blocks, packed_bytes)) / records.size();
  return {.bytes = std::max(kLeastRunBytes, bytes),
          .points = std::min(kMaxPoints, kAllPoints / records.size())};
}

/// Runs of one scenario and structure that were scored.
struct TableRuns {
  std::vector<const RunRecord*> records;
  std::optional<Ceiling> ceiling;  // of all; none where theirs differ: a column has one meaning
};

/// Beside the paper's figures only where structure and setting are the paper's.
TextTable table_of(const TableRuns& of) {
  std::vector<std::string> notes;
  const std::vector<RunGroup> groups = group_runs(of.records, notes);
  const std::vector<std::string> labels = setting_labels(groups);
  std::vector<MissionRow> rows;
  bool has_papers = false;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const RunRecord* const record : groups[i].runs) {
      MissionRow& row = rows.emplace_back(mission_row(*record->figures));
      row.setting = labels[i];
      if (of.ceiling) add_ceiling(*record->figures, *of.ceiling, row);
      has_papers = has_papers || has_papers_setting(record->scenario);
    }
  }
  const std::string& scenario = rows.at(0).scenario;
  const std::string& structure = rows.at(0).structure;
  const PaperTable* const paper = find_paper_table(scenario);
  const std::string title = structure == scenario
                                ? human_name(scenario)
                                : fmt::format("{}, structure {}", human_name(scenario), structure);
  const PaperTable none{
      .scenario = scenario, .source = title, .rows = {}, .profile = {}, .mesh_sha256 = ""};
  const bool is_of_structure = paper != nullptr && is_papers_structure(*paper, structure);
  const PaperTable& beside = is_of_structure && has_papers ? *paper : none;
  for (MissionRow& row : rows) {
    if (name_in_table(beside, row.method) == row.method) row.method = human_name(row.method);
  }
  TextTable table = comparison_table(beside, rows);
  if (&beside == paper) {
    table.notes.emplace_back(
        "entropy reduction: the paper does not say whether voxels at a clamping bound count, ours "
        "do not; its amounts are not to be compared with ours");
  } else if (is_of_structure) {
    table.notes.push_back(fmt::format("without the paper's rows: {}", kOtherSetting));
  }
  table.notes.insert(table.notes.end(), notes.begin(), notes.end());
  return table;
}

std::vector<page::Table> tables_of(const std::vector<RunRecord>& records,
                                   const std::vector<std::optional<Ceiling>>& ceilings) {
  std::map<std::tuple<std::string, std::string, std::size_t>, std::size_t> numbers;
  std::vector<TableRuns> all;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const std::optional<RunFigures>& figures = records[i].figures;
    if (!figures || figures->curve.coverage.empty()) continue;
    const auto [entry, is_new] = numbers.try_emplace(
        {figures->scenario, figures->structure, figures->area_samples}, all.size());
    if (is_new) all.push_back({.records = {}, .ceiling = ceilings[i]});
    TableRuns& table = all[entry->second];
    table.records.push_back(&records[i]);
    const auto share = [](const auto& of) { return of ? of->leaf_counted[0] : 0.0; };
    if (share(table.ceiling) != share(ceilings[i])) table.ceiling.reset();
  }
  std::vector<page::Table> tables;
  for (const TableRuns& table : all) tables.push_back(page_table(table_of(table)));
  return tables;
}

std::string title_of(const std::vector<RunRecord>& records) {
  if (records.size() == 1) return run_title(records[0]);
  std::vector<std::string> scenarios;
  for (const RunRecord& r : records) {
    const std::string name = human_name(r.scenario.name);
    if (std::find(scenarios.begin(), scenarios.end(), name) == scenarios.end()) {
      scenarios.push_back(name);
    }
  }
  return fmt::format("{}: {} runs", fmt::join(scenarios, ", "), records.size());
}

/// The coverage that could be reached, where an earlier command found it: of all sizes where this
/// machine still has it, else what the run was scored with.
std::optional<Ceiling> ceiling_of(const RunRecord& record, const KnownStructure* structure,
                                  int threads) {
  if (structure != nullptr) {
    const auto known = known_ceiling(record.scenario, structure->world, structure->scene,
                                     start_pose(record.scenario, structure->scene), threads);
    if (known && known->leaf_counted[0] > 0.0) return known;
  }
  if (!record.figures || !record.figures->ceiling) return std::nullopt;
  Ceiling scored;
  scored.leaf_counted[0] = *record.figures->ceiling;
  scored.is_given = true;
  return scored;
}

/// Without the backticks that mark it in a sentence: the page gives it a place of its own.
std::string bare_command_to_fly_again(const fs::path& folder, const std::string& options) {
  const std::string marked = command_to_fly_again(folder, options);
  return marked.substr(1, marked.size() - 2);
}

std::string data_element(const std::string& id, const std::string& type, const std::string& text) {
  return fmt::format("<script type=\"{}\" id=\"{}\">{}</script>\n", type, id, text);
}

/// Nothing of the page may load or send anything, but a live one may ask its server, and only our
/// own script may run, so that a name which escaped its escaping would still be nothing but text.
std::string policy(bool is_live) {
  return fmt::format(
      "default-src 'none'; script-src {}; style-src {}; img-src data: blob:; base-uri 'none'; "
      "form-action 'none'{}",
      policy_hash(page_script()), policy_hash(page_style()), is_live ? "; connect-src 'self'" : "");
}

}  // namespace

page::Table page_table(const TextTable& table) {
  page::Table out{.title = table.title, .notes = table.notes};
  out.rows.resize(table.rows.size());
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const bool says_nothing = std::all_of(table.rows.begin(), table.rows.end(),
                                          [&](const auto& row) { return row[i].text == "-"; });
    if (says_nothing) continue;
    const TableColumn& column = table.columns[i];
    out.columns.push_back({column.head, column.kind != ColumnKind::text});
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      out.rows[row].push_back(table.rows[row][i].text);
    }
  }
  return out;
}

Report make_report(std::vector<RunRecord> records, const ReportOptions& options,
                   const ShareDone& progress) {
  GNBV_CHECK(!records.empty() && records.size() <= kMaxReportRuns, "{} runs", records.size());
  GNBV_CHECK(page_script().find("</script") == std::string_view::npos, "the script ends itself");
  Report report;
  page::Arrays arrays;
  page::PageData page{.title = options.title.empty() ? title_of(records) : options.title,
                      .is_live = options.is_live,
                      .version = GNBV_VERSION,
                      .scene = looks_json()};
  const std::vector<std::string> labels = run_labels(records);
  const std::vector<SeriesLook> looks = line_looks(records);
  Structures structures = pack_structures(records, options.threads, arrays);
  std::vector<std::optional<Ceiling>> ceilings;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const KnownStructure* const known = structures.of_run[i].known.get();
    ceilings.push_back(ceiling_of(records[i], known, options.threads));
    std::optional<RunFigures>& figures = records[i].figures;
    if (figures && ceilings[i]) figures->ceiling = ceilings[i]->leaf_counted[0];
  }
  page.tables = tables_of(records, ceilings);
  page.plots = plots_of(records, labels, arrays);
  const RunBudget budget = budget_of(records, arrays.bytes().size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    const RunRecord& record = records[i];
    const Structures::OfRun& structure = structures.of_run[i];
    page::RunData& run = page.runs.emplace_back(run_data(record, arrays));
    pack_run(
        record, structure.known.get(), budget, options.threads,
        [&](double share) {
          progress((static_cast<double>(i) + share) / static_cast<double>(records.size()));
        },
        arrays, run);
    if (!structure.why.empty()) run.missing.push_back(structure.why);
    run.label = labels[i];
    run.colour = looks[i].colour;
    run.mesh = structure.number;
    run.command = bare_command_to_fly_again(record.folder, run.frames.empty() ? "" : "--frames");
    const auto known = static_cast<std::ptrdiff_t>(record.missing.size());
    report.missing.insert(report.missing.end(), run.missing.begin() + known, run.missing.end());
  }
  page.meshes = std::move(structures.meshes);
  page.movers = std::move(structures.movers);
  // names may hold anything, also what is no UTF-8
  const std::string json = nlohmann::ordered_json(page).dump(
      -1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  report.policy = policy(options.is_live);
  report.html = fmt::format(
      fmt::runtime(page_template()), fmt::arg("POLICY", report.policy),
      fmt::arg("TITLE", html_escaped(page.title)), fmt::arg("STYLE", page_style()),
      fmt::arg("DATA", data_element("arrays", "application/octet-stream", base64(arrays.bytes())) +
                           data_element("data", "application/json", script_json(json))),
      fmt::arg("SCRIPT", page_script()));
  return report;
}

}  // namespace gnbv
