#include "tools/plots/forest_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/plots/script_parts.hpp"
#include "tools/run_files/words.hpp"

namespace gnbv {
namespace {

constexpr int kRow_px = 62;
constexpr int kBorders_px = 330;

struct ForestRow {
  std::string label;
  std::size_t method = 0;
  double percent = 0.0;
  double half_percent = 0.0;
  bool is_significant = false;
};

std::vector<ForestRow> rows_of(const Comparison& comparison, std::size_t scenario) {
  std::vector<ForestRow> rows;
  for (const MethodFigure& figure : comparison.figures) {
    if (figure.scenario != scenario || !figure.contrast) continue;
    const Contrast& contrast = *figure.contrast;
    const double base = std::abs(contrast.baseline_mean);
    if (!contrast.difference.half_width || !(base > 0.0)) continue;
    rows.push_back({.label = comparison.metrics[figure.metric].name,
                    .method = figure.method,
                    .percent = 100.0 * contrast.difference.mean / base,
                    .half_percent = 100.0 * *contrast.difference.half_width / base,
                    .is_significant = contrast.verdict == Verdict::significant});
  }
  return rows;
}

/// Labels of the metrics, each once, beside the first of its rows.
std::string tics_of(const std::vector<ForestRow>& rows) {
  std::string tics;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && rows[i].label == rows[i - 1].label) continue;
    std::string label;  // which gnuplot takes for a format
    for (const char c : rows[i].label) label += c == '%' ? "%%" : std::string(1, c);
    tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", gnuplot_text(label),
                        -static_cast<double>(i));
  }
  return "set ytics (" + tics + ")\n";
}

/// Between labels of the difference, so that about four of them stand side by side: 1, 2 or 5 times
/// a power of ten.
double tic_step(const std::vector<ForestRow>& rows) {
  double low = 0.0, high = 0.0;
  for (const ForestRow& row : rows) {
    low = std::min(low, row.percent - row.half_percent);
    high = std::max(high, row.percent + row.half_percent);
  }
  const double least = std::max((high - low) / 4.0, 1e-6);
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double times : {1.0, 2.0, 5.0}) {
    if (times * power >= least) return times * power;
  }
  return 10.0 * power;
}

/// Room for the labels, as a share of the width: gnuplot's own guess leaves the plot a sliver.
double label_share(const std::vector<ForestRow>& rows) {
  constexpr double kCharacter = 0.0152;  // where Arial is missing, letters are wide
  std::size_t longest = 0;
  for (const ForestRow& row : rows) longest = std::max(longest, row.label.size());
  return std::min(0.6, 0.03 + kCharacter * static_cast<double>(longest));
}

}  // namespace

std::optional<Plot> forest_plot(const Comparison& comparison, std::size_t scenario) {
  const std::vector<ForestRow> rows = rows_of(comparison, scenario);
  if (rows.empty()) return std::nullopt;
  std::string data;
  std::string entries;
  for (std::size_t method = 0; method < comparison.methods.size(); ++method) {
    for (const bool is_significant : {true, false}) {
      std::vector<std::vector<double>> own;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].method != method || rows[i].is_significant != is_significant) continue;
        own.push_back({rows[i].percent, -static_cast<double>(i), rows[i].half_percent});
      }
      const std::string name = fmt::format("{}{}", is_significant ? "sure" : "open", method);
      if (own.empty()) continue;
      data += data_block(name, own);
      entries +=
          fmt::format(", ${} using 1:2:3 with xerrorbars pt {} ps 1.0 lw 1.2 lc rgb '{}' notitle",
                      name, is_significant ? 7 : 6, kPalette[method % kPalette.size()]);
    }
    if (method == comparison.baseline) continue;
    entries += fmt::format(", keyentry with points pt 7 ps 1.0 lc rgb '{}' title {}",
                           kPalette[method % kPalette.size()],
                           gnuplot_text(human_name(comparison.methods[method])));
  }
  const int height_px = kBorders_px + kRow_px * static_cast<int>(rows.size());
  const std::string x_label =
      fmt::format("difference to {} (% of its mean; 95 % interval; filled: significant)",
                  human_name(comparison.methods[comparison.baseline]));
  return Plot{
      "forest-" + comparison.scenarios[scenario],
      data + tics_of(rows) +
          fmt::format("set yrange [{}:0.7]\nset xtics {}\n", 0.3 - static_cast<double>(rows.size()),
                      tic_step(rows)) +
          fmt::format("set bmargin at screen {:.4f}\n", 150.0 / height_px) +
          fmt::format("set label 2 {} at screen 0.5,{:.4f} center textcolor rgb '#262c36'\n",
                      gnuplot_text(x_label), 30.0 / height_px) +
          "set key at screen 0.98,0.985 right top horizontal\nset rmargin 3\n" +
          fmt::format("set lmargin at screen {:.3f}\n", label_share(rows)) +
          fmt::format("set tmargin at screen {:.4f}\n", 1.0 - 100.0 / height_px) +
          fmt::format("set label 1 {} at screen 0.02,{:.4f} left textcolor rgb '#262c36'\n",
                      gnuplot_text(human_name(comparison.scenarios[scenario])),
                      1.0 - 45.0 / height_px) +
          "set arrow 1 from 0,graph 0 to 0,graph 1 nohead lw 1.0 lc rgb '#5c6470'\nplot " +
          entries.substr(2) + "\n",
      height_px};
}

}  // namespace gnbv
