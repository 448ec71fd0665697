#include "planner/motion/paths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "planner/motion/graph_search.hpp"

namespace gnbv {
namespace {

/// The lattice of a search: through its start, or what of the navigation box is nearest to that. A
/// vehicle that hangs a millimetre below the box would find its whole level outside. Nodes are
/// numbered as they are met, the start 0.
class LatticeGraph {
 public:
  LatticeGraph(const PathSearchConfig& config, const FreeSpace& space, const Vec3& from_world_m,
               const Vec3& to_world_m)
      : space_(space),
        from_m_(from_world_m),
        inside_m_(
            from_world_m.cwiseMax(space.navigation_m.min()).cwiseMin(space.navigation_m.max())),
        to_m_(to_world_m),
        step_m_(std::max(space.radius_m, space.grid.geometry().resolution_m())),
        expansions_left_(limit(config)) {
    number_of({0, 0, 0});
  }

  bool has_ended_early() const { return expansions_left_ < 0; }
  std::optional<GraphNode> last() const { return last_; }
  Vec3 p_world_m(GraphNode node) const {
    if (node == 0) return from_m_;
    const Steps& at = steps_[node];
    return inside_m_ + step_m_ * Vec3(at[0], at[1], at[2]);
  }
  bool is_leg_free(const Vec3& a_m, const Vec3& b_m) const {
    return space_.contains(b_m) && space_.is_leg_free(a_m, b_m);
  }

  double rest_m(GraphNode node) const { return (to_m_ - p_world_m(node)).norm(); }
  std::uint64_t rank(GraphNode /*node*/) { return found_++; }
  AtNode come_to(GraphNode node, double /*found_m*/) {
    if (expansions_left_-- == 0) return AtNode::stop;
    const Vec3 p_m = p_world_m(node);
    if ((to_m_ - p_m).norm() > 2.0 * step_m_ || !is_leg_free(p_m, to_m_)) return AtNode::expand;
    last_ = node;
    return AtNode::stop;
  }
  template <typename Use>
  void visit(GraphNode node, const Use& use) {
    const Steps at = steps_[node];
    const Vec3 p_m = p_world_m(node);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          const GraphNode next = number_of({at[0] + dx, at[1] + dy, at[2] + dz});
          use(node, next, (p_world_m(next) - p_m).norm());
        }
      }
    }
  }
  bool may_fly(GraphNode a, GraphNode b) const { return is_leg_free(p_world_m(a), p_world_m(b)); }

 private:
  using Steps = std::array<int, 3>;  // from the start along the world axes

  /// PathSearchConfig::max_expansions in this box.
  int limit(const PathSearchConfig& config) const {
    constexpr double kNodes = 40000.0;  // 24 x 80 x 70 m at a step of 1.5 m
    constexpr double kMost = 1e9;
    const Vec3 steps = space_.navigation_m.sizes() / step_m_;
    return static_cast<int>(
        std::min(config.max_expansions * std::max(1.0, steps.prod() / kNodes), kMost));
  }
  GraphNode number_of(const Steps& steps) {
    const auto [at, is_new] = number_.try_emplace(steps, static_cast<GraphNode>(steps_.size()));
    if (is_new) steps_.push_back(steps);
    return at->second;
  }

  const FreeSpace& space_;
  const Vec3 from_m_, inside_m_, to_m_;  // the start, what of the box is nearest to it, the goal
  const double step_m_;
  int expansions_left_;
  std::optional<GraphNode> last_;  // from which the straight leg to the goal is free
  std::map<Steps, GraphNode> number_;
  std::vector<Steps> steps_;  // of each node
  std::uint64_t found_ = 0;
};

/// The start of a way (0), the corners of each box grown by the margin and pulled into the
/// navigation box, and the goal.
struct CornerGraph {
  std::vector<Vec3> points_m;
  std::function<bool(const Vec3&, const Vec3&)> is_clear;

  CornerGraph(const NoFly& no_fly, const Box3& navigation_m, const Vec3& from_m, const Vec3& to_m)
      : points_m({from_m}) {
    constexpr double kBeyondMargin = 1.001;  // the corners have to be allowed themselves
    const Vec3 margin_m = Vec3::Constant(kBeyondMargin * no_fly.margin_m + 1e-3);
    for (const Box3& box_m : no_fly.boxes_m) {
      const Box3 grown_m(box_m.min() - margin_m, box_m.max() + margin_m);
      for (int i = 0; i < 8; ++i) {
        const Vec3 corner_m = grown_m.corner(static_cast<Box3::CornerType>(i))
                                  .cwiseMax(navigation_m.min())
                                  .cwiseMin(navigation_m.max());
        if (no_fly.allows(corner_m)) points_m.push_back(corner_m);
      }
    }
    points_m.push_back(to_m);
  }
  GraphNode goal() const { return static_cast<GraphNode>(points_m.size() - 1); }

  double rest_m(GraphNode /*node*/) const { return 0.0; }
  std::uint64_t rank(GraphNode node) const { return node; }
  AtNode come_to(GraphNode node, double /*found_m*/) const {
    return node == goal() ? AtNode::stop : AtNode::expand;
  }
  template <typename Use>
  void visit(GraphNode node, const Use& use) const {
    for (GraphNode next = 1; next <= goal(); ++next) {
      use(node, next, (points_m[next] - points_m[node]).norm());
    }
  }
  bool may_fly(GraphNode a, GraphNode b) const { return is_clear(points_m[a], points_m[b]); }
};

}  // namespace

FoundPath find_path(const PathSearchConfig& config, const FreeSpace& space,
                    const Vec3& from_world_m, const Vec3& to_world_m, const HeedStop& stop) {
  LatticeGraph lattice(config, space, from_world_m, to_world_m);
  Ways<double> ways;
  find_ways(lattice, 0, ways, stop);
  if (!lattice.last()) {
    return {lattice.has_ended_early() ? Rejection::search_limit : Rejection::path_blocked};
  }
  std::vector<Vec3> points_m = points_on_way(
      ways, 0, *lattice.last(), [&](GraphNode node) { return lattice.p_world_m(node); });
  points_m.insert(points_m.begin(), from_world_m);
  points_m.push_back(to_world_m);
  FoundPath path;  // straightened: from each point on to the farthest that it can reach
  for (std::size_t at = 0, last = points_m.size() - 1; at < last;) {
    std::size_t next = last;
    while (next > at + 1 && !lattice.is_leg_free(points_m[at], points_m[next])) --next;
    if (next < last) path.via_world_m.push_back(points_m[next]);
    at = next;
  }
  return path;
}

std::optional<std::vector<Vec3>> way_around(
    const NoFly& no_fly, const Box3& navigation_m, const Vec3& from_world_m, const Vec3& to_world_m,
    const std::function<bool(const Vec3&, const Vec3&)>& is_clear) {
  CornerGraph corners(no_fly, navigation_m, from_world_m, to_world_m);
  corners.is_clear = [&](const Vec3& a_m, const Vec3& b_m) {
    return no_fly.allows_leg(a_m, b_m) && (!is_clear || is_clear(a_m, b_m));
  };
  if (corners.is_clear(from_world_m, to_world_m)) return std::vector<Vec3>{};
  Ways<double> ways;
  ways.grow(corners.points_m.size());
  find_ways(corners, 0, ways, {});
  if (ways.before[corners.goal()] == kNoNode) return std::nullopt;
  return points_on_way(ways, 0, ways.before[corners.goal()],
                       [&](GraphNode node) { return corners.points_m[node]; });
}

double path_length_m(const Vec3& from_world_m, std::span<const Vec3> via_world_m,
                     const Vec3& to_world_m) {
  double length_m = 0.0;
  Vec3 at_m = from_world_m;
  for (const Vec3& next_m : via_world_m) {
    length_m += (next_m - at_m).norm();
    at_m = next_m;
  }
  return length_m + (to_world_m - at_m).norm();
}

bool ViewChecker::is_recent(const ViewPose& view) const {
  return std::any_of(recent_.begin(), recent_.end(), [&](const ViewPose& pose) {
    return (pose.p_world_m - view.p_world_m).norm() < config_.recent_distance_m &&
           std::fabs(wrap_angle_rad(pose.yaw_rad - view.yaw_rad)) < config_.recent_yaw_rad &&
           std::fabs(pose.gimbal_pitch_rad - view.gimbal_pitch_rad) < config_.recent_yaw_rad;
  });
}

std::optional<Rejection> ViewChecker::rejection_there(const ViewPose& view) const {
  if (is_recent(view)) return Rejection::recently_visited;
  return space_.rejection_at(view.p_world_m, current_.p_world_m);
}

FoundPath ViewChecker::path_to(const Vec3& p_world_m) const {
  const Vec3& from_m = current_.p_world_m;
  if (const auto rejected = space_.rejection_at(p_world_m, from_m)) return {rejected};
  if (config_.path == PathCheck::astar) {
    if (space_.is_leg_free(from_m, p_world_m)) return {};
    return find_path(config_.path_search, space_, from_m, p_world_m, stop_);
  }
  const bool is_clear = config_.path == PathCheck::straight
                            ? space_.is_leg_clear(from_m, p_world_m)
                            : space_.no_fly.allows_leg(from_m, p_world_m);
  return is_clear ? FoundPath{} : FoundPath{Rejection::path_blocked};
}

FoundPath ViewChecker::check(const ViewPose& view) {
  if (is_recent(view)) return {Rejection::recently_visited};
  if (checked_m_ != view.p_world_m) {
    checked_m_ = view.p_world_m;
    at_position_ = path_to(view.p_world_m);
  }
  return at_position_;
}

}  // namespace gnbv
