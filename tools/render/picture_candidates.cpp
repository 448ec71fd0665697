// One decision: the views that were sampled, why they were rejected or how they scored; and from
// near what the chosen one looks at (Figures 2, 5 and 6 of the paper).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "sim/core/error.hpp"
#include "tools/render/chosen_view_item.hpp"
#include "tools/render/frontier_items.hpp"
#include "tools/render/panel_layout.hpp"
#include "tools/render/rejection_look.hpp"
#include "tools/render/voxel_items.hpp"
#include "tools/run_files/words.hpp"

namespace gnbv {
namespace {

const Rgb kMap = srgb(0xc4ccd6);
const Rgb kUnknownVoxels = srgb(0xffffff);
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

struct Tally {
  std::vector<std::size_t> rejected = std::vector<std::size_t>(rejection_looks().size());
  std::vector<std::size_t> rejected_beyond = rejected;  // the picture
  std::size_t valid = 0;
  std::size_t beyond = 0;  // of all
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

bool is_beyond(const RenderView& view, const Vec3& p_world_m) {
  const std::optional<Vec3> px = project(view, p_world_m);
  return !px || px->x() < 0.0 || px->y() < 0.0 || px->x() > view.width_px ||
         px->y() > view.height_px;
}

Tally tally(const Plan& plan, const RenderView& view) {
  Tally all;
  for (const Candidate& candidate : plan.candidates) {
    const std::size_t beyond = is_beyond(view, candidate.view.p_world_m) ? 1 : 0;
    all.beyond += beyond;
    if (candidate.rejected) {
      const auto reason = static_cast<std::size_t>(*candidate.rejected);
      ++all.rejected[reason];
      all.rejected_beyond[reason] += beyond;
      continue;
    }
    ++all.valid;
    all.low = std::min(all.low, candidate.score.value);
    all.high = std::max(all.high, candidate.score.value);
  }
  return all;
}

bool is_around_cluster(const Candidate& candidate) { return candidate.cluster >= 0; }

bool is_chosen_around_cluster(const Plan& plan) {
  return plan.chosen && is_around_cluster(plan.candidates[*plan.chosen]);
}

// A share of the way from the lowest score to the highest: where these are one, it is the highest.
Rgb colour_of_score(const Tally& all, double score) {
  return amount_ramp(1.0 - (all.high - score) / std::max(all.high - all.low, 1e-12));
}

// A ball each, in their order, small for those rejected; those that are valid also show where they
// look.
void add_candidates(const Plan& plan, const Tally& all, double unit_m, RenderScene& scene) {
  for (const Candidate& candidate : plan.candidates) {
    const Vec3f p_m = candidate.view.p_world_m.cast<float>();
    if (candidate.rejected) {
      const Rgb& colour = rejection_looks()[static_cast<std::size_t>(*candidate.rejected)].colour;
      scene.balls.push_back({p_m, static_cast<float>(4.2 * unit_m), colour});
      continue;
    }
    const Rgb colour = colour_of_score(all, candidate.score.value);
    scene.balls.push_back({p_m, static_cast<float>(6.0 * unit_m), colour});
    add_pin(candidate.view, 18.0 * unit_m, 2.4 * unit_m, colour, scene);
  }
}

// "104 candidates, 41 of them beyond the picture"
std::string note_on(const Plan& plan, const Tally& all) {
  const std::string count = counted(plan.candidates.size(), "candidate");
  if (all.beyond == 0) return count;
  return fmt::format("{}, {} of them beyond the picture", count, grouped(all.beyond));
}

// "valid: 31, utility" from a bar's low end to its high end; without a bar where all have one.
LegendItem legend_of_valid(const Tally& all) {
  if (all.low == all.high) {
    return {.label = fmt::format("valid: {}, utility {:.3g}", grouped(all.valid), all.high),
            .colours = {colour_of_score(all, all.high)},
            .mark = LegendItem::Mark::dot};
  }
  return {.label = fmt::format("{:.3g}, highest", all.high),
          .colours = amount_colours(),
          .label_before = fmt::format("valid: {}, utility {:.3g}", grouped(all.valid), all.low),
          .label_middle = fmt::format("{:.3g}", 0.5 * (all.low + all.high))};
}

std::vector<LegendItem> legend_of_rejected(const Tally& all) {
  std::vector<LegendItem> legend;
  for (const RejectionLook& look : rejection_looks()) {
    const auto reason = static_cast<std::size_t>(look.rejection);
    if (all.rejected[reason] == 0) continue;
    const bool is_seen = all.rejected_beyond[reason] < all.rejected[reason];
    legend.push_back({fmt::format("{}: {}{}", look.words, grouped(all.rejected[reason]),
                                  is_seen ? "" : " beyond the picture"),
                      {look.colour},
                      LegendItem::Mark::dot});
    if (legend.size() == 1) legend.front().label_before = "rejected:";
  }
  return legend;
}

// A row of those rejected, one of what could be chosen and is to be seen, one of the chosen view.
std::vector<LegendItem> legend_of(const Plan& plan, const Tally& all, bool has_layers) {
  std::vector<LegendItem> legend = legend_of_rejected(all);
  const std::size_t second = legend.size();
  if (all.valid > 0) legend.push_back(legend_of_valid(all));
  legend.push_back({"unknown", {kUnknownVoxels}});
  if (std::any_of(plan.candidates.begin(), plan.candidates.end(), is_around_cluster)) {
    legend.push_back({"frontier, clusters numbered as tried", {kFrontierLook.frontier}});
    if (is_chosen_around_cluster(plan))
      legend.push_back({"cluster looked at", {kFrontierLook.looked_at}});
    if (has_layers)
      legend.push_back({"views of a layer", {kFrontierLook.frontier}, LegendItem::Mark::line});
  }
  const std::size_t third = legend.size();
  legend.push_back({"chosen view", {kChosenLook.chosen}, LegendItem::Mark::ring});
  legend.push_back({"way there", {kChosenLook.chosen}, LegendItem::Mark::line});
  legend.push_back({"view before", {kChosenLook.before}, LegendItem::Mark::ring});
  legend.push_back({"pyramid", {kChosenLook.pyramid}, LegendItem::Mark::line});
  legend.push_back({"ray through free", {kChosenLook.ray_free}, LegendItem::Mark::line});
  legend.push_back({"through unknown", {kChosenLook.ray_unknown}, LegendItem::Mark::line});
  legend.push_back({"meets surface", {kChosenLook.hit}, LegendItem::Mark::dot});
  legend[second].begins_row = legend[third].begins_row = true;
  return legend;
}

// The map, as pale as it can be; its cubes take that share of their voxels' edges.
void add_map(RunSource& run, const OccupancyGrid& grid, double share, RenderScene& scene) {
  add_ground(run, scene);
  const std::vector<Rgb> grey = {kMap};
  const SortedVoxels voxels = sort_voxels(grid);
  scene.surfaces.push_back(voxel_cubes(grid.geometry(), voxels.occupied, grey, share));
  scene.surfaces.push_back(free_faces(grid, voxels.unknown, kUnknownVoxels, kUnknownVoxelsOpacity));
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
  const Tally all = tally(plan, view);
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
  bool has_layers = false;
  for (const auto& [panel, seen_from] : {std::pair{&far, &view}, {&near, &from_near}}) {
    const double unit_m = panel_unit_m(options, *seen_from);
    // from near, gaps would be black lines
    add_map(run, decision.belief.grid, panel == &near ? 1.0 : 0.94, panel->scene);
    add_candidates(plan, all, unit_m, panel->scene);
    if (std::none_of(plan.candidates.begin(), plan.candidates.end(), is_around_cluster)) continue;
    has_layers = add_frontiers(record.scenario.planner.fvs.frontier, decision, unit_m, *panel);
  }
  // numbers show through everything, and from near nothing asks for them
  if (!is_chosen_around_cluster(plan)) near.labels.clear();
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
  picture.legend = legend_of(plan, all, has_layers);
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
