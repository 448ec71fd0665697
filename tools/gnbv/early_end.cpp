#include "tools/gnbv/early_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace gnbv {
namespace {

constexpr std::size_t kFewViews = 20;
constexpr double kExplored = 0.8;  // coverage at 0.05 m
constexpr double kFound = 0.3;     // likewise: a tour that found the structure knows when it ends

/// What a rejection means, and what helps, in the order of Rejection.
struct RejectionText {
  std::string_view meaning, remedy;
};
constexpr std::string_view kLookAtClusters =
    "a planner.fvs.radius_m that suits the cameras' range, and more planner.fvs.views_per_layer";
constexpr std::array<RejectionText, kRejectionNames.size()> kRejectionTexts = {
    {{"outside the workspace", "give it room: workspace_m, or --bounds auto"},
     {"in space that is occupied or was never measured",
      "measure more first (planner.profiling.method: bounding_box), or "
      "planner.validity.allow_unknown: true"},
     {"within planner.validity.collision_radius_m of the structure",
      "a smaller planner.validity.collision_radius_m, or a larger workspace_m"},
     {"behind something: no clear way there",
      "planner.validity.path: astar, or a smaller planner.validity.collision_radius_m"},
     {"visited already", "a larger planner.agvs.step_m or planner.fvs.radius_m"},
     {"not looking at their frontier: it is out of the cameras' range or opening", kLookAtClusters},
     {"not seeing their frontier: something is in between", kLookAtClusters},
     {"without any surface in sight",
      "begin where the structure can be seen (start.position_m, or --bounds auto), with "
      "planner.fvs.enabled: true"},
     {"within planner.validity.collision_radius_m of a no_fly box",
      "smaller no_fly boxes, or a larger workspace_m"},
     {"with a pitch that no gimbal reaches",
      "pitches within cameras.N.pitch_deg: {min, max, step}"},
     {"behind something so large that the search for a way around it ended first",
      "a larger planner.validity.path_search.max_expansions"}}};

const RejectionText& text_of(Rejection reason) {
  return kRejectionTexts[static_cast<std::size_t>(reason)];
}

std::string of_no_valid_view(const std::map<Rejection, int>& rejections) {
  int all = 0;
  std::vector<std::pair<Rejection, int>> by_count(rejections.begin(), rejections.end());
  std::stable_sort(by_count.begin(), by_count.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  for (const auto& [reason, count] : by_count) all += count;
  if (all == 0) return "no view was sampled; what helps: planner.fvs.enabled: true\n";
  std::string text = fmt::format("none of {} views that were tried will do:\n", all);
  for (const auto& [reason, count] : by_count) {
    text += fmt::format("  {:5} {}\n", count, text_of(reason).meaning);
  }
  return text + fmt::format("what helps: {}\n", text_of(by_count.front().first).remedy);
}

}  // namespace

std::string refused_views_note(const MissionResult& result) {
  std::map<Rejection, int> counts;
  int refused = 0;
  for (const UserView& view : result.user_views) {
    if (!view.rejected) continue;
    ++counts[*view.rejected];
    ++refused;
  }
  if (refused == 0) return "";
  std::string text = fmt::format("{} of {} given views refused, views.csv says which:\n", refused,
                                 result.user_views.size());
  for (const auto& [reason, count] : counts) {
    text += fmt::format("  {:5} {}\n", count, text_of(reason).meaning);
  }
  return text;
}

std::string early_end_note(const MissionResult& result, double coverage,
                           const PlannerTraits& planner) {
  const std::size_t views = result.views.size();
  // of a laid route no view that could be flown to is left: it was flown
  const bool has_route = result.termination == Termination::no_valid_view && planner.lays_views &&
                         result.last_rejections.empty();
  const bool is_tour = result.termination == Termination::tour_complete;
  const double enough = is_tour ? kFound : kExplored;
  if (views >= kFewViews || coverage >= enough || has_route) return "";
  const std::string after = fmt::format(
      "the mission ended after {} view{}, before it explored: ", views, views == 1 ? "" : "s");
  switch (result.termination) {
    case Termination::no_valid_view:
      return after + of_no_valid_view(result.last_rejections);
    case Termination::repeated_motion:
      return after +
             "it went back and forth between two places; what helps: planner.fvs.enabled: true, or "
             "planner.termination.repeated_moves: 0\n";
    case Termination::entropy_change:
      return after +
             "views changed the map too little; what helps: a smaller "
             "planner.termination.entropy_change_percent (0: never)\n";
    case Termination::low_gain:
      return after +
             "views found too little on their way; what helps: a smaller "
             "planner.termination.min_new_voxels_per_m (0: never), or a longer new_voxels_window\n";
    case Termination::tour_complete:
      return after +
             "no view pays by what was seen so far; what helps: a start that sees the structure, "
             "or planner.tour.explore: true\n";
    case Termination::battery:
      return after +
             "the vehicle needed the rest of its battery to come down; what helps: "
             "vehicle.power.battery_wh\n";
    default:
      return "";
  }
}

}  // namespace gnbv
