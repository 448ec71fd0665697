#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "tools/figures/run_figures.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/tour_files.hpp"

namespace gnbv {
namespace {

constexpr double kLeastVoxels = 0.5;  // where the axes begin; stands for 0, too

/// Points in the colour of a source.
Series points_of(std::size_t source) {
  return {.name = std::string(name_of(static_cast<PatchSource>(source))),
          .mark = Mark::points,
          .look = {.colour = std::string(kPalette.at(source))}};
}

/// What each view of one source found over what it promised.
Series found_by_views(std::span<const ViewOutcome> outcomes, std::size_t source) {
  std::map<std::size_t, std::array<double, 2>> sums;  // by iteration
  for (const auto& [iteration, gain] : outcomes) {
    if (gain.source != static_cast<PatchSource>(source)) continue;
    sums[iteration][0] += gain.predicted;
    sums[iteration][1] += gain.found;
  }
  Series series = points_of(source);
  series.label = series.name;
  series.width_pt = 0.0;
  series.opacity = 0.6;
  for (const auto& [iteration, sum] : sums) {
    series.x.push_back(std::max(sum[0], kLeastVoxels));
    series.y.push_back(std::max(sum[1], kLeastVoxels));
  }
  return series;
}

/// Of what was missing the percentage that is `part` of it, by the looks before, of one source and
/// incidence.
template <typename Part>
Series share_by_looks(std::span<const ViewOutcome> outcomes, std::size_t source,
                      std::size_t incidence, const Part& part) {
  std::array<double, kObservationBins> missing{}, parts{};
  for (const auto& [iteration, gain] : outcomes) {
    if (gain.source != static_cast<PatchSource>(source) || gain.incidence != incidence) continue;
    missing.at(gain.observations) += gain.missing;
    parts.at(gain.observations) += part(gain);
  }
  Series series = points_of(source);
  for (std::size_t looks = 0; looks < kObservationBins; ++looks) {
    if (missing.at(looks) <= 0.0) continue;
    series.x.push_back(static_cast<double>(looks));
    series.y.push_back(100.0 * parts.at(looks) / missing.at(looks));
  }
  return series;
}

/// From what stands for 0 to the power of ten that is more than any view promised or brought.
Axis voxel_axis(std::string_view label, const std::vector<Series>& dots) {
  double most = 10.0;
  for (const Series& series : dots) {
    for (const double x : series.x) most = std::max(most, x);
    for (const double y : series.y) most = std::max(most, y);
  }
  Axis axis = log_axis(label, 1.0, 1.05 * most);
  axis.low = kLeastVoxels;
  axis.ticks.insert(axis.ticks.begin(), {kLeastVoxels, "0"});
  return axis;
}

FigurePanel panel_of_views(std::span<const ViewOutcome> outcomes) {
  std::vector<Series> dots;
  for (std::size_t source = 0; source < kPatchSources; ++source) {
    dots.push_back(found_by_views(outcomes, source));
    if (dots.back().x.empty()) dots.pop_back();
  }
  FigurePanel panel{.heading = "new voxels that each view found",
                    .x = voxel_axis("promised", dots),
                    .y = voxel_axis("", dots),
                    .height_px = 940};
  panel.series.push_back({.name = "as promised",
                          .look = {.colour = std::string(kPlotGrey), .dashes = {4.0, 3.0}},
                          .width_pt = 0.6,
                          .x = {panel.x.low, panel.x.high},
                          .y = {panel.y.low, panel.y.high}});
  panel.series.insert(panel.series.end(), dots.begin(), dots.end());
  return panel;
}

FigurePanel panel_of_incidence(std::span<const ViewOutcome> outcomes, std::size_t bin) {
  const int to_deg = bin + 1 < kIncidenceBins ? kIncidenceFrom_deg.at(bin + 1) : 90;
  FigurePanel panel{
      .heading = fmt::format("incidence {}–{}°", kIncidenceFrom_deg.at(bin), to_deg),
      .x = {.label = "looks before", .low = -0.4, .high = kObservationBins - 0.6},
      .y = {.label = bin == 0 ? "of what was missing (%)" : "", .low = 0.0, .high = 105.0},
      .height_px = 365};
  panel.x.ticks = ticks_of(0.0, kObservationBins - 1.0, 1.0);
  panel.x.ticks.back().text += '+';
  panel.y.ticks = ticks_of(0.0, 100.0, 25.0);
  for (std::size_t source = 0; source < kPatchSources; ++source) {
    Series found = share_by_looks(outcomes, source, bin, [](const auto& g) { return g.found; });
    if (found.x.empty()) continue;
    Series promised =
        share_by_looks(outcomes, source, bin, [](const auto& g) { return g.predicted; });
    found.name += ", found";
    promised.name += ", promised";
    promised.look.dashes = {4.0, 3.0};
    promised.width_pt = 0.6;
    promised.is_filled = false;
    panel.series.push_back(std::move(promised));
    panel.series.push_back(std::move(found));
  }
  return panel;
}

}  // namespace

std::optional<Figure> predictions_figure(const RunRecord& record) {
  const std::filesystem::path file = record.folder / kPredictionsFile;
  if (!std::filesystem::exists(file)) return std::nullopt;
  const std::vector<ViewOutcome> outcomes = read_predictions_csv(file);
  if (outcomes.empty()) return std::nullopt;
  Figure figure{.name = "predictions",
                .kind = "predictions",
                .title = run_and_seed(record),
                .notes = {"below: found (open: promised) of what was missing"},
                .panels = {panel_of_views(outcomes)},
                .panels_in_rows = {1, static_cast<int>(kIncidenceBins)}};
  for (std::size_t bin = 0; bin < kIncidenceBins; ++bin) {
    figure.panels.push_back(panel_of_incidence(outcomes, bin));
  }
  return figure;
}

}  // namespace gnbv
