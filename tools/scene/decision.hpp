// One decision as things to draw: the views that were sampled, the frontiers that they were sampled
// around, and the chosen one with what it looks at.
#pragma once

#include <span>
#include <vector>

#include "planner/core/plan.hpp"
#include "sim/mesh/world.hpp"
#include "tools/mission/replay.hpp"
#include "tools/run/run_record.hpp"
#include "tools/scene/scene.hpp"

namespace gnbv {

/// Utilities of the valid candidates.
struct ScoreRange {
  std::size_t valid = 0;
  double low = 0.0;
  double high = 0.0;
};
ScoreRange scores_of(const Plan& plan);

/// A candidate's ball: where it stands, or of one that was rejected, since at one place views may
/// look in several directions, at the end of its pin, small. Coloured by its utility, from the
/// lowest to the highest, or by the reason of its rejection.
BallItem ball_of(const Candidate& candidate, const ScoreRange& scores, double unit_m);

/// A ball each, and a pin from where the candidate stands towards where it looks, in their order.
void add_candidates(const Plan& plan, double unit_m, RenderScene& scene);

/// Whether one was sampled around clusters.
bool has_frontier_views(const Plan& plan);

/// The clusters of density frontiers of which a frontier decision tried some: the chosen one's
/// stands out, and those whose middle the view shows are numbered as tried. Rings join the views of
/// a layer around them (Fig. 6), where these lie within the bounds.
void add_frontiers(const FrontierConfig& config, const ReplayedDecision& decision, double unit_m,
                   const RenderView& view, Panel& panel);

/// The pyramids of its cameras; and of the rays all over their images those that meet a surface, or
/// unknown voxels beside the structure, as far as that.
void add_chosen_view(const RunRecord& record, const World& world, const Belief& belief,
                     std::size_t iteration, double unit_m, RenderScene& scene);

/// From the view before, and both as rings: over everything, since a grid's step beside a large
/// structure is short, and may lie behind it.
std::vector<PlaceLine> way_to_chosen(const RunRecord& record, std::size_t iteration);

}  // namespace gnbv
