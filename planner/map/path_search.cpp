#include "planner/map/path_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <set>

#include "planner/map/clearance.hpp"

namespace gnbv {
namespace {

using Node = std::array<int, 3>;  // steps from the start along the world axes

/// One search: the lattice, the map it lies in, and what has been reached.
class Search {
 public:
  Search(const OccupancyGrid& grid, const Box3& navigation_m, const Vec3& from_world_m,
         const Vec3& to_world_m, double radius_m, const NoFly& no_fly, bool allow_unknown)
      : grid_(grid),
        no_fly_(no_fly),
        navigation_m_(navigation_m),
        from_m_(from_world_m),
        to_m_(to_world_m),
        radius_m_(radius_m),
        allow_unknown_(allow_unknown),
        step_m_(std::max(radius_m, grid.geometry().resolution_m())) {}

  std::optional<std::vector<Vec3>> run(int max_expansions) {
    const Node start = {0, 0, 0};
    reached_[start] = {0.0, start};
    open_.push({(to_m_ - from_m_).norm(), 0, start});
    while (!open_.empty() && max_expansions-- > 0) {
      const Node node = open_.top().node;
      open_.pop();
      if (!closed_.insert(node).second) {
        ++max_expansions;  // found again on a longer way: no work done
        continue;
      }
      const Vec3 p_m = position_m(node);
      if ((to_m_ - p_m).norm() <= 2.0 * step_m_ && is_leg_clear(p_m, to_m_)) return way_to(node);
      expand(node, p_m);
    }
    return std::nullopt;
  }

 private:
  struct Open {
    double estimate_m;  // of the whole way by this node
    std::size_t order;
    Node node;
    bool operator<(const Open& other) const {  // the top of the queue is the least of all
      return estimate_m != other.estimate_m ? estimate_m > other.estimate_m : order > other.order;
    }
  };
  struct Reached {
    double length_m;
    Node before;
  };

  Vec3 position_m(const Node& node) const {
    return from_m_ + step_m_ * Vec3(node[0], node[1], node[2]);
  }

  bool is_leg_clear(const Vec3& a_m, const Vec3& b_m) const {
    constexpr double kRounding_m = 1e-6;
    return navigation_m_.squaredExteriorDistance(b_m) <= kRounding_m * kRounding_m &&
           no_fly_.allows_leg(a_m, b_m) && (allow_unknown_ || is_line_free(grid_, a_m, b_m)) &&
           is_path_clear(grid_, a_m, b_m, radius_m_);
  }

  void expand(const Node& node, const Vec3& p_m) {
    const double length_m = reached_.at(node).length_m;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          const Node next = {node[0] + dx, node[1] + dy, node[2] + dz};
          if (closed_.contains(next)) continue;
          const Vec3 next_m = position_m(next);
          const double next_length_m = length_m + (next_m - p_m).norm();
          const auto known = reached_.find(next);
          if (known != reached_.end() && known->second.length_m <= next_length_m) continue;
          if (!is_leg_clear(p_m, next_m)) continue;
          reached_[next] = {next_length_m, node};
          open_.push({next_length_m + (to_m_ - next_m).norm(), ++order_, next});
        }
      }
    }
  }

  /// The points from the start to the node without the start, straightened: from each point on to
  /// the farthest that it can reach.
  std::vector<Vec3> way_to(Node node) const {
    std::vector<Vec3> points_m = {to_m_};
    for (; node != Node{0, 0, 0}; node = reached_.at(node).before) {
      points_m.push_back(position_m(node));
    }
    points_m.push_back(from_m_);
    std::reverse(points_m.begin(), points_m.end());
    std::vector<Vec3> via_m;
    for (std::size_t at = 0; at + 1 < points_m.size();) {
      std::size_t next = points_m.size() - 1;
      while (next > at + 1 && !is_leg_clear(points_m[at], points_m[next])) --next;
      at = next;
      if (at + 1 < points_m.size()) via_m.push_back(points_m[at]);
    }
    return via_m;
  }

  const OccupancyGrid& grid_;
  const NoFly& no_fly_;
  Box3 navigation_m_;
  Vec3 from_m_, to_m_;
  double radius_m_;
  bool allow_unknown_;
  double step_m_;
  std::map<Node, Reached> reached_;
  std::set<Node> closed_;
  std::priority_queue<Open> open_;
  std::size_t order_ = 0;
};

}  // namespace

std::optional<std::vector<Vec3>> find_path(const PathSearchConfig& config,
                                           const OccupancyGrid& grid, const Box3& navigation_m,
                                           const Vec3& from_world_m, const Vec3& to_world_m,
                                           double radius_m, const NoFly& no_fly,
                                           bool allow_unknown) {
  return Search(grid, navigation_m, from_world_m, to_world_m, radius_m, no_fly, allow_unknown)
      .run(config.max_expansions);
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

}  // namespace gnbv
