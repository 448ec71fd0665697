#include "tools/plots/reach_plot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/score/effort_to_reach.hpp"
#include "tools/plots/script_parts.hpp"

namespace gnbv {
namespace {

/// A group's runs whose ceiling is known: how many, and what those that got there had spent.
struct Arrivals {
  std::string label;
  std::string method;
  std::size_t runs = 0;
  std::vector<double> efforts = {};  // ascending
};

std::vector<Arrivals> arrivals_of(std::span<const RunGroup> groups, Effort effort, double share) {
  std::vector<Arrivals> all;
  const std::vector<std::string> methods = methods_of(groups);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const RunGroup& group = groups[i];
    Arrivals arrivals{.label = group.label, .method = methods[i]};
    for (const RunRecord* run : group.runs) {
      const RunFigures& figures = *run->figures;
      if (!figures.ceiling) continue;
      ++arrivals.runs;
      const auto spent = effort_to_reach(figures.curve, figures.before, share * *figures.ceiling);
      if (!spent) continue;
      const auto entry = static_cast<std::size_t>(spent->views);
      arrivals.efforts.push_back(spent_at(figures.curve, effort, entry));
    }
    std::sort(arrivals.efforts.begin(), arrivals.efforts.end());
    if (arrivals.runs > 0) all.push_back(std::move(arrivals));
  }
  return all;
}

/// Corners of the step curve in percent, up to the end of the axis.
std::string steps_of(const Arrivals& arrivals, std::size_t index, double longest) {
  std::vector<std::vector<double>> rows = {{0.0, 0.0}};
  double percent = 0.0;
  for (std::size_t i = 0; i < arrivals.efforts.size(); ++i) {
    percent = 100.0 * static_cast<double>(i + 1) / static_cast<double>(arrivals.runs);
    rows.push_back({arrivals.efforts[i], percent});
  }
  rows.push_back({longest, percent});
  return data_block(fmt::format("reach{}", index), rows);
}

}  // namespace

std::optional<Plot> reach_plot(std::span<const RunGroup> groups, Effort effort, double share) {
  const std::vector<Arrivals> all = arrivals_of(groups, effort, share);
  if (all.empty()) return std::nullopt;
  double longest = 1e-6;
  for (const RunGroup& group : groups) {
    for (const RunRecord* run : group.runs) {
      longest = std::max(longest, whole_effort(run->figures->curve, effort));
    }
  }
  std::vector<std::string> methods;
  for (const Arrivals& arrivals : all) methods.push_back(arrivals.method);
  const std::vector<std::size_t> slots = method_slots(methods);
  const std::string title = common_scenario(groups);
  std::string body;
  std::string entries;
  std::vector<KeyEntry> key;
  for (std::size_t i = 0; i < all.size(); ++i) {
    body += steps_of(all[i], i, longest);
    entries += fmt::format("{}$reach{} using 1:2 with steps lw 1.3 dt {} lc rgb '{}'",
                           i > 0 ? ", " : "", i, method_dashes(slots[i]), palette_colour(slots[i]));
    key.push_back({.colour = palette_colour(slots[i]),
                   .text = fmt::format("{} ({} of {})", label_below(title, all[i].label),
                                       all[i].efforts.size(), all[i].runs),
                   .line = 1.3,
                   .dashes = method_dashes(slots[i])});
  }
  body +=
      key_above(title, key) +
      fmt::format(
          "set yrange [0:103]\nset ytics 20\nset xrange [0:{}] noextend\nset rmargin 3\n"
          "{}set xlabel {}\nset ylabel {} offset 0.6,0\nplot {}\n",
          longest, x_tics(0.0, longest, even_step(longest)), gnuplot_text(effort_label(effort)),
          gnuplot_text(fmt::format("runs at {:.0f} % of the ceiling (%)", 100.0 * share)), entries);
  return Plot{fmt::format("reach-{}", effort_name(effort)), body,
              height_with_key_px(title, key.size())};
}

}  // namespace gnbv
