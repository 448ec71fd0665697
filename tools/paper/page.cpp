#include "tools/paper/page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/compare/paper_table.hpp"
#include "sim/core/file.hpp"
#include "sim/core/image.hpp"
#include "sim/core/text.hpp"
#include "tools/page/jpeg.hpp"
#include "tools/page/page_text.hpp"
#include "tools/paper/page_parts.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTablesFolder = "tables";
constexpr int kJpegQuality = 86;

std::string data_uri(const fs::path& picture) {
  if (extension_of(picture) == ".png") {
    return "data:image/jpeg;base64," + base64(jpeg_bytes(read_png(picture), kJpegQuality));
  }
  const std::string text = read_file(picture);
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  return "data:image/svg+xml;base64," + base64(std::span(bytes, text.size()));
}

std::string estimate_text(const ComparedFigure& both, int decimals) {
  if (!both.ours) return "";
  std::string text = grouped(both.ours->mean, decimals);
  if (both.ours->half_width) text += " ±" + grouped(*both.ours->half_width, decimals);
  return text;
}

/// The columns that the paper prints of any row.
std::vector<std::size_t> shown_columns(const ShownTable& table) {
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < compared_figures().size(); ++i) {
    const bool is_printed = std::any_of(table.rows.begin(), table.rows.end(),
                                        [&](const auto& row) { return row.figures[i].printed; });
    if (is_printed) columns.push_back(i);
  }
  return columns;
}

std::string side_html(const ShownTable& table, bool is_ours) {
  const std::vector<std::size_t> columns = shown_columns(table);
  std::string html = "<div class=scroll><table>\n<tr><th>Utility</th><th>Views</th>";
  for (const std::size_t i : columns) {
    html += fmt::format("<th>{}</th>", html_escaped(compared_figures()[i].head));
  }
  html += "</tr>\n";
  for (const ComparedRow& row : table.rows) {
    const bool has_views = !row.utility.empty() && (!is_ours || row.missions > 0);
    std::string views = "-";
    if (has_views) {
      views = is_ours             ? grouped(row.views, 0)
              : row.printed_views ? grouped(*row.printed_views, 0)
                                  : "-";
    }
    html += fmt::format("<tr><td>{}</td><td>{}</td>", html_escaped(row.label), views);
    for (const std::size_t i : columns) {
      const int decimals = compared_figures()[i].decimals;
      const ComparedFigure& both = row.figures[i];
      const std::string text = is_ours        ? estimate_text(both, decimals)
                               : both.printed ? grouped(*both.printed, decimals)
                                              : "";
      html += fmt::format("<td>{}</td>", text.empty() ? "-" : text);
    }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

/// What was flown beyond the views that are compared.
std::string beyond_html(const ShownTable& table) {
  std::string html;
  for (const ComparedRow& row : table.rows) {
    if (row.utility.empty()) continue;
    if (row.missions == 0) {
      html += fmt::format("<li class=missing>{}: no mission came to its end</li>\n",
                          html_escaped(row.label));
    } else if (row.flown_views > row.views) {
      html +=
          fmt::format("<li>{}: compared after {} views; ours flew {}</li>\n",
                      html_escaped(row.label), grouped(row.views, 0), grouped(row.flown_views, 0));
    } else if (row.printed_views && row.views < *row.printed_views) {
      html += fmt::format(
          "<li>{}: compared after {} views, where ours ended; the paper&#39;s took "
          "{}</li>\n",
          html_escaped(row.label), grouped(row.views, 0), grouped(*row.printed_views, 0));
    }
  }
  return html.empty() ? "" : "<ul class=notes>\n" + html + "</ul>\n";
}

std::string figure_html(const DrawnFigure& figure, const PaperPage& page, const fs::path& folder) {
  std::string pictures;
  for (const FigureFile& file : figure.files) {
    pictures += fmt::format("<figure><a href='{0}'><img alt='Figure {1} {2}' src='{3}'></a>",
                            html_escaped(file.path), figure.kind->number, html_escaped(file.label),
                            data_uri(folder / file.path));
    if (!file.label.empty()) {
      pictures += fmt::format("<figcaption>{}</figcaption>", html_escaped(file.label));
    }
    pictures += "</figure>\n";
  }
  const std::size_t across = std::clamp<std::size_t>(figure.files.size(), 1, 3);
  std::string html = fmt::format(
      "<section id=fig{0}>\n<h2>Figure {0}</h2>\n<div class='sides figure{3}'>\n<div "
      "class=side>\n<div class='pictures n{1}'>\n{2}</div>\n",
      figure.kind->number, across, pictures, across > 2 ? " wide" : "");
  for (const std::string& missing : figure.missing) {
    html += fmt::format("<p class=missing>Not shown: {}</p>\n", html_escaped(missing));
  }
  html += fmt::format(
      "<p class=pale>Ours, {}: {}</p>\n</div>\n<div class='side paper'>\n<h3>The paper</h3>\n"
      "<p>{}</p>\n",
      html_escaped(human_name(figure.scenario)), html_escaped(figure.kind->ours),
      html_escaped(figure.kind->paper));
  for (const CheckedClaim& claim : page.claims) {
    if (claim.figure != figure.kind->number) continue;
    html += fmt::format("<p>{} {}<br><span class=pale>{} Rule: {}.</span></p>\n",
                        html_escaped(claim.sentence), chip(claim.verdict),
                        html_escaped(claim.finding), html_escaped(claim.rule));
  }
  return html + "</div>\n</div>\n</section>\n";
}

std::string undrawn_html() {
  std::string html = "<section id=undrawn>\n<h2>Figures that no mission can show</h2>\n<table>\n";
  for (const UndrawnFigure& figure : undrawn_figures()) {
    html += fmt::format("<tr><td>{}</td><td class=text>{}</td></tr>\n", figure.number,
                        html_escaped(figure.why));
  }
  return html + "</table>\n</section>\n";
}

std::string head_html(const PaperPage& page) {
  std::string html = fmt::format(
      "<header>\n<h1>Guided next best view: the paper’s evaluation beside ours</h1>\n"
      "<p>Almadhoun et al. 2019, <i>Guided Next Best View for 3D Reconstruction of Large Complex "
      "Structures</i>, flown again in simulation with {} seed{} a row. A seed moves the start and "
      "keys all noise; ± is the half width of the 95 % interval of the mean.</p>\n"
      "<p class=pale>gnbv {}, <code>{}</code></p>\n<nav><a href='#summary'>summary</a>",
      page.seeds, page.seeds == 1 ? "" : "s", html_escaped(page.version),
      html_escaped(page.command));
  for (const ShownTable& table : page.tables) {
    html += fmt::format("<a href='#{}'>{}</a>", html_escaped(table.paper->scenario),
                        html_escaped(human_name(table.paper->scenario)));
  }
  for (const DrawnFigure& figure : page.figures) {
    html += fmt::format("<a href='#fig{0}'>Fig. {0}</a>", figure.kind->number);
  }
  html += "</nav>\n";
  if (!page.notes.empty()) {
    html += "<div class=warning><b>Not everything is as it was asked for</b>\n<ul class=notes>\n";
    for (const std::string& note : page.notes) {
      html += fmt::format("<li>{}</li>\n", html_escaped(note));
    }
    html += "</ul></div>\n";
  }
  return html + "</header>\n";
}

}  // namespace

std::string table_html(const ShownTable& table) {
  const std::string scenario = html_escaped(table.paper->scenario);
  return fmt::format(
      "<section id={0}>\n<h2>{1}</h2>\n<div class=sides>\n<div class=side>\n<h3>Ours</h3>\n{2}{3}"
      "</div>\n<div class='side paper'>\n<h3>The paper</h3>\n{4}</div>\n</div>\n<p class=pale>At "
      "the "
      "end of every mission: <a href='{5}/{0}.md'>{0}.md</a>, <a href='{5}/{0}.csv'>{0}.csv</a>"
      "</p>\n</section>\n",
      scenario, html_escaped(table.paper->source), side_html(table, true), beyond_html(table),
      side_html(table, false), kTablesFolder);
}

std::vector<ShownTable> shown_tables(const PaperMaterial& material) {
  std::vector<ShownTable> tables;
  for (const std::string& scenario : material.request.scenarios) {
    const PaperTable& paper = *find_paper_table(scenario);
    std::vector<RunFigures> runs;
    for (const PaperRow& row : paper.rows) {
      for (const PaperMission* mission : missions_of(material, scenario, row.utility)) {
        runs.push_back(*mission->record.figures);
      }
    }
    tables.push_back({&paper, compare_rows(material, paper), compare_pairs(material, paper),
                      comparison_table(paper, runs, {})});
  }
  return tables;
}

std::string page_html(const PaperPage& page, const fs::path& folder) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=en>\n<head>\n<meta charset=utf-8>\n<meta "
      "http-equiv=Content-Security-Policy content=\"default-src 'none'; img-src data:; style-src "
      "'unsafe-inline'\">\n<meta name=viewport content='width=device-width, initial-scale=1'>\n"
      "<title>The paper’s evaluation beside ours</title>\n<style>{}</style>\n</head>\n<body>\n{}{}",
      paper_style(), head_html(page), summary_html(page));
  for (const ShownTable& table : page.tables) html += table_html(table);
  for (const DrawnFigure& figure : page.figures) html += figure_html(figure, page, folder);
  return html + undrawn_html() + "</body>\n</html>\n";
}

void write_page(const PaperPage& page, const fs::path& folder) {
  make_folder(folder / kTablesFolder);
  for (const ShownTable& table : page.tables) {
    const fs::path file = folder / kTablesFolder / table.paper->scenario;
    write_file_atomically(file.string() + ".md", markdown_text(table.whole));
    write_file_atomically(file.string() + ".csv", csv_text(table.whole));
  }
  write_file_atomically(folder / "index.html", page_html(page, folder));
}

}  // namespace gnbv
