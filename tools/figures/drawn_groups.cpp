#include "tools/figures/drawn_groups.hpp"

#include <fmt/format.h>

#include <array>

#include "sim/core/text.hpp"

namespace gnbv {
namespace {

Series mean_of_group(const DrawnGroup& group, Mark mark) {
  Series series{.name = group.label,
                .label = group.words(),
                .mark = mark,
                .look = group.look,
                .width_pt = kGroupWidth_pt,
                .x = group.mean.x,
                .end = std::array{group.mean.end_x, group.mean.end_y}};
  for (const MeanEstimate& y : group.mean.y) {
    series.y.push_back(y.mean);
    if (!group.has_band()) continue;
    series.low.push_back(y.mean - y.half_width.value_or(0.0));
    series.high.push_back(y.mean + y.half_width.value_or(0.0));
  }
  return series;
}

}  // namespace

DrawnGroup::DrawnGroup(std::string name, SeriesLook its_look, std::vector<StepCurve> its_curves)
    : label(std::move(name)),
      look(std::move(its_look)),
      curves(std::move(its_curves)),
      mean(mean_curve(curves)) {}

std::string DrawnGroup::words() const {
  return fmt::format("{} ({}){}", label, counted(curves.size(), "seed", "seeds"),
                     has_band() ? ", 95 % interval" : "");
}

void add_groups(std::span<const DrawnGroup> groups, Mark mark, FigurePanel& panel,
                std::vector<std::string>& notes) {
  bool has_pair = false;
  bool has_several_ends = false;
  for (const DrawnGroup& group : groups) {
    has_several_ends =
        has_several_ends || group.mean.longest_x - group.mean.shortest_x > 0.01 * group.mean.end_x;
    if (group.curves.size() < 2 || group.has_band()) continue;
    has_pair = true;
    for (std::size_t k = 0; k < group.curves.size(); ++k) {
      panel.series.push_back({.name = fmt::format("{}, run {}", group.label, k + 1),
                              .mark = mark,
                              .look = {.colour = group.look.colour},
                              .width_pt = 0.4,
                              .x = group.curves[k].x,
                              .y = group.curves[k].y});
    }
  }
  for (const DrawnGroup& group : groups) panel.series.push_back(mean_of_group(group, mark));
  if (has_pair) notes.emplace_back("thin: each of two seeds; thick: their mean");
  if (has_several_ends) notes.emplace_back("mark: mean end of the seeds");
}

}  // namespace gnbv
