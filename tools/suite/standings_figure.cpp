#include <algorithm>

#include "bench/suite/standings.hpp"
#include "sim/core/text.hpp"
#include "tools/suite/suite_work.hpp"

namespace gnbv {
namespace {

constexpr int kEntry_px = 60;

/// The entries from above, each an interval in percent.
FigurePanel panel_of(const SuiteTrack& track, const std::vector<Standing>& sorted) {
  const auto count = static_cast<double>(sorted.size());
  FigurePanel panel{.heading = "track " + track.name,
                    .y = {.low = -count, .high = 0.0},
                    .height_px = kEntry_px * static_cast<int>(sorted.size() + 1),
                    .has_categories = true};
  std::vector<std::string> names;
  for (const Standing& standing : sorted) names.push_back(standing.entry->name);
  const std::vector<SeriesLook> looks = method_looks(names);
  double most = 100.0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const Interval& score = sorted[i].entry->figures.score;
    const double y = -0.5 - static_cast<double>(i);
    const std::string name = printable(names[i]);
    panel.y.ticks.push_back({y, name});
    panel.series.push_back({.name = name,
                            .mark = Mark::interval,
                            .look = looks[i],
                            .x = {100.0 * score.mean},
                            .y = {y},
                            .low = {100.0 * score.low},
                            .high = {100.0 * score.high}});
    most = std::max(most, 100.0 * score.high);
  }
  panel.x = axis_around("score (% of the best known planner's)", 0.0, most);
  panel.series.push_back({.name = "best known planner",
                          .look = {.colour = std::string(kPlotGrey)},
                          .x = {100.0, 100.0},
                          .y = {panel.y.low, panel.y.high}});
  return panel;
}

}  // namespace

Figure standings_figure(const Suite& suite, const std::vector<Submission>& entries) {
  Figure figure{.name = "standings",
                .kind = "standings",
                .notes = {"means over structures with their 95 % intervals"}};
  for (const SuiteTrack& track : suite.tracks) {
    const std::vector<Standing> sorted = standings(suite, entries, track.name);
    if (!sorted.empty()) figure.panels.push_back(panel_of(track, sorted));
  }
  return figure;
}

}  // namespace gnbv
