// One decision: the views that were sampled, why they were rejected or how they scored, and what
// the chosen one looks at (Figures 2, 5 and 6 of the paper).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "planner/map/frontiers.hpp"
#include "sim/core/error.hpp"
#include "tools/render/flight_items.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/voxel_items.hpp"

namespace gnbv {
namespace {

const Rgb kMap = srgb(0xb9c4d0);
const Rgb kFrontier = srgb(0x56b4e9);
const Rgb kLookedAt = srgb(0x0b5fa5);
const Rgb kChosen = srgb(0xd5420a);
const Rgb kRayFree = srgb(0xf0a35e);
const Rgb kRayUnknown = srgb(0x6d7683);
constexpr int kRaysAcross = 9;
constexpr int kRaysDown = 7;

struct Reason {
  Rejection rejection;
  std::string_view words;
  Rgb colour;
};

// Dark and muted: rejected views are context.
constexpr std::size_t kReasons = 10;
const std::array<Reason, kReasons>& reasons() {
  static const std::array<Reason, kReasons> all = {
      {{Rejection::out_of_bounds, "out of bounds", srgb(0x9aa3ae)},
       {Rejection::not_free, "not free", srgb(0x2f3640)},
       {Rejection::collision, "collision", srgb(0xa3321f)},
       {Rejection::path_blocked, "path blocked", srgb(0x7a4f9a)},
       {Rejection::recently_visited, "visited", srgb(0x8c6d3f)},
       {Rejection::cluster_outside_fov, "cluster outside view", srgb(0x4f7f86)},
       {Rejection::cluster_hidden, "cluster hidden", srgb(0x3f5b8c)},
       {Rejection::sees_no_surface, "sees no surface", srgb(0x6f8f2a)},
       {Rejection::no_fly, "no-fly box", srgb(0xb03a6b)},
       {Rejection::beyond_gimbal, "beyond the gimbal", srgb(0x8a5a6a)}}};
  return all;
}

std::size_t iteration_asked(const RunRecord& record, const PictureOptions& options) {
  const std::size_t iteration = iteration_of(record, options, record.views.size() / 2);
  if (iteration > 0) return iteration;
  throw BadInput(
      fmt::format("{}: view 0 is where the mission starts: nothing chose it; --iteration "
                  "asks for one from 1 on",
                  record.folder.string()));
}

/// How far a camera's view is drawn: to its range, but not far beyond a small structure.
double reach_m(const World& world, const CameraConfig& camera, const ViewPose& view) {
  const Box3 box_m = bounds_m(world.structure);
  const Vec3 half_m = 0.5 * box_m.sizes();
  const Vec3 away_m = (view.p_world_m - box_m.center()).cwiseAbs() + half_m;  // farthest corner
  return std::min(camera.range_max_m, 1.2 * away_m.norm());
}

void frame_candidates(RunSource& run, const PictureOptions& options,
                      std::vector<Vec3>& points_world_m) {
  const RunRecord& record = run.record();
  const std::size_t iteration = iteration_asked(record, options);
  for (const Candidate& candidate : run.decision(iteration).plan.candidates) {
    if (!candidate.rejected) points_world_m.push_back(candidate.view.p_world_m);
  }
  const ViewPose& chosen = record.views[iteration].decision.view;
  points_world_m.push_back(record.views[iteration - 1].decision.view.p_world_m);
  points_world_m.push_back(chosen.p_world_m);
  for (const CameraConfig& camera : record.scenario.cameras) {
    const FrustumItem f = frustum_of(camera, T_world_body(chosen), chosen.gimbal_pitch_rad,
                                     reach_m(run.world(), camera, chosen), kChosen);
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        const Vec3 corner(x * std::tan(0.5 * f.fov_x_rad), y * std::tan(0.5 * f.fov_y_rad), 1.0);
        points_world_m.push_back(f.T_world_camera * (f.length_m * corner));
      }
    }
  }
}

// A ray up to the first occupied voxel: where it runs through unknown ones it is grey.
void add_ray(const OccupancyGrid& grid, const Vec3& from, const Vec3& to, double unit_m,
             RenderScene& scene) {
  const double length_m = (to - from).norm();
  const double step_m = 0.25 * grid.geometry().resolution_m();
  const Vec3 along = (to - from) / length_m;
  VoxelState state = grid.state_at(from);
  Vec3 begin = from;
  bool is_hit = false;
  double t = 0.0;
  const auto end_piece = [&](const Vec3& end) {
    const Rgb& colour = state == VoxelState::unknown ? kRayUnknown : kRayFree;
    scene.tubes.push_back(
        {{begin.cast<float>(), end.cast<float>()}, {colour}, static_cast<float>(0.8 * unit_m)});
    begin = end;
  };
  for (; t < length_m && !is_hit; t += step_m) {
    const VoxelState next = grid.state_at(from + t * along);
    is_hit = next == VoxelState::occupied;
    if (next != state) end_piece(from + t * along);
    state = next;
  }
  if (!is_hit) end_piece(to);
  if (is_hit) {
    scene.balls.push_back({begin.cast<float>(), static_cast<float>(2.6 * unit_m), kChosen});
  }
}

void add_chosen(const RunRecord& record, const World& world, const Belief& belief,
                std::size_t iteration, double unit_m, RenderScene& scene) {
  const ViewPose& view = record.views[iteration].decision.view;
  for (const CameraConfig& camera : record.scenario.cameras) {
    const double length_m = reach_m(world, camera, view);
    FrustumItem frustum =
        frustum_of(camera, T_world_body(view), view.gimbal_pitch_rad, length_m, kChosen);
    frustum.edge_radius_m = static_cast<float>(1.2 * unit_m);
    frustum.face_opacity = 0.06F;
    scene.frusta.push_back(frustum);
    for (int row = 0; row < kRaysDown; ++row) {
      for (int column = 0; column < kRaysAcross; ++column) {
        const double x = 2.0 * (column + 0.5) / kRaysAcross - 1.0;
        const double y = 2.0 * (row + 0.5) / kRaysDown - 1.0;
        const Vec3 end = length_m * Vec3(x * std::tan(0.5 * camera.fov_x_rad),
                                         y * std::tan(0.5 * camera.fov_y_rad), 1.0);
        add_ray(belief.grid, frustum.T_world_camera.translation(), frustum.T_world_camera * end,
                unit_m, scene);
      }
    }
  }
  // the way there
  std::vector<Vec3> way = {record.views[iteration - 1].decision.view.p_world_m};
  const auto& via = record.views[iteration].decision.via_world_m;
  way.insert(way.end(), via.begin(), via.end());
  way.push_back(view.p_world_m);
  scene.tubes.push_back(path_tube(way, 1.6 * unit_m, kChosen));
  scene.balls.push_back(
      {way.front().cast<float>(), static_cast<float>(6.0 * unit_m), srgb(0x14181e)});
  scene.balls.push_back({way.back().cast<float>(), static_cast<float>(7.0 * unit_m), kChosen});
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

// The clusters of density frontiers that an FVS decision looked at; the chosen one's stands out.
void add_frontiers(const RunRecord& record, const ReplayedDecision& decision, const ViewPose& from,
                   double unit_m, RenderScene& scene) {
  const Belief& belief = decision.belief;
  FrontierMarks marks(belief.grid.geometry().voxel_count());
  std::vector<FrontierCluster> clusters =
      find_frontiers(record.scenario.planner.fvs.frontier, belief.grid, belief.cloud, marks);
  std::stable_sort(clusters.begin(), clusters.end(), [&](const auto& a, const auto& b) {
    return (a.centroid_world_m - from.p_world_m).squaredNorm() <
           (b.centroid_world_m - from.p_world_m).squaredNorm();
  });
  const int chosen =
      decision.plan.chosen ? decision.plan.candidates[*decision.plan.chosen].cluster : -1;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const bool is_chosen = static_cast<int>(i) == chosen;
    const std::vector<Rgb> colour = {is_chosen ? kLookedAt : kFrontier};
    scene.surfaces.push_back(voxel_cubes(belief.grid.geometry(), clusters[i].voxels, colour, 0.96));
    scene.balls.push_back({clusters[i].centroid_world_m.cast<float>(),
                           static_cast<float>((is_chosen ? 6.0 : 3.5) * unit_m), colour.front()});
  }
}

struct Tally {
  std::array<std::size_t, kReasons> rejected{};
  std::size_t valid = 0;
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Tally tally(const Plan& plan) {
  Tally all;
  for (const Candidate& candidate : plan.candidates) {
    if (candidate.rejected) {
      ++all.rejected[static_cast<std::size_t>(*candidate.rejected)];
      continue;
    }
    ++all.valid;
    all.low = std::min(all.low, candidate.score.value);
    all.high = std::max(all.high, candidate.score.value);
  }
  return all;
}

void add_candidates(const Plan& plan, const Tally& all, double unit_m, RenderScene& scene) {
  const double span = std::max(all.high - all.low, 1e-12);
  for (const Candidate& candidate : plan.candidates) {
    if (candidate.rejected) {
      const Reason& reason = reasons()[static_cast<std::size_t>(*candidate.rejected)];
      add_pin(candidate.view, 12.0 * unit_m, 1.1 * unit_m, reason.colour, scene);
    } else {
      add_pin(candidate.view, 20.0 * unit_m, 2.4 * unit_m,
              amount_ramp((candidate.score.value - all.low) / span), scene);
    }
  }
}

std::vector<LegendItem> legend_of(const Tally& all, bool is_fvs) {
  std::vector<LegendItem> legend;
  for (const Reason& reason : reasons()) {
    const std::size_t count = all.rejected[static_cast<std::size_t>(reason.rejection)];
    if (count == 0) continue;
    legend.push_back(
        {fmt::format("{}: {}", reason.words, count), {reason.colour}, LegendItem::Mark::line});
  }
  if (all.valid > 0) {
    legend.push_back({.label = fmt::format("{:.4g}", all.high),
                      .colours = amount_colours(),
                      .label_before = fmt::format("{} valid, utility {:.4g}", all.valid, all.low)});
  }
  if (is_fvs) {
    legend.push_back({"frontier", {kFrontier}});
    legend.push_back({"cluster looked at", {kLookedAt}});
  }
  legend.push_back({"chosen view", {kChosen}, LegendItem::Mark::line});
  legend.push_back({"ray through free", {kRayFree}, LegendItem::Mark::line});
  legend.push_back({"through unknown", {kRayUnknown}, LegendItem::Mark::line});
  return legend;
}

Picture draw_candidates(RunSource& run, const PictureOptions& options, const RenderView& view) {
  const RunRecord& record = run.record();
  const std::size_t iteration = iteration_asked(record, options);
  const ReplayedDecision& decision = run.decision(iteration);
  const Decision& chosen = record.views[iteration].decision;
  const double unit_m = layout_unit_m(view);
  const bool is_fvs = chosen.sampler == "fvs";
  const Tally all = tally(decision.plan);
  Picture picture{.panels = std::vector<Panel>(1)};
  RenderScene& scene = picture.panels.front().scene;
  add_ground(run, scene);
  const std::vector<Rgb> grey = {kMap};
  scene.surfaces.push_back(voxel_cubes(decision.belief.grid.geometry(),
                                       sort_voxels(decision.belief.grid).occupied, grey, 0.94));
  if (is_fvs) {
    add_frontiers(record, decision, record.views[iteration - 1].decision.view, unit_m, scene);
  }
  add_candidates(decision.plan, all, unit_m, scene);
  add_chosen(record, run.world(), decision.belief, iteration, unit_m, scene);
  picture.detail = fmt::format(
      "decision {}: {} candidates by {}, {} valid, the chosen one scores {:.4g}", iteration,
      decision.plan.candidates.size(), chosen.sampler, all.valid, chosen.score.value);
  picture.legend = legend_of(all, is_fvs);
  return picture;
}

}  // namespace

const PictureKind kCandidatesPicture = {
    .name = "candidates",
    .shows = "candidate views of one decision, and rays of the chosen one (Figs. 2, 5, 6)",
    .legend_rows = 2,
    .frame = frame_candidates,
    .draw = draw_candidates};

}  // namespace gnbv
