#include "tools/paper/page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/compare/paper_table.hpp"
#include "bench/sources/source_ids.hpp"
#include "sim/core/embed.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/figures/figure.hpp"
#include "tools/mission/python_script.hpp"
#include "tools/paper/comparisons.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

GNBV_EMBED(paper_schema_json, GNBV_PAPER_SCHEMA);
GNBV_EMBED(page_draw_py, GNBV_PYTHON_FOLDER "/plots/_draw.py");
GNBV_EMBED(page_py, GNBV_PYTHON_FOLDER "/paper/_page.py");
GNBV_EMBED(paper_template, GNBV_PYTHON_FOLDER "/paper/page.html");
GNBV_EMBED(paper_tables_template, GNBV_PYTHON_FOLDER "/paper/tables.tex");

constexpr const char* kTablesFolder = "tables";

Json ask_page(const Json& request) {
  return ask_python({.what = "paper",
                     .modules = {{"gnbv", ""},  // whether or not it is installed
                                 {"gnbv.plots", ""},
                                 {"gnbv.plots._draw", page_draw_py()},
                                 {"page", page_py()}},
                     .entry = "page",
                     .apt = "python3-matplotlib python3-jinja2",
                     .pip = "matplotlib jinja2"},
                    request);
}

/// Bytes of a user's name that are no UTF-8 become the replacement character.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json missions_json(const PaperMaterial& material) {
  Json missions = Json::array();
  for (const PaperMission& mission : material.missions) {
    const RunFigures& figures = *mission.record.figures;
    std::string command = fmt::format("gnbv run {} --utility {} --seed {}", mission.scenario,
                                      mission.utility, mission.seed);
    for (const std::string& set : material.request.overrides)
      command += " --set " + shell_word(set);
    missions.push_back({{"scenario", mission.scenario},
                        {"utility", mission.utility},
                        {"seed", mission.seed},
                        {"views", mission.record.views.size()},
                        {"termination", figures.termination},
                        {"version", figures.version},
                        {"result_sha256", figures.result_sha256},
                        {"command", command}});
  }
  return missions;
}

/// How often each verdict was given.
Json counts_json(const Json& tables, const Json& claims) {
  Json numbers = Json::object(), orders = Json::object(), sentences = Json::object();
  const auto count = [](Json& counts, const Json& judged) {
    if (judged.is_null() || judged["verdict"].is_null()) return;
    const auto verdict = judged["verdict"].get<std::string>();
    counts[verdict] = counts.value(verdict, 0) + 1;
  };
  for (const Json& table : tables) {
    for (const Json& row : table["rows"]) {
      for (const Json& figure : row["figures"]) count(numbers, figure);
    }
    for (const Json& pair : table["pairs"]) {
      for (const Json& figure : pair["figures"]) count(orders, figure);
    }
  }
  for (const Json& claim : claims) count(sentences, claim);
  return {{"numbers", numbers}, {"orders", orders}, {"sentences", sentences}};
}

/// As `gnbv table` prints it, at the end of every mission.
void write_whole_table(const PaperMaterial& material, const PaperTable& paper,
                       const std::string& command, const fs::path& folder) {
  std::vector<MissionRow> rows;
  for (const PaperRow& row : paper.rows) {
    for (const PaperMission* mission : missions_of(material, paper.scenario, row.utility)) {
      rows.push_back(mission_row(*mission->record.figures));
    }
  }
  TextTable table = comparison_table(paper, rows);
  table.notes.push_back(fmt::format("{}, version {}", command, GNBV_VERSION));
  const std::string file = (folder / kTablesFolder / paper.scenario).string();
  write_file_atomically(file + ".md", markdown_text(table));
  write_file_atomically(file + ".csv", csv_text(table));
}

}  // namespace

void need_page_python() { ask_page({}); }

void write_page(const PaperMaterial& material, const std::string& command, const fs::path& folder,
                int threads, const FigureProgress& progress) {
  make_folder(folder / kTablesFolder);
  Json tables = Json::array();
  for (const std::string& scenario : material.request.scenarios) {
    const PaperTable& paper = *find_paper_table(scenario);
    write_whole_table(material, paper, command, folder);
    tables.push_back(compared_table(material, paper));
  }
  const Json claims = checked_claims(material);
  Json document = {{"schema", 1},
                   {"version", GNBV_VERSION},
                   {"sources_sha256", flying_source_id()},
                   {"command", command},
                   {"seeds", material.request.seeds},
                   {"columns", compared_columns()},
                   {"tables", tables},
                   {"claims", claims},
                   {"counts", counts_json(tables, claims)},
                   {"missions", missions_json(material)},
                   {"notes", material.notes}};
  document.update(draw_figures(material, folder, threads, progress));
  write_file_atomically(folder / "paper.json", text_of(document) + "\n");
  const Json page = ask_page({{"document", document},
                              {"folder", fs::absolute(folder).string()},
                              {"html", paper_template()},
                              {"tex", paper_tables_template()}});
  write_file_atomically(folder / kTablesFolder / "paper.tex", page["tex"].get<std::string>());
  write_file_atomically(folder / "index.html", page["html"].get<std::string>());
}

std::string paper_schema() {
  Json schema = Json::parse(paper_schema_json());
  schema["definitions"].update(Json::parse(figures_schema())["definitions"]);
  return schema.dump(2) + "\n";
}

}  // namespace gnbv
