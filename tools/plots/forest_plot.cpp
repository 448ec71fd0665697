#include "tools/plots/forest_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/plots/script_parts.hpp"
#include "tools/run/words.hpp"

namespace gnbv {
namespace {

// Pixels of a picture that is 1512 wide.
constexpr int kAbove_px = 110;
constexpr int kBelow_px = 200;  // of each panel: its numbers and what they are
constexpr int kNote_px = 60;
constexpr int kMethod_px = 34;
constexpr int kBetween_px = 28;  // metrics

struct ForestRow {
  std::size_t metric = 0;  // of the panel, from the top
  std::size_t method = 0;
  double mean = 0.0, low = 0.0, high = 0.0;
  bool is_significant = false;
};

/// Metrics whose differences have one unit.
struct ForestPanel {
  std::string unit;
  std::vector<std::string> metrics = {};
  std::vector<ForestRow> rows = {};
};

bool is_share(const std::string& metric) { return metric.ends_with("(%)"); }

ForestPanel panel_of(const Comparison& comparison, std::size_t scenario, bool of_shares) {
  ForestPanel panel{.unit = of_shares ? "percentage points" : "% of its mean"};
  for (const MethodFigure& figure : comparison.figures) {
    const std::string& metric = comparison.metrics[figure.metric].name;
    if (figure.scenario != scenario || !figure.contrast || is_share(metric) != of_shares) continue;
    const MeanEstimate& difference = figure.contrast->difference;
    const double base = std::abs(figure.contrast->baseline_mean);
    if (!difference.half_width || !(of_shares || base > 0.0)) continue;
    if (panel.metrics.empty() || panel.metrics.back() != metric) panel.metrics.push_back(metric);
    const double scale = of_shares ? 1.0 : 100.0 / base;
    panel.rows.push_back({.metric = panel.metrics.size() - 1,
                          .method = figure.method,
                          .mean = scale * difference.mean,
                          .low = scale * (difference.mean - *difference.half_width),
                          .high = scale * (difference.mean + *difference.half_width),
                          .is_significant = figure.contrast->verdict == Verdict::significant});
  }
  return panel;
}

/// Both ends of the axis, with 0 between: half beyond the largest mean on either side unless all
/// intervals end before, so that few seeds do not press everything else together.
std::array<double, 2> reach_of(const ForestPanel& panel) {
  double low = 0.0, high = 0.0, largest = 0.0;
  for (const ForestRow& row : panel.rows) {
    low = std::min(low, row.low);
    high = std::max(high, row.high);
    largest = std::max(largest, std::abs(row.mean));
  }
  if (low == high) return {-1.0, 1.0};  // no difference anywhere
  return {std::max(low, -1.5 * largest), std::min(high, 1.5 * largest)};
}

/// Differences have the unit of the axis.
std::string without_unit(const std::string& metric) { return metric.substr(0, metric.rfind(" (")); }

/// Names of the metrics on alternating bands.
std::string bands(const ForestPanel& panel) {
  std::string text = "unset object\n";
  std::string tics;
  for (std::size_t i = 0; i < panel.metrics.size(); ++i) {
    const auto top = -static_cast<double>(i);
    std::string name;  // which gnuplot takes for a format
    for (const char c : without_unit(panel.metrics[i])) {
      name += c == '%' ? "%%" : std::string(1, c);
    }
    tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", gnuplot_text(name), top - 0.5);
    if (i % 2 == 1) continue;
    text += fmt::format(
        "set object {} rectangle from graph 0,first {} to graph 1,first {} behind fc rgb "
        "'#f2f4f7' fs solid noborder\n",
        i + 1, top, top - 1.0);
  }
  return text + "set ytics scale 0 (" + tics + ")\n" +
         fmt::format("set yrange [{}:0]\n", -static_cast<double>(panel.metrics.size()));
}

/// The plot command of a panel: means with their intervals, and an arrow at the axis's end where
/// one goes on beyond that. `name` is of its blocks of data.
std::string intervals(const ForestPanel& panel, const Comparison& comparison,
                      std::string_view name) {
  const auto [first, last] = reach_of(panel);
  const double head = 0.02 * (last - first);
  const double low = first - 2.0 * head;
  const double high = last + 2.0 * head;
  const std::vector<std::size_t> colours = method_slots(comparison.methods);
  std::string data;
  std::string entries;
  for (std::size_t method = 0; method < comparison.methods.size(); ++method) {
    std::vector<std::vector<double>> sure, open, beyond;
    for (const ForestRow& row : panel.rows) {
      if (row.method != method) continue;
      const std::size_t slot = method - (method > comparison.baseline ? 1 : 0);
      const auto slots = static_cast<double>(comparison.methods.size() - 1);
      const double y = -static_cast<double>(row.metric) -
                       (0.1 + 0.8 * (static_cast<double>(slot) + 0.5) / slots);
      (row.is_significant ? sure : open).push_back({row.mean, y, row.low, row.high});
      if (row.low < low) beyond.push_back({low + head, y, -head});
      if (row.high > high) beyond.push_back({high - head, y, head});
    }
    const std::string colour = fmt::format("rgb '{}'", palette_colour(colours[method]));
    const auto add = [&](const std::vector<std::vector<double>>& rows, std::string_view kind,
                         std::string_view style, std::string_view inside = "") {
      if (rows.empty()) return;
      const std::string block = fmt::format("{}{}{}", name, kind, method);
      data += data_block(block, rows);
      entries +=
          fmt::format("{}${} {} lc {} notitle", entries.empty() ? "" : ", ", block, style, colour);
      if (inside.empty()) return;
      entries += fmt::format(", ${} using 1:2 with points {} notitle", block, inside);
    };
    add(sure, "sure", "using 1:2:3:4 with xerrorbars pt 7 ps 1.0 lw 1.2");
    add(open, "open", "using 1:2:3:4 with xerrorbars pt 7 ps 1.0 lw 1.2",
        "pt 7 ps 0.6 lc rgb 'white'");
    add(beyond, "beyond", "using 1:2:3:(0) with vectors head filled size graph 0.015,25 lw 1.2");
  }
  return data +
         fmt::format("set xrange [{}:{}]\nset xtics {}\n", low, high, even_step(last - first, 6)) +
         "plot " + entries + "\n";
}

/// Room for the names of the metrics, as a share of the width: gnuplot's own guess leaves the plot
/// a sliver.
double name_share(const std::vector<ForestPanel>& panels) {
  constexpr double kCharacter = 0.0165;  // where Arial is missing, letters are wide
  std::size_t longest = 0;
  for (const ForestPanel& panel : panels) {
    for (const std::string& metric : panel.metrics)
      longest = std::max(longest, without_unit(metric).size());
  }
  return std::min(0.6, 0.03 + kCharacter * static_cast<double>(longest));
}

std::vector<KeyEntry> key_of(const Comparison& comparison, std::vector<std::string>& names) {
  for (const std::string& method : comparison.methods) names.push_back(human_name(method));
  const std::vector<std::size_t> slots = method_slots(comparison.methods);
  std::vector<KeyEntry> key;
  for (std::size_t method = 0; method < names.size(); ++method) {
    if (method == comparison.baseline) continue;
    key.push_back({.colour = palette_colour(slots[method]), .text = names[method]});
  }
  return key;
}

}  // namespace

std::optional<Plot> forest_plot(const Comparison& comparison, std::size_t scenario) {
  std::vector<ForestPanel> panels = {panel_of(comparison, scenario, true),
                                     panel_of(comparison, scenario, false)};
  std::erase_if(panels, [](const ForestPanel& panel) { return panel.rows.empty(); });
  if (panels.empty()) return std::nullopt;
  const int metric_px = kBetween_px + kMethod_px * static_cast<int>(comparison.methods.size() - 1);
  int height_px = kAbove_px + kNote_px;
  for (const ForestPanel& panel : panels) {
    height_px += kBelow_px + metric_px * static_cast<int>(panel.metrics.size());
  }
  const auto screen = [&](int from_top_px) {
    return 1.0 - static_cast<double>(from_top_px) / height_px;
  };
  std::vector<std::string> names;
  std::string body =
      fmt::format(
          "set multiplot\nunset key\nunset xlabel\nset grid noytics\n"
          "set lmargin at screen {:.3f}\nset rmargin at screen 0.97\n",
          name_share(panels)) +
      title_label(human_name(comparison.scenarios[scenario]), height_px) +
      key_row(key_of(comparison, names), screen(kTitle_px)) +
      fmt::format(
          "set label 3 '95 % intervals; filled: significant after Holm; an arrow: goes on' "
          "at screen 0.02,{:.4f} left textcolor rgb '#5c6470'\n",
          screen(height_px - 40)) +
      "set arrow 1 from 0,graph 0 to 0,graph 1 nohead lw 1.0 lc rgb '#5c6470'\n";
  int top_px = kAbove_px;
  for (const ForestPanel& panel : panels) {
    const int bottom_px = top_px + metric_px * static_cast<int>(panel.metrics.size());
    const std::string words =
        fmt::format("difference to {} ({})", names[comparison.baseline], panel.unit);
    body += fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
                        screen(top_px), screen(bottom_px)) +
            fmt::format("set label 2 {} at screen 0.5,{:.4f} center textcolor rgb '#262c36'\n",
                        gnuplot_text(words), screen(bottom_px + 132)) +
            bands(panel) +
            intervals(panel, comparison, is_share(panel.metrics.front()) ? "points" : "percent") +
            "unset label\n";
    top_px = bottom_px + kBelow_px;
  }
  return Plot{"forest-" + comparison.scenarios[scenario], body, height_px};
}

}  // namespace gnbv
