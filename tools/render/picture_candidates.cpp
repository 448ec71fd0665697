// One decision: the views that were sampled, why they were rejected or how they scored; and from
// near what the chosen one looks at (Figures 2, 5 and 6 of the paper).
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim/core/error.hpp"
#include "tools/render/candidate_legend.hpp"
#include "tools/render/chosen_view_item.hpp"
#include "tools/render/frontier_items.hpp"
#include "tools/render/panel_layout.hpp"
#include "tools/render/rejection_look.hpp"
#include "tools/render/voxel_items.hpp"
#include "tools/run_files/words.hpp"

namespace gnbv {
namespace {

const Rgb kMap = srgb(0xc4ccd6);
constexpr float kUnknownVoxelsOpacity = 0.35F;

std::size_t iteration_asked(const RunRecord& record, const PictureOptions& options) {
  const std::size_t iteration = iteration_of(record, options, record.views.size() / 2);
  if (iteration > 0) return iteration;
  throw BadInput(
      fmt::format("{}: view 0 is where the mission starts: nothing chose it; --iteration "
                  "asks for one from 1 on",
                  record.folder.string()));
}

/// The structure and what could be chosen from, not the pyramid: it reaches far beyond both.
void frame_candidates(RunSource& run, const PictureOptions& options,
                      std::vector<Vec3>& points_world_m) {
  const RunRecord& record = run.record();
  const std::size_t iteration = iteration_asked(record, options);
  frame_structure(run, points_world_m);
  // voxels stick out of the surface
  const double beside_m = record.scenario.planner.map.resolution_m;
  for (std::size_t i = points_world_m.size(); i-- > 0;) {
    for (const double side_m : {beside_m, -beside_m}) {
      points_world_m.push_back(points_world_m[i] + Vec3(side_m, side_m, 0.0));
      points_world_m.push_back(points_world_m[i] + Vec3(side_m, -side_m, 0.0));
    }
  }
  for (const Candidate& candidate : run.decision(iteration).plan.candidates) {
    // those beyond the bounds lie far around everything else
    if (candidate.rejected == Rejection::out_of_bounds) continue;
    points_world_m.push_back(candidate.view.p_world_m);
  }
  points_world_m.push_back(record.views[iteration - 1].decision.view.p_world_m);
  points_world_m.push_back(record.views[iteration].decision.view.p_world_m);
}

// A pin: where it stands, and which way it looks.
void add_pin(const ViewPose& view, double length_m, double radius_m, const Rgb& colour,
             RenderScene& scene) {
  const Vec3 ahead = T_world_body(view).linear() *
                     Vec3(std::cos(view.gimbal_pitch_rad), 0.0, -std::sin(view.gimbal_pitch_rad));
  scene.tubes.push_back(
      {{view.p_world_m.cast<float>(), (view.p_world_m + length_m * ahead).cast<float>()},
       {colour},
       static_cast<float>(radius_m)});
}

// "24 around frontiers (0 valid), 80 of the grid (31 valid)"
std::string counts_by_sampler(const Plan& plan) {
  std::string words;
  for (const auto& [sampler, name] :
       {std::pair<std::string_view, std::string_view>{"fvs", "around frontiers"},
        {"agvs", "of the grid"}}) {
    std::size_t all = 0;
    std::size_t valid = 0;
    for (const Candidate& candidate : plan.candidates) {
      if (candidate.sampler != sampler) continue;
      ++all;
      valid += candidate.rejected ? 0 : 1;
    }
    if (all == 0) continue;
    words += fmt::format("{}{} {} ({} valid)", words.empty() ? "" : ", ", grouped(all), name,
                         grouped(valid));
  }
  return words.empty() ? counted(plan.candidates.size(), "candidate") : words;
}

// A pin each, in their order: with the ball where it stands for those that are valid, small and at
// its other end for those rejected, since at one place views may look in several directions.
void add_candidates(const Plan& plan, const CandidateTally& all, double unit_m,
                    RenderScene& scene) {
  for (const Candidate& candidate : plan.candidates) {
    if (candidate.rejected) {
      const Rgb& colour = rejection_looks()[static_cast<std::size_t>(*candidate.rejected)].colour;
      add_pin(candidate.view, 11.0 * unit_m, 1.2 * unit_m, colour, scene);
      scene.balls.push_back(
          {scene.tubes.back().points_m.back(), static_cast<float>(3.8 * unit_m), colour});
      continue;
    }
    const Rgb colour = colour_of_score(all, candidate.score.value);
    add_pin(candidate.view, 18.0 * unit_m, 2.4 * unit_m, colour, scene);
    scene.balls.push_back(
        {candidate.view.p_world_m.cast<float>(), static_cast<float>(6.0 * unit_m), colour});
  }
}

// The map, as pale as it can be; its cubes take that share of their voxels' edges. Whether unknown
// ones can be seen from there.
bool add_map(RunSource& run, const OccupancyGrid& grid, double share, const RenderView& view,
             RenderScene& scene) {
  add_ground(run, scene);
  const std::vector<Rgb> grey = {kMap};
  const SortedVoxels voxels = sort_voxels(grid);
  scene.surfaces.push_back(voxel_cubes(grid.geometry(), voxels.occupied, grey, share));
  scene.surfaces.push_back(free_faces(grid, voxels.unknown, kUnknownVoxels, kUnknownVoxelsOpacity));
  return is_seen(scene.surfaces.back(), grid, view);
}

// How much of a length shows from there: 1 from beside it, 0 along it.
double shown_share(const Vec3& length_m, const ViewAngles& angles) {
  const Vec3 towards(std::cos(angles.azimuth_rad) * std::cos(angles.elevation_rad),
                     std::sin(angles.azimuth_rad) * std::cos(angles.elevation_rad),
                     std::sin(angles.elevation_rad));
  return length_m.norm() > 0.0 ? length_m.normalized().cross(towards).norm() : 1.0;
}

// From behind the chosen view and beside it, on the side of the picture's camera, but not from
// where the way there is seen end on.
ViewAngles near_angles(const ViewPose& chosen, const Vec3& way_m, const ViewAngles& picture) {
  constexpr double kShown = 0.6;
  ViewAngles best;
  double best_share = -1.0;
  for (const double beside_rad : {deg_to_rad(55.0), deg_to_rad(85.0), deg_to_rad(25.0)}) {
    std::array<double, 2> sides_rad = {chosen.yaw_rad + kPi + beside_rad,
                                       chosen.yaw_rad + kPi - beside_rad};
    const auto away_rad = [&](double azimuth_rad) {
      return std::abs(wrap_angle_rad(azimuth_rad - picture.azimuth_rad));
    };
    if (away_rad(sides_rad[1]) < away_rad(sides_rad[0])) std::swap(sides_rad[0], sides_rad[1]);
    for (const double azimuth_rad : sides_rad) {
      const ViewAngles angles{azimuth_rad, deg_to_rad(25.0)};
      const double share = std::min(kShown, shown_share(way_m, angles));
      if (share <= best_share) continue;
      best = angles;
      best_share = share;
    }
  }
  return best;
}

// From near_angles(): the view before, the chosen one, and where its rays end.
RenderView near_view(const RunRecord& record, std::size_t iteration, const PictureOptions& options,
                     const RenderScene& chosen, const RenderView& view) {
  const ViewPose& pose = record.views[iteration].decision.view;
  std::vector<Vec3> points_m = {record.views[iteration - 1].decision.view.p_world_m,
                                pose.p_world_m};
  for (const BallItem& ball : chosen.balls) points_m.push_back(ball.centre_m.cast<double>());
  for (const TubeItem& ray : chosen.tubes) points_m.push_back(ray.points_m.back().cast<double>());
  for (const FrustumItem& frustum : chosen.frusta) {  // the axis, and as much to its sides
    const double half_m = frustum.length_m * std::tan(0.5 * frustum.fov_x_rad);
    for (const double side_m : {-half_m, half_m}) {
      points_m.push_back(frustum.T_world_camera * Vec3(side_m, 0.0, frustum.length_m));
      points_m.push_back(frustum.T_world_camera * Vec3(0.0, side_m, frustum.length_m));
    }
  }
  const ViewAngles angles =
      near_angles(pose, points_m[1] - points_m[0], options.angles.value_or(ViewAngles{}));
  const FrameMargins margins{.left = 0.08, .right = 0.08, .top = 0.06, .bottom = 0.1};
  return frame_points(points_m, angles, view.width_px, view.height_px, margins);
}

Picture draw_candidates(RunSource& run, const PictureOptions& options, const RenderView& view) {
  const RunRecord& record = run.record();
  const std::size_t iteration = iteration_asked(record, options);
  const ReplayedDecision& decision = run.decision(iteration);
  const Plan& plan = decision.plan;
  Picture picture{.panels = std::vector<Panel>(2)};
  Panel& far = picture.panels[0];
  Panel& near = picture.panels[1];
  if (!options.camera) {
    RenderScene chosen;
    add_chosen_view(record, run.world(), decision.belief, iteration, panel_unit_m(options, view),
                    chosen);
    near.view = near_view(record, iteration, options, chosen, view);
  }
  const RenderView& from_near = near.view ? *near.view : view;
  const CandidateTally all = tally(plan, decision.belief.grid, std::array{view, from_near});
  bool is_unknown_seen = false;
  for (const auto& [panel, seen_from] : {std::pair{&far, &view}, {&near, &from_near}}) {
    const double unit_m = panel_unit_m(options, *seen_from);
    // from near, gaps would be black lines
    is_unknown_seen |=
        add_map(run, decision.belief.grid, panel == &near ? 1.0 : 0.94, *seen_from, panel->scene);
    add_candidates(plan, all, unit_m, panel->scene);
    if (has_frontier_views(plan))
      add_frontiers(record.scenario.planner.fvs.frontier, decision, unit_m, *seen_from, *panel);
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
  picture.detail =
      fmt::format("how iteration {} was chosen: candidates {}", iteration, counts_by_sampler(plan));
  picture.legend = legend_of(plan, all, picture.panels, is_unknown_seen);
  return picture;
}

}  // namespace

const PictureKind kCandidatesPicture = {
    .name = "candidates",
    .shows = "candidate views of one decision, and rays of the chosen one (Figs. 2, 5, 6)",
    .panels = 2,
    .legend_rows = 3,
    .frame = frame_candidates,
    .draw = draw_candidates};

}  // namespace gnbv
