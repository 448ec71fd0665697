#include "tools/plots/predictions_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tools/plots/script_parts.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/predictions_csv.hpp"

namespace gnbv {
namespace {

constexpr double kLeastVoxels = 0.5;  // where the axes begin; stands for 0, too

// The layout in pixels from the top of a picture that is kWidth_px wide.
constexpr double kWidth_px = 1512.0;
constexpr int kTall_px = 2080;
constexpr double kFrom_px = 174.0;
constexpr double kTo_px = 1450.0;
constexpr double kGap_px = 60.0;  // between the panels below

double screen_y(double y_px) { return 1.0 - y_px / kTall_px; }

std::string margins(double left_px, double right_px, double top_px, double bottom_px) {
  return fmt::format(
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n"
      "set bmargin at screen {:.4f}\n",
      left_px / kWidth_px, right_px / kWidth_px, screen_y(top_px), screen_y(bottom_px));
}

std::string label(int number, std::string_view text, double x_px, double y_px,
                  std::string_view align, std::string_view colour) {
  return fmt::format("set label {} {} at screen {:.4f},{:.4f} {} textcolor rgb '{}'\n", number,
                     gnuplot_text(text), x_px / kWidth_px, screen_y(y_px), align, colour);
}

std::string source_block(std::string_view what, std::size_t source, std::size_t bin) {
  return fmt::format("{}_{}_{}", what, name_of(static_cast<PatchSource>(source)), bin);
}

/// Promised and found of each view, of one source.
std::vector<std::vector<double>> view_rows(std::span<const ViewOutcome> outcomes,
                                           PatchSource source) {
  std::map<std::size_t, std::vector<double>> sums;  // by iteration
  for (const auto& [iteration, gain] : outcomes) {
    if (gain.source != source) continue;
    std::vector<double>& sum = sums.try_emplace(iteration, 2, 0.0).first->second;
    sum[0] += gain.predicted;
    sum[1] += gain.found;
  }
  std::vector<std::vector<double>> rows;
  for (auto& [iteration, sum] : sums) {
    for (double& voxels : sum) voxels = std::max(voxels, kLeastVoxels);
    rows.push_back(std::move(sum));
  }
  return rows;
}

/// Looks before, and of what was missing the percentages found and promised, of one source and
/// incidence.
std::vector<std::vector<double>> share_rows(std::span<const ViewOutcome> outcomes,
                                            PatchSource source, std::size_t incidence) {
  std::array<double, kObservationBins> missing{};
  std::array<double, kObservationBins> found{};
  std::array<double, kObservationBins> promised{};
  for (const auto& [iteration, gain] : outcomes) {
    if (gain.source != source || gain.incidence != incidence) continue;
    missing.at(gain.observations) += gain.missing;
    found.at(gain.observations) += gain.found;
    promised.at(gain.observations) += gain.predicted;
  }
  std::vector<std::vector<double>> rows;
  for (std::size_t looks = 0; looks < kObservationBins; ++looks) {
    if (missing.at(looks) <= 0.0) continue;
    const double percent = 100.0 / missing.at(looks);
    rows.push_back(
        {static_cast<double>(looks), percent * found.at(looks), percent * promised.at(looks)});
  }
  return rows;
}

/// The power of ten that is more than any view promised or brought.
double end_of_axes(std::span<const std::vector<std::vector<double>>> rows_of_sources) {
  double most = 10.0;
  for (const auto& rows : rows_of_sources) {
    for (const auto& row : rows) most = std::max({most, row[0], row[1]});
  }
  return std::pow(10.0, std::ceil(std::log10(1.05 * most)));
}

std::string panel_of_views(std::span<const ViewOutcome> outcomes) {
  std::array<std::vector<std::vector<double>>, kPatchSources> rows;
  for (std::size_t i = 0; i < kPatchSources; ++i) {
    rows.at(i) = view_rows(outcomes, static_cast<PatchSource>(i));
  }
  const double end = end_of_axes(rows);
  std::string text;
  std::string dots;
  for (std::size_t i = 0; i < kPatchSources; ++i) {
    if (rows.at(i).empty()) continue;
    const std::string name = source_block("views", i, 0);
    text += data_block(name, rows.at(i));
    dots += fmt::format(", ${} using 1:2 with points pt 7 ps 0.45 lc rgb '#60{}'", name,
                        kPalette.at(i).substr(1));
  }
  text += margins(kFrom_px, kTo_px, 240.0, 1180.0);
  text += label(2, "new voxels that each view found", kFrom_px, 205.0, "left", kPlotGrey);
  text += label(3, "promised", 0.5 * (kFrom_px + kTo_px), 1310.0, "center", kPlotInk);
  text += fmt::format(
      "set logscale xy\nset xrange [{0}:{1:g}]\nset yrange [{0}:{1:g}]\nset format xy '%.0s%c'\n"
      "set xtics 10\nset ytics 10\nset xtics add ('0' {0})\nset ytics add ('0' {0})\n",
      kLeastVoxels, end);
  return text + fmt::format("plot x with lines lw 0.8 dt 2 lc rgb '{}'{}\nunset logscale\n",
                            kPlotGrey, dots);
}

std::string panel_of_incidence(std::span<const ViewOutcome> outcomes, std::size_t bin) {
  constexpr double kTop_px = 1535.0;
  constexpr double kBottom_px = 1900.0;
  const double width_px = (kTo_px - kFrom_px - (kIncidenceBins - 1) * kGap_px) / kIncidenceBins;
  const double left_px = kFrom_px + static_cast<double>(bin) * (width_px + kGap_px);
  std::string text = "unset label\n";
  std::string lines;
  for (std::size_t i = 0; i < kPatchSources; ++i) {
    const auto rows = share_rows(outcomes, static_cast<PatchSource>(i), bin);
    if (rows.empty()) continue;
    const std::string name = source_block("share", i, bin);
    text += data_block(name, rows);
    lines += fmt::format(
        "{0}${1} using 1:2 with linespoints lw 1.0 pt 7 ps 0.5 lc rgb '{2}', ${1} using 1:3 with "
        "linespoints lw 0.8 dt 2 pt 6 ps 0.4 lc rgb '{2}'",
        lines.empty() ? "" : ", ", name, kPalette.at(i));
  }
  const int to_deg = bin + 1 < kIncidenceBins ? kIncidenceFrom_deg.at(bin + 1) : 90;
  text += margins(left_px, left_px + width_px, kTop_px, kBottom_px);
  text += label(2, fmt::format("incidence {}–{}°", kIncidenceFrom_deg.at(bin), to_deg), left_px,
                kTop_px - 35.0, "left", kPlotGrey);
  if (bin == 0) {
    text += label(3, "found (open: promised) of missing (%)", kFrom_px, kTop_px - 110.0, "left",
                  kPlotGrey);
  }
  text += label(4, "looks before", left_px + 0.5 * width_px, kTall_px - 40.0, "center", kPlotInk);
  text += fmt::format(
      "set xrange [-0.4:{0}.4]\nset yrange [0:105]\nset xtics 1\nset xtics add ('{0}+' {0})\nset "
      "ytics 25\nset format x '%g'\nset format y '{1}'\n",
      kObservationBins - 1, bin == 0 ? "%g" : "");
  return text + "plot " + (lines.empty() ? "-1 notitle" : lines) + "\n";
}

}  // namespace

std::optional<Plot> predictions_plot(const RunRecord& record) {
  const std::filesystem::path file = record.folder / kPredictionsFile;
  if (!std::filesystem::exists(file)) return std::nullopt;
  const std::vector<ViewOutcome> outcomes = read_predictions_csv(file);
  if (outcomes.empty()) return std::nullopt;
  std::vector<KeyEntry> key;
  for (std::size_t i = 0; i < kPatchSources; ++i) {
    const bool is_there =
        std::any_of(outcomes.begin(), outcomes.end(), [&](const ViewOutcome& outcome) {
          return outcome.gain.source == static_cast<PatchSource>(i);
        });
    if (is_there)
      key.push_back(
          {.colour = kPalette.at(i), .text = std::string(name_of(static_cast<PatchSource>(i)))});
  }
  std::string text = "set multiplot\nunset key\nunset xlabel\nunset ylabel\n";
  text += title_label(run_and_seed(record), kTall_px);
  text += key_row(key, screen_y(125.0));
  text += panel_of_views(outcomes);
  for (std::size_t bin = 0; bin < kIncidenceBins; ++bin) {
    text += panel_of_incidence(outcomes, bin);
  }
  return Plot{"predictions", text + "unset multiplot\n", kTall_px};
}

}  // namespace gnbv
