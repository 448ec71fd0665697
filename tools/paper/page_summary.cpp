// The top of the page: what agrees and what does not.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/compare/text_table.hpp"
#include "sim/core/text.hpp"
#include "tools/page/page_text.hpp"
#include "tools/paper/page_parts.hpp"

namespace gnbv {
namespace {

std::string_view colour_of(Agreement agreement) {
  constexpr std::array<std::string_view, 5> kinds = {"good", "near", "open", "bad", "open"};
  return kinds[static_cast<std::size_t>(agreement)];
}

std::string_view colour_of(PairOrder order) {
  constexpr std::array<std::string_view, 4> kinds = {"good", "bad", "open", "open"};
  return kinds[static_cast<std::size_t>(order)];
}

std::string_view colour_of(ClaimVerdict verdict) {
  constexpr std::array<std::string_view, 4> kinds = {"good", "open", "bad", "open"};
  return kinds[static_cast<std::size_t>(verdict)];
}

/// "+1,200", "-3.5", "0.0".
std::string signed_number(double value, int decimals) {
  const std::string text = grouped(value, decimals);
  const bool is_zero = text.find_first_of("123456789") == std::string::npos;
  return (value > 0.0 && !is_zero ? "+" : "") + text;
}

/// "+1.4 points", "-12 %".
std::string deviation(const PaperFigure& figure, const ComparedFigure& both) {
  const double away = both.ours->mean - *both.printed;
  return figure.is_coverage ? signed_number(away, 1) + " points"
                            : signed_number(100.0 * away / std::abs(*both.printed), 0) + " %";
}

std::string cell_of(const PaperFigure& figure, const ComparedFigure& both) {
  if (!both.agreement) return both.printed ? "<td class=pale>not flown</td>" : "<td></td>";
  return fmt::format("<td>{}</td>", chip(colour_of(*both.agreement), deviation(figure, both)));
}

/// The columns that the paper prints of any row of the page.
std::vector<std::size_t> printed_columns(const PaperPage& page) {
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < compared_figures().size(); ++i) {
    const bool is_printed =
        std::any_of(page.tables.begin(), page.tables.end(), [&](const ShownTable& table) {
          return std::any_of(table.rows.begin(), table.rows.end(),
                             [&](const ComparedRow& row) { return row.figures[i].printed; });
        });
    if (is_printed) columns.push_back(i);
  }
  return columns;
}

std::string head_row(std::string_view first, const std::vector<std::size_t>& columns) {
  std::string html = fmt::format("<tr>{}", first);
  for (const std::size_t i : columns) {
    html += fmt::format("<th>{}</th>", html_escaped(compared_figures()[i].head));
  }
  return html + "</tr>\n";
}

/// "162", or where ours took fewer "10 (paper 635)".
std::string views_text(const ComparedRow& row) {
  if (row.missions == 0) return "-";
  if (!row.printed_views) return row.utility.empty() ? "" : grouped(row.views, 0);
  if (row.views < *row.printed_views) {
    return fmt::format("{} (paper {})", grouped(row.views, 0), grouped(*row.printed_views, 0));
  }
  return grouped(row.views, 0);
}

std::string numbers_html(const PaperPage& page) {
  const std::vector<std::size_t> columns = printed_columns(page);
  std::string html =
      "<h3>Numbers: how far ours are from the paper's</h3>\n<div class=scroll><table>\n" +
      head_row("<th>Utility</th><th>Views</th>", columns);
  for (const ShownTable& table : page.tables) {
    html += fmt::format("<tr class=group><td colspan=9>{}</td></tr>\n",
                        html_escaped(table.paper->source));
    for (const ComparedRow& row : table.rows) {
      html += fmt::format("<tr><td>{}{}</td><td>{}</td>", html_escaped(row.label),
                          row.is_doubtful ? " †" : "", views_text(row));
      for (const std::size_t i : columns) {
        html += cell_of(compared_figures()[i], row.figures[i]);
      }
      html += "</tr>\n";
    }
  }
  html += "</table></div>\n<p class=pale>" + chip("good", "agrees") +
          " the paper's number lies in our 95 % interval, whose half width is at most 10 points of "
          "coverage or 20 % of the number. " +
          chip("near", "close") + " within 2 points, or 5 %. " + chip("open", "undecided") +
          " in our interval, which is wider than that. " + chip("bad", "differs") + " otherwise. " +
          chip("open", "cut short") +
          " as that, but a limit of ours (views, metres, time, battery) ended a mission before it "
          "had as many views as the paper's. Ours is taken after as many views as the paper's row "
          "took, or at its own end where that came first. The paper names no unit of entropy; "
          "ours is in nat. † printed with more coverage at 0.05 m than at 0.10 m, which is hardly "
          "possible: the two columns may have changed places.</p>\n";
  return html;
}

std::string order_cell(const ShownTable& table, const std::string& first, const std::string& second,
                       std::size_t figure) {
  for (const ComparedPair& pair : table.pairs) {
    if (pair.first != first || pair.second != second || pair.figure != figure) continue;
    const int decimals = compared_figures()[figure].decimals;
    std::string ours = signed_number(pair.ours.mean, decimals);
    if (pair.ours.half_width) ours += " ±" + grouped(*pair.ours.half_width, decimals);
    return fmt::format("<td>{}<br><span class=pale>{}<br>paper {}</span></td>",
                       chip(colour_of(pair.order), name_of(pair.order)), html_escaped(ours),
                       signed_number(pair.printed, decimals));
  }
  return "<td></td>";
}

std::string orders_html(const PaperPage& page) {
  const std::vector<std::size_t> columns = printed_columns(page);
  std::string rows;
  for (const ShownTable& table : page.tables) {
    if (table.pairs.empty()) continue;
    rows += fmt::format("<tr class=group><td colspan=9>{}</td></tr>\n",
                        html_escaped(table.paper->source));
    const ComparedPair* last = nullptr;
    for (const ComparedPair& pair : table.pairs) {  // in runs of one pair each
      if (last != nullptr && last->first == pair.first && last->second == pair.second) continue;
      last = &pair;
      rows += fmt::format("<tr><td>{} minus {}</td>", html_escaped(pair.first),
                          html_escaped(pair.second));
      for (const std::size_t i : columns) {
        rows += order_cell(table, pair.first, pair.second, i);
      }
      rows += "</tr>\n";
    }
  }
  if (rows.empty()) return "";
  return "<h3>Order: which of two planners has more</h3>\n<div class=scroll><table>\n" +
         head_row("<th>Pair</th>", columns) + rows + "</table></div>\n<p class=pale>" +
         chip("good", "same") +
         " our 95 % interval of the difference, paired by seed, excludes 0 on the paper's side. " +
         chip("bad", "reversed") + " on the other side. " + chip("open", "undecided") +
         " it holds 0, one seed was flown, or a mission was cut short.</p>\n";
}

std::string claims_html(const PaperPage& page) {
  if (page.claims.empty()) return "";
  std::string html =
      "<h3>Sentences on figures</h3>\n<div class=scroll><table>\n<tr><th>Figure</th><th "
      "class=text>The paper</th><th class=text>Ours</th><th class=text>Rule</th><th></th></tr>\n";
  for (const CheckedClaim& claim : page.claims) {
    html += fmt::format(
        "<tr><td><a href='#fig{0}'>{0}</a></td><td class=text>{1}</td><td class=text>{2}</td>"
        "<td class=text>{3}</td><td>{4}</td></tr>\n",
        claim.figure, html_escaped(claim.sentence), html_escaped(claim.finding),
        html_escaped(claim.rule), chip(claim.verdict));
  }
  return html +
         "</table></div>\n<p class=pale>A sentence on many cases is judged by the share of "
         "them in which it is so, one on a course over the iterations by Spearman's rank "
         "correlation with them; the rule of each stands beside its verdict.</p>\n";
}

/// How often each verdict was given.
template <typename Verdict, std::size_t N>
std::string count_html(std::string_view what, const std::array<std::size_t, N>& counts) {
  std::string html;
  std::size_t all = 0;
  for (std::size_t i = 0; i < N; ++i) {
    if (counts[i] == 0) continue;
    all += counts[i];
    html +=
        fmt::format("{} ", chip(colour_of(static_cast<Verdict>(i)),
                                fmt::format("{} {}", counts[i], name_of(static_cast<Verdict>(i)))));
  }
  if (all == 0) return "";
  return fmt::format("<div class=count><b>{}: {}</b>{}</div>\n", what, all, html);
}

std::string counts_html(const PaperPage& page) {
  std::array<std::size_t, 5> numbers{};
  std::array<std::size_t, 4> orders{};
  std::array<std::size_t, 4> sentences{};
  for (const ShownTable& table : page.tables) {
    for (const ComparedRow& row : table.rows) {
      for (const ComparedFigure& figure : row.figures) {
        if (figure.agreement) ++numbers[static_cast<std::size_t>(*figure.agreement)];
      }
    }
    for (const ComparedPair& pair : table.pairs) ++orders[static_cast<std::size_t>(pair.order)];
  }
  for (const CheckedClaim& claim : page.claims) {
    ++sentences[static_cast<std::size_t>(claim.verdict)];
  }
  return "<div class=counts>\n" + count_html<Agreement>("Numbers", numbers) +
         count_html<PairOrder>("Orders of two planners", orders) +
         count_html<ClaimVerdict>("Sentences on figures", sentences) + "</div>\n";
}

}  // namespace

std::string chip(std::string_view kind, std::string_view text) {
  return fmt::format("<span class='chip {}'>{}</span>", kind, html_escaped(text));
}

std::string chip(ClaimVerdict verdict) { return chip(colour_of(verdict), name_of(verdict)); }

std::string summary_html(const PaperPage& page) {
  return "<section id=summary>\n<h2>What agrees, what does not</h2>\n" + counts_html(page) +
         numbers_html(page) + orders_html(page) + claims_html(page) + "</section>\n";
}

}  // namespace gnbv
