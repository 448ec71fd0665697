// One decision: the views that were sampled, why they were rejected or how they scored; and from
// near what the chosen one looks at (Figures 2, 5 and 6 of the paper).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "tools/render/candidate_legend.hpp"
#include "tools/render/candidate_views.hpp"
#include "tools/render/chosen_view_item.hpp"
#include "tools/render/frontier_items.hpp"
#include "tools/render/panel_layout.hpp"
#include "tools/render/voxel_items.hpp"
#include "tools/run/words.hpp"
#include "tools/scene/looks.hpp"

namespace gnbv {
namespace {

constexpr float kUnknownVoxelsOpacity = 0.35F;

void add_pin(const ViewPose& view, double length_m, double radius_m, const Rgb& colour,
             RenderScene& scene) {
  scene.tubes.push_back({{view.p_world_m.cast<float>(), pin_end(view, length_m).cast<float>()},
                         {colour},
                         static_cast<float>(radius_m)});
}

// "24 candidates around frontiers (0 valid), 80 of the grid (31 valid)"
std::string counts_by_sampler(const Plan& plan) {
  struct Tally {
    std::size_t all = 0;
    std::size_t valid = 0;
  };
  std::map<Sampler, Tally> tallies;
  for (const Candidate& candidate : plan.candidates) {
    Tally& tally = tallies[candidate.sampler];
    ++tally.all;
    tally.valid += candidate.rejected ? 0 : 1;
  }
  std::string words;
  for (const auto& [sampler, tally] : tallies) {
    if (!traits_of(sampler).is_scored) continue;
    words +=
        fmt::format("{} {} ({} valid)",
                    words.empty() ? counted(tally.all, "candidate") : ", " + grouped(tally.all),
                    traits_of(sampler).words, grouped(tally.valid));
  }
  return words.empty() ? counted(plan.candidates.size(), "candidate") : words;
}

// A pin each, in their order: with the ball where it stands for those that are valid, small and at
// its other end for those rejected, since at one place views may look in several directions.
void add_candidates(const Plan& plan, const CandidateTally& all, double unit_m,
                    RenderScene& scene) {
  for (const Candidate& candidate : plan.candidates) {
    if (candidate.rejected) {
      const Rgb colour = rejection_looks()[static_cast<std::size_t>(*candidate.rejected)].rgb();
      add_pin(candidate.view, kRejectedPin * unit_m, 1.4 * unit_m, colour, scene);
      scene.balls.push_back(
          {scene.tubes.back().points_m.back(), static_cast<float>(kRejectedBall * unit_m), colour});
      continue;
    }
    const Rgb colour = colour_of_score(all, candidate.score.value);
    add_pin(candidate.view, 19.0 * unit_m, 2.4 * unit_m, colour, scene);
    scene.balls.push_back(
        {candidate.view.p_world_m.cast<float>(), static_cast<float>(kValidBall * unit_m), colour});
  }
}

// The map, as pale as it can be; its cubes take that share of their voxels' edges. Whether unknown
// ones can be seen from there.
bool add_map(RunSource& run, const OccupancyGrid& grid, double share, const RenderView& view,
             RenderScene& scene) {
  add_ground(run, scene);
  const std::vector<Rgb> grey = {kOccupiedVoxels};
  const SortedVoxels voxels = sort_voxels(grid);
  scene.surfaces.push_back(voxel_cubes(grid.geometry(), voxels.occupied, grey, share));
  scene.surfaces.push_back(free_faces(grid, voxels.unknown, kUnknownVoxels, kUnknownVoxelsOpacity));
  return is_seen(scene.surfaces.back(), grid, view);
}

Picture draw_candidates(RunSource& run, const PictureOptions& options, const RenderView& view) {
  const RunRecord& record = run.record();
  const std::size_t iteration = decision_asked(record, options);
  const ReplayedDecision& decision = run.decision(iteration);
  const Plan& plan = decision.plan;
  Picture picture{.panels = std::vector<Panel>(2)};
  Panel& far = picture.panels[0];
  Panel& near = picture.panels[1];
  if (!options.camera) {
    RenderScene chosen;
    add_chosen_view(record, run.world(), decision.belief, iteration, panel_unit_m(options, view),
                    chosen);
    near.view = near_view(record, iteration, chosen, view);
  }
  const RenderView& from_near = near.view ? *near.view : view;
  const std::array<PanelView, 2> panels = {
      {{view, panel_unit_m(options, view)}, {from_near, panel_unit_m(options, from_near)}}};
  const CandidateTally all = tally(plan, decision.belief.grid, panels);
  bool is_unknown_seen = false;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    Panel& panel = picture.panels[i];
    const auto& [seen_from, unit_m] = panels[i];
    // from near, gaps would be black lines
    is_unknown_seen |=
        add_map(run, decision.belief.grid, &panel == &near ? 1.0 : 0.94, seen_from, panel.scene);
    add_candidates(plan, all, unit_m, panel.scene);
    if (has_frontier_views(plan))
      add_frontiers(record.scenario.planner.fvs.frontier, decision, unit_m, seen_from, panel);
  }
  // numbers show through everything, and from near nothing asks for them
  if (!is_chosen_at_frontier(plan)) near.labels.clear();
  // farther, rays would smear their darkness over what they pass
  near.scene.hollow_m = decision.belief.grid.geometry().resolution_m();
  far.lines = near.lines = way_to_chosen(record, iteration);
  add_chosen_view(record, run.world(), decision.belief, iteration, panel_unit_m(options, from_near),
                  near.scene);
  far.note = note_on(plan, all);
  const double step_m = (record.views[iteration].decision.view.p_world_m -
                         record.views[iteration - 1].decision.view.p_world_m)
                            .norm();
  near.note = step_m < 0.005 ? "the chosen one, a turn where the view before was"
                             : fmt::format("the chosen one, {:.2g} m from the view before", step_m);
  // views are counted from 1 where people look, as on the page
  picture.detail =
      fmt::format("how view {} of {} (iteration {}) was chosen: from {}", grouped(iteration + 1),
                  grouped(record.views.size()), iteration, counts_by_sampler(plan));
  picture.legend =
      legend_of(plan, all, picture.panels, {decision.belief.grid, panels}, is_unknown_seen);
  return picture;
}

}  // namespace

const PictureKind kCandidatesPicture = {
    .name = "candidates",
    .shows = "candidate views of one decision, and rays of the chosen one (Figs. 2, 5, 6)",
    .panels = 2,
    .legend_rows = 3,
    .best_angles = angles_to_candidates,
    .frame = frame_candidates,
    .draw = draw_candidates};

}  // namespace gnbv
