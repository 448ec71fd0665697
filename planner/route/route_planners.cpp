#include "planner/route/route_planners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// The centres of the occupied voxels, and the box around them.
std::pair<std::vector<Vec3>, Box3> known_structure(const OccupancyGrid& map) {
  std::vector<Vec3> centers_m;
  Box3 box_m;
  for (VoxelIndex v = 0; v < map.geometry().voxel_count(); ++v) {
    if (map.state(v) != VoxelState::occupied) continue;
    centers_m.push_back(map.geometry().center_m(map.geometry().key_at(v)));
    box_m.extend(centers_m.back());
  }
  return {std::move(centers_m), box_m};
}

/// The gimbal's pitch that looks most nearly in this direction; 0 without a gimbal.
double pitch_along(const CameraModel& camera, const Vec3& direction) {
  if (!camera.config.gimbal) return 0.0;
  return nearest_pitch_rad(*camera.config.gimbal,
                           std::atan2(-direction.z(), direction.head<2>().norm()));
}

/// Where the ray from `center` leaves the last ball of radius `standoff` around an obstacle.
double exit_m(const Vec3& center_m, const Vec3& direction, std::span<const Vec3> obstacles_m,
              double standoff_m) {
  double exit_m = standoff_m;
  for (const Vec3& obstacle_m : obstacles_m) {
    const Vec3 to_m = obstacle_m - center_m;
    const double along_m = to_m.dot(direction);
    const double across2_m2 = to_m.squaredNorm() - along_m * along_m;
    const double half2_m2 = standoff_m * standoff_m - across2_m2;
    if (half2_m2 > 0.0) exit_m = std::max(exit_m, along_m + std::sqrt(half2_m2));
  }
  return exit_m;
}

/// Reorders: each view is the nearest to the one before among those left.
void order_by_nearest(const Vec3& start_m, std::vector<ViewPose>& views) {
  Vec3 at_m = start_m;
  const auto is_nearer = [&](const ViewPose& a, const ViewPose& b) {
    return (a.p_world_m - at_m).squaredNorm() < (b.p_world_m - at_m).squaredNorm();
  };
  for (auto next = views.begin(); next != views.end(); ++next) {
    std::iter_swap(next, std::min_element(next, views.end(), is_nearer));
    at_m = next->p_world_m;
  }
}

/// Evenly spaced from `from` to `to`, both included, no farther apart than `step`.
std::vector<double> steps(double from, double to, double step) {
  const int count = std::max(1, static_cast<int>(std::ceil(std::fabs(to - from) / step - 1e-9)));
  std::vector<double> values;
  for (int i = 0; i <= count; ++i) values.push_back(from + (to - from) * i / count);
  return values;
}

/// Adds the row from the end that is nearer to where the views so far end.
void append_row(std::vector<ViewPose> row, const Vec3& start_m, std::vector<ViewPose>& views) {
  const Vec3 at_m = views.empty() ? start_m : views.back().p_world_m;
  if ((row.back().p_world_m - at_m).norm() < (row.front().p_world_m - at_m).norm()) {
    std::reverse(row.begin(), row.end());
  }
  views.insert(views.end(), row.begin(), row.end());
}

/// Views that were clamped to a corner of the navigation box may be the same.
std::vector<ViewPose> without_repetitions(std::vector<ViewPose> views) {
  views.erase(std::unique(views.begin(), views.end(), is_same_view), views.end());
  return views;
}

}  // namespace

// A Fibonacci lattice on the upper hemisphere: equal areas, golden angle between neighbours.
std::vector<ViewPose> lay_hemisphere(const RouteConfig& config, const PlannerModel& model,
                                     const OccupancyGrid& map, const ViewPose& start, int count) {
  const auto [obstacles_m, structure_m] = known_structure(map);
  if (obstacles_m.empty()) return {};
  const Vec3 center_m(structure_m.center().x(), structure_m.center().y(), structure_m.min().z());
  const Box3& box_m = model.navigation_m;
  std::vector<ViewPose> views;
  count = std::min(count, kMostLaidViews);
  for (int i = 0; i < count; ++i) {
    const double up = (i + 0.5) / count;
    const double bearing_rad = 2.0 * kPi * i / (std::numbers::phi * std::numbers::phi);
    const double level = std::sqrt(1.0 - up * up);
    const Vec3 direction(level * std::cos(bearing_rad), level * std::sin(bearing_rad), up);
    const Vec3 p_m =
        center_m + exit_m(center_m, direction, obstacles_m, config.standoff_m) * direction;
    const Vec3 inside_m = p_m.cwiseMax(box_m.min()).cwiseMin(box_m.max());
    const Vec3 inwards = center_m - inside_m;
    views.push_back({inside_m, std::atan2(inwards.y(), inwards.x()),
                     pitch_along(model.sights.front(), inwards)});
  }
  order_by_nearest(start.p_world_m, views);
  return without_repetitions(std::move(views));
}

// Rows on the four sides of the box around the structure, from the bottom up, and then above it.
std::vector<ViewPose> lay_lawnmower(const RouteConfig& config, const PlannerModel& model,
                                    const OccupancyGrid& map, const ViewPose& start,
                                    int /*count*/) {
  const auto [obstacles_m, structure_m] = known_structure(map);
  if (obstacles_m.empty()) return {};
  const CameraModel& camera = model.sights.front();
  const double across_m = 2.0 * config.standoff_m * (1.0 - config.overlap);
  // beside a sphere's rim there is nothing in range
  const double beside = camera.config.range_max_m / config.standoff_m;
  const double most = camera.is_radial() ? std::sqrt(std::max(0.01, beside * beside - 1.0)) : 1e9;
  const double column_m = across_m * std::min(most, 0.5 * camera.sight.sizes().x());
  const double row_m = across_m * std::min(most, 0.5 * camera.sight.sizes().y());
  const Vec3 margin_m = Vec3::Constant(config.standoff_m);
  const Box3 around_m = Box3(structure_m.min() - margin_m, structure_m.max() + margin_m)
                            .intersection(model.navigation_m);
  const Vec3 lo = around_m.min();
  const Vec3 hi = around_m.max();
  const double top_m = structure_m.max().z();
  const Vec3 size_m = hi - lo;
  const double rows = 2.0 * (size_m.x() + size_m.y() + 4.0 * column_m) / column_m *
                          ((top_m - lo.z()) / row_m + 2.0) +
                      (size_m.y() / column_m + 2.0) * (size_m.x() / row_m + 2.0);
  if (rows > kMostLaidViews) {
    throw BadInput(fmt::format(
        "planner.routes.standoff_m, planner.routes.overlap: rows at {} m with an overlap of {} are "
        "about {:.2g} views around this structure; at most {} are laid",
        config.standoff_m, config.overlap, rows, kMostLaidViews));
  }
  const std::array<Eigen::Vector2d, 5> corners = {
      {{lo.x(), lo.y()}, {hi.x(), lo.y()}, {hi.x(), hi.y()}, {lo.x(), hi.y()}, {lo.x(), lo.y()}}};
  std::vector<ViewPose> views;
  for (std::size_t side = 0; side < 4; ++side) {
    const Eigen::Vector2d& from = corners[side];
    const Eigen::Vector2d along = corners[side + 1] - from;
    const double inwards_rad = std::atan2(along.x(), -along.y());
    for (const double z_m : steps(lo.z(), top_m, row_m)) {
      std::vector<ViewPose> row;
      for (const double share : steps(0.0, 1.0, column_m / along.norm())) {
        const Eigen::Vector2d p = from + share * along;
        row.push_back({Vec3(p.x(), p.y(), std::min(z_m, hi.z())), inwards_rad,
                       pitch_along(camera, Vec3::UnitX())});
      }
      append_row(std::move(row), start.p_world_m, views);
    }
  }
  for (const double y_m : steps(hi.y(), lo.y(), column_m)) {
    std::vector<ViewPose> row;
    for (const double x_m : steps(lo.x(), hi.x(), row_m)) {
      row.push_back({Vec3(x_m, y_m, hi.z()), 0.0, pitch_along(camera, -Vec3::UnitZ())});
    }
    append_row(std::move(row), start.p_world_m, views);
  }
  return without_repetitions(std::move(views));
}

void RoutePlanner::begin(const Belief& profile, const ViewPose& start) {
  if (!route_.lay) return;
  route_.views = route_.lay(profile.grid, start);
  tried_ = 0;
}

/// Takes the first of the views left that may be flown to into the plan; all before it are
/// candidates with their reason of rejection.
void RoutePlanner::try_known(const Belief& belief, const History& history, const ViewPose& current,
                             const Scratch& scratch, Plan& plan) {
  const std::vector<ViewPose> recent =
      recent_views(history, route_.lay ? model_.validity.recent_poses : 0);
  ViewChecker checker(model_.validity_around, model_.navigation_m, model_.no_fly, belief.grid,
                      recent, current, [&scratch] { scratch.heed_stop(); });
  for (; !plan.has_view() && tried_ < route_.views.size(); ++tried_) {
    plan.candidates.push_back({.view = route_.views[tried_], .sampler = Sampler::route});
    check(checker, model_, plan.candidates.back());
    const std::optional<Rejection> rejected = plan.candidates.back().rejected;
    if (!rejected) choose(plan, plan.candidates.size() - 1, 1, 1);
    if (rejected && route_.on_refused) route_.on_refused(tried_, *rejected);
  }
}

/// Of the known views, then of those that are asked for.
Plan RoutePlanner::first_valid(const Belief& belief, const History& history,
                               const ViewPose& current, Scratch& scratch) {
  Plan plan;
  try_known(belief, history, current, scratch, plan);
  while (!plan.has_view() && route_.next_view) {
    const std::optional<ViewPose> view = route_.next_view();
    if (!view) break;
    route_.views.push_back(*view);
    try_known(belief, history, current, scratch, plan);
  }
  return plan;
}

Plan RoutePlanner::next(const Belief& belief, const History& history, const ViewPose& current,
                        Scratch& scratch) {
  Plan plan = first_valid(belief, history, current, scratch);
  if (route_.lay) return plan;
  const bool is_stopped = scratch.should_stop && scratch.should_stop();
  plan.end = is_stopped ? Termination::interrupted : Termination::route_flown;
  return plan;
}

Plan RoutePlanner::replay(std::span<const Decision> recorded, const Belief& belief,
                          const History& history, const ViewPose& current, Scratch& scratch) {
  const bool is_asked = static_cast<bool>(route_.next_view);
  if (route_.trusts_record && !is_asked) route_.views.push_back(recorded.front().view);
  const Plan plan = first_valid(belief, history, current, scratch);
  need_as_recorded(plan, recorded, history.decisions.size());
  return plan;
}

Plan KnownRoutePlanner::next(const Belief& belief, const History&, const ViewPose&,
                             Scratch& scratch) {
  Plan plan{.end = Termination::route_flown};
  if (ahead_.empty()) {
    ahead_ = route_(belief.cloud, [&scratch] { scratch.heed_stop(); });
    std::reverse(ahead_.begin(), ahead_.end());
  }
  if (ahead_.empty()) return plan;
  plan.views = {std::move(ahead_.back())};
  ahead_.pop_back();
  return plan;
}

Plan KnownRoutePlanner::replay(std::span<const Decision> recorded, const Belief& belief,
                               const History& history, const ViewPose& current, Scratch& scratch) {
  const Plan plan = next(belief, history, current, scratch);
  need_as_recorded(plan, recorded, history.decisions.size());
  return plan;
}

}  // namespace gnbv
