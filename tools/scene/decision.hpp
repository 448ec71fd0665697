// One decision as things to draw: the views that were sampled, the frontiers that they were sampled
// around, and the chosen one with what it looks at.
#pragma once

#include <vector>

#include "planner/core/plan.hpp"
#include "sim/mesh/world.hpp"
#include "tools/mission/replay.hpp"
#include "tools/run/run_record.hpp"
#include "tools/scene/scene.hpp"

namespace gnbv {

/// What a candidate counts by: its utility, or in a burst the points that it covers.
double worth_of(const Candidate& candidate);

/// The worth of the valid candidates.
struct ScoreRange {
  std::size_t valid = 0;
  double low = 0.0;
  double high = 0.0;
};
ScoreRange scores_of(const Plan& plan);

/// A candidate's ball: where it stands, or of one that was rejected, since at one place views may
/// look in several directions, at the end of its pin, small. Coloured by its worth, from the
/// lowest to the highest, or by the reason of its rejection.
BallItem ball_of(const Candidate& candidate, const ScoreRange& scores, double unit_m);

/// A ball each, and a pin from where the candidate stands towards where it looks, in their order.
void add_candidates(const Plan& plan, double unit_m, RenderScene& scene);

/// Whether one was sampled around clusters.
bool has_frontier_views(const Plan& plan);

/// The clusters of density frontiers of which a frontier decision tried some: those that its views
/// look at stand out, and those whose middle the view shows are numbered as tried. Rings join the
/// views of a layer around them (Fig. 6), where these lie within the bounds.
void add_frontiers(const ReplayedDecision& decision, double unit_m, const RenderView& view,
                   Panel& panel);

/// The points that a burst was to cover around the clusters that it looks at, a dot each: those
/// that its views see, and those that are left.
struct Covered {
  std::size_t points = 0;
  std::size_t covered = 0;
};
Covered add_points_to_cover(const Scenario& scenario, const ReplayedDecision& decision,
                            double unit_m, RenderScene& scene);

/// The pyramids of its cameras; and of the rays all over their images those that meet a surface, or
/// unknown voxels beside the structure, as far as that.
void add_chosen_view(const RunRecord& record, const World& world, const Belief& belief,
                     std::size_t iteration, double unit_m, RenderScene& scene);

/// From the view before, and both as rings: over everything, since a grid's step beside a large
/// structure is short, and may lie behind it. Thinner, as far as they were flown, the ways to the
/// other views of its plan.
std::vector<PlaceLine> way_to_chosen(const RunRecord& record, std::size_t iteration);

/// A plan's views in the order of their flight, where there are several: numbers on their places,
/// that of the view at hand first.
void add_numbers_of_views(const Plan& plan, const Decision& now, Panel& panel);

}  // namespace gnbv
