#include "tools/scene/decision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "planner/guided/burst.hpp"
#include "tools/scene/flight.hpp"
#include "tools/scene/voxels.hpp"

namespace gnbv {
namespace {

constexpr double kRejectedPin = 12.0;  // layout units

/// The other end of a pin of that length, towards where the view looks.
Vec3 pin_end(const ViewPose& view, double length_m) {
  const Vec3 ahead(std::cos(view.gimbal_pitch_rad), 0.0, -std::sin(view.gimbal_pitch_rad));
  return view.p_world_m + length_m * (T_world_body(view).linear() * ahead);
}

constexpr int kRaysAcross = 9;
constexpr int kRaysDown = 7;

/// Where a ray's way through a box ends; 0 where it misses the box.
double exit_m(const Box3& box_m, const Vec3& from, const Vec3& along) {
  const Eigen::Array3d a_m = (box_m.min() - from).array() / along.array();
  const Eigen::Array3d b_m = (box_m.max() - from).array() / along.array();
  const double exit = a_m.max(b_m).minCoeff();
  return std::max(0.0, a_m.min(b_m).maxCoeff()) < exit ? exit : 0.0;
}

/// The ray up to the first occupied voxel or its end, in pieces through free voxels and through
/// unknown ones; nothing of one that neither ends on a surface nor meets unknown voxels.
void add_ray(const OccupancyGrid& grid, const Vec3& from, const Vec3& along, double length_m,
             double unit_m, RenderScene& scene) {
  const double step_m = 0.25 * grid.geometry().resolution_m();
  const std::size_t tubes_before = scene.tubes.size();
  bool says_something = false;
  double begin_m = 0.0;
  VoxelState state = grid.state_at(from);
  for (double end_m = 0.0; begin_m < length_m && state != VoxelState::occupied; end_m += step_m) {
    const bool is_last = end_m >= length_m;
    const VoxelState next = is_last ? state : grid.state_at(from + end_m * along);
    if (next == state && !is_last) continue;
    const Vec3 end = from + std::min(end_m, length_m) * along;
    const bool is_unknown = state == VoxelState::unknown;
    scene.add_line(from + begin_m * along, end, (is_unknown ? 1.6 : 1.2) * unit_m,
                   (is_unknown ? looks::kRayUnknown : looks::kRayFree).rgb());
    says_something = says_something || is_unknown || next == VoxelState::occupied;
    if (next == VoxelState::occupied) scene.add_ball(end, 4.0 * unit_m, looks::kRayHit.rgb());
    begin_m = end_m;
    state = next;
  }
  if (!says_something) scene.tubes.resize(tubes_before);
}

std::vector<Vec3> way_to(const RunRecord& record, std::size_t iteration) {
  const Decision& next = record.views[iteration].decision;
  std::vector<Vec3> way = {record.views[iteration - 1].decision.view.p_world_m};
  way.insert(way.end(), next.via_world_m.begin(), next.via_world_m.end());
  way.push_back(next.view.p_world_m);
  return way;
}

void add_lines(std::span<const Vec3> way, const Rgb& colour, double width,
               std::vector<PlaceLine>& lines) {
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    lines.push_back({way[i], way[i + 1], colour, width});
  }
}

// Rings through the views around a cluster that stand in one layer (Fig. 6), as far as they lie
// within the bounds.
void add_layers(const Plan& plan, std::span<const FrontierCluster> clusters, double unit_m,
                RenderScene& scene) {
  using Layer = std::pair<int, long>;  // cluster, and millimetre of height
  std::map<Layer, std::vector<const Candidate*>> layers;
  for (const Candidate& candidate : plan.candidates) {
    if (candidate.cluster < 0) continue;
    layers[{candidate.cluster, std::lround(1000.0 * candidate.view.p_world_m.z())}].push_back(
        &candidate);
  }
  for (auto& [layer, views] : layers) {
    const auto cluster = static_cast<std::size_t>(layer.first);
    if (cluster >= clusters.size() || views.size() < 3) continue;
    const Vec3& centre_m = clusters[cluster].centroid_world_m;
    const auto angle_rad = [&](const Candidate* candidate) {
      const Vec3 away_m = candidate->view.p_world_m - centre_m;
      return std::atan2(away_m.y(), away_m.x());
    };
    std::sort(views.begin(), views.end(),
              [&](const Candidate* a, const Candidate* b) { return angle_rad(a) < angle_rad(b); });
    for (std::size_t i = 0; i < views.size(); ++i) {
      const Candidate& a = *views[i];
      const Candidate& b = *views[(i + 1) % views.size()];
      const bool is_beyond =
          a.rejected == Rejection::out_of_bounds || b.rejected == Rejection::out_of_bounds;
      if (is_beyond) continue;
      scene.tubes.push_back(path_tube({a.view.p_world_m, b.view.p_world_m}, 0.5 * unit_m,
                                      looks::kFrontierLayer.rgb()));
    }
  }
}

}  // namespace

double worth_of(const Candidate& candidate) {
  return candidate.covers ? *candidate.covers : candidate.score.value;
}

ScoreRange scores_of(const Plan& plan) {
  ScoreRange scores;
  for (const Candidate& candidate : plan.candidates) {
    if (candidate.rejected) continue;
    const double score = worth_of(candidate);
    scores.low = scores.valid == 0 ? score : std::min(scores.low, score);
    scores.high = scores.valid == 0 ? score : std::max(scores.high, score);
    ++scores.valid;
  }
  return scores;
}

BallItem ball_of(const Candidate& candidate, const ScoreRange& scores, double unit_m) {
  if (candidate.rejected) {
    const auto reason = static_cast<std::size_t>(*candidate.rejected);
    return {pin_end(candidate.view, kRejectedPin * unit_m).cast<float>(),
            static_cast<float>(4.8 * unit_m), rejection_looks()[reason].rgb()};
  }
  const double range = std::max(scores.high - scores.low, 1e-12);
  return {candidate.view.p_world_m.cast<float>(), static_cast<float>(6.6 * unit_m),
          ramp(score_colours(), 1.0 - (scores.high - worth_of(candidate)) / range)};
}

void add_candidates(const Plan& plan, double unit_m, RenderScene& scene) {
  const ScoreRange scores = scores_of(plan);
  for (const Candidate& candidate : plan.candidates) {
    const BallItem& ball = scene.balls.emplace_back(ball_of(candidate, scores, unit_m));
    const double length_m = (candidate.rejected ? kRejectedPin : 19.0) * unit_m;
    scene.add_line(candidate.view.p_world_m, pin_end(candidate.view, length_m),
                   (candidate.rejected ? 1.4 : 2.4) * unit_m, ball.colour);
  }
}

bool has_frontier_views(const Plan& plan) {
  return std::any_of(plan.candidates.begin(), plan.candidates.end(),
                     [](const Candidate& candidate) { return candidate.cluster >= 0; });
}

void add_frontiers(const ReplayedDecision& decision, double unit_m, const RenderView& view,
                   Panel& panel) {
  RenderScene& scene = panel.scene;
  const Belief& belief = decision.belief;
  const Plan& plan = decision.plan;
  const std::vector<FrontierCluster>& clusters = plan.clusters;
  const auto add_cubes = [&](const std::vector<VoxelIndex>& voxels, const Look& look) {
    // a hair larger than the map's own cubes, which may be as large as their voxels
    constexpr double kOver = 1.02;
    if (voxels.empty()) return;
    scene.surfaces.push_back(
        voxel_cubes(belief.grid.geometry(), voxels, std::vector{look.rgb()}, kOver));
    if (plan.is_burst()) scene.surfaces.back().opacity = 0.4F;  // as the cubes of the map
  };
  int tried = -1;
  for (const Candidate& c : plan.candidates) tried = std::max(tried, c.cluster);
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const bool is_chosen = plan.looks_at(static_cast<int>(i));
    add_cubes(clusters[i].voxels, is_chosen ? looks::kLookedAt : looks::kFrontier);
    if (static_cast<int>(i) > tried) continue;
    const Vec3& centre_m = clusters[i].centroid_world_m;
    // the middle of a cluster may lie within the surface
    if (!shows(view, belief.grid, centre_m, 3.0 * belief.grid.geometry().resolution_m())) continue;
    panel.labels.insert(is_chosen ? panel.labels.begin() : panel.labels.end(),
                        {centre_m, fmt::format("{}{}", plan.is_burst() ? "cluster " : "", i + 1),
                         looks::kLookedAt.rgb()});
  }
  std::vector<VoxelIndex> others;
  std::ranges::set_difference(plan.frontier, voxels_of(clusters), std::back_inserter(others));
  add_cubes(others, looks::kFrontier);
  add_layers(plan, clusters, unit_m, scene);
}

Covered add_points_to_cover(const Scenario& scenario, const ReplayedDecision& decision,
                            double unit_m, RenderScene& scene) {
  const Belief& belief = decision.belief;
  const Plan& plan = decision.plan;
  const FvsConfig& fvs = scenario.planner.fvs;
  const std::vector<CameraModel> cameras = planner_model(scenario).sights;
  std::array<DotsItem, 2> dots;  // left, covered
  Covered out;
  for (std::size_t cluster = 0; cluster < plan.clusters.size(); ++cluster) {
    if (!plan.looks_at(static_cast<int>(cluster))) continue;
    const std::vector<Vec3f> points_m = points_around(fvs, belief.cloud, plan.clusters[cluster]);
    std::vector<bool> is_covered(points_m.size());
    for (const std::size_t kept : plan.chosen) {
      if (plan.candidates[kept].cluster != static_cast<int>(cluster)) continue;
      const std::vector<bool> seen =
          points_in_sight(fvs.culling, cameras, belief.grid, plan.candidates[kept].view, points_m);
      for (std::size_t i = 0; i < seen.size(); ++i) is_covered[i] = is_covered[i] || seen[i];
    }
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      dots[is_covered[i] ? 1 : 0].points_m.push_back(points_m[i]);
    }
    out.points += points_m.size();
  }
  out.covered = dots[1].points_m.size();
  for (DotsItem& item : dots) {
    item.colours = {(&item == &dots[1] ? looks::kCovered : looks::kNotCovered).rgb()};
    item.radius_m = static_cast<float>(1.6 * unit_m);
    if (!item.points_m.empty()) scene.dots.push_back(std::move(item));
  }
  return out;
}

void add_chosen_view(const RunRecord& record, const World& world, const Belief& belief,
                     std::size_t iteration, double unit_m, RenderScene& scene) {
  const ViewPose& view = record.views[iteration].decision.view;
  const double beside_m = 3.0 * belief.grid.geometry().resolution_m();
  Box3 near_m = bounds_m(world.structure);
  near_m = Box3(near_m.min().array() - beside_m, near_m.max().array() + beside_m);
  const std::vector<CameraConfig> sights = sights_of(record.scenario);
  add_view(sights, view, {.pyramid_m = 60.0 * unit_m, .edge_m = 1.3 * unit_m}, looks::kCamera.rgb(),
           scene);
  for (const CameraConfig& camera : sights) {
    const Isometry T_world_camera =
        frustum_of(camera, T_world_body(view), view.gimbal_pitch_rad, 1.0, {}).T_world_camera;
    const Vec3 eye = T_world_camera.translation();
    const CameraModel model = make_camera_model(camera);
    for (int row = 0; row < kRaysDown; ++row) {
      for (int column = 0; column < kRaysAcross; ++column) {
        const Eigen::Vector2d share((column + 0.5) / kRaysAcross, (row + 0.5) / kRaysDown);
        const Vec3 ahead =
            (model.sight.min() + share.cwiseProduct(model.sight.sizes())).homogeneous();
        if (!model.has_in_image(ahead)) continue;
        const Vec3 along = T_world_camera.linear() * ahead.normalized();
        const double length_m =
            std::min(camera.range_max_m * (model.is_radial() ? 1.0 : ahead.norm()),
                     exit_m(near_m, eye, along));
        add_ray(belief.grid, eye, along, length_m, unit_m, scene);
      }
    }
  }
}

std::vector<PlaceLine> way_to_chosen(const RunRecord& record, std::size_t iteration) {
  const Rgb chosen = looks::kChosen.rgb();
  const Rgb white = {1.0F, 1.0F, 1.0F};
  const std::vector<Vec3> way = way_to(record, iteration);
  std::vector<PlaceLine> lines = {{way.back(), way.back(), chosen, 14.0}};
  const std::size_t first = record.views[iteration].planned_at();
  for (std::size_t i = first; i < record.views.size(); ++i) {
    if (record.views[i].planned_at() != first) break;
    add_lines(way_to(record, i), chosen, i == iteration ? 2.4 : 1.0, lines);
  }
  lines.push_back({way.back(), way.back(), white, 6.0});
  // the smaller ring, uppermost: a way too short to be seen leaves one within the other
  lines.push_back({way.front(), way.front(), looks::kViewBefore.rgb(), 8.0});
  lines.push_back({way.front(), way.front(), white, 3.0});
  return lines;
}

void add_numbers_of_views(const Plan& plan, const Decision& now, Panel& panel) {
  if (plan.chosen.size() < 2) return;
  for (std::size_t i = 0; i < plan.chosen.size(); ++i) {
    const bool is_now = static_cast<int>(i) + 1 == now.plan_view;
    const Vec3& p_m = plan.candidates[plan.chosen[i]].view.p_world_m;
    panel.labels.insert(is_now ? panel.labels.begin() : panel.labels.end(),
                        {p_m, fmt::format("{}", i + 1), looks::kChosen.rgb()});
  }
}

}  // namespace gnbv
