#include "planner/motion/roadmap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnbv {
namespace {

constexpr double kLongestLegSteps = 4.0;  // of the lattice: longer ones take long to check
constexpr std::uint32_t kRowFollows = 6;  // that a row is kept for

/// Middles of voxels about a step apart along one axis.
std::vector<double> lattice_along_m(const GridGeometry& geometry, double low_m, double high_m,
                                    double step_m, bool begins_low) {
  const double voxel_m = geometry.resolution_m();
  if (high_m - low_m < voxel_m) {  // thinner than a voxel
    return {geometry.center_m(geometry.key_of(0.5 * (low_m + high_m)))};
  }
  std::vector<double> along_m;
  const double rest_m = std::fmod(high_m - low_m, step_m);
  for (double at_m = low_m + (begins_low ? 0.0 : 0.5 * rest_m); at_m <= high_m + 1e-9;
       at_m += step_m) {
    const double inside_m = std::clamp(at_m, low_m + 0.5 * voxel_m, high_m - 0.5 * voxel_m);
    along_m.push_back(geometry.center_m(geometry.key_of(inside_m)));
  }
  return along_m;
}

}  // namespace

Roadmap::Roadmap(const GridGeometry& geometry, const Box3& navigation_m, double step_m)
    : geometry_(geometry) {
  const double voxel_m = geometry.resolution_m();
  step_m_ = std::max(1.0, std::round(step_m / voxel_m)) * voxel_m;
  p_world_m_.push_back(navigation_m.center());  // here
  std::array<std::vector<double>, 3> along_m;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    // the lowest nodes see the undersides
    along_m[a] = lattice_along_m(geometry, navigation_m.min()[axis], navigation_m.max()[axis],
                                 step_m_, a == 2);
    lattice_size_[a] = static_cast<std::int32_t>(along_m[a].size());
  }
  for (const double z : along_m[2]) {
    for (const double y : along_m[1]) {
      for (const double x : along_m[0]) p_world_m_.emplace_back(x, y, z);
    }
  }
}

Roadmap::Node Roadmap::add(const Vec3& p_world_m) {
  p_world_m_.push_back(geometry_.center_m(geometry_.key_of(geometry_.nearest_inside(p_world_m))));
  return static_cast<Node>(p_world_m_.size() - 1);
}

void Roadmap::link(Node a, Node b) {
  if (is_open_[b] == 0 || !space_->is_line_open(*grid_, p_world_m_[a], p_world_m_[b])) return;
  legs_[a].push_back(b);
  legs_[b].push_back(a);
}

/// Each node of the lattice with those of its 26 neighbours that are open.
void Roadmap::link_lattice() {
  const auto& n = lattice_size_;
  const auto node = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    return static_cast<Node>(1 + (z * n[1] + y) * n[0] + x);
  };
  for (std::int32_t z = 0; z < n[2]; ++z) {
    for (std::int32_t y = 0; y < n[1]; ++y) {
      for (std::int32_t x = 0; x < n[0]; ++x) {
        if (is_open_[node(x, y, z)] == 0) continue;
        for (int to = 14; to < 27; ++to) {  // the 13 neighbours that come later
          const std::int32_t tx = x + to % 3 - 1;
          const std::int32_t ty = y + to / 3 % 3 - 1;
          const std::int32_t tz = z + to / 9 - 1;
          if (tx < 0 || ty < 0 || tx >= n[0] || ty >= n[1] || tz >= n[2]) continue;
          link(node(x, y, z), node(tx, ty, tz));
        }
      }
    }
  }
}

/// The nodes beside the lattice, and then here(), with all before them within a diagonal of the
/// lattice: sorted into cubes of that edge, of which the 27 about a node hold them all.
void Roadmap::link_others() {
  const double reach_m = 1.01 * std::sqrt(3.0) * step_m_;
  std::map<Key, std::vector<Node>> cubes;
  const auto cube_of = [&](const Vec3& p_m) {
    const Eigen::Vector3i at = (p_m / reach_m).array().floor().cast<int>();
    return Key{at.x(), at.y(), at.z()};
  };
  std::vector<Node> near;
  const auto link_to_near = [&](Node from) {
    near.clear();
    const Key cube = cube_of(p_world_m_[from]);
    for (int i = 0; i < 27; ++i) {
      const auto at =
          cubes.find({cube[0] + i % 3 - 1, cube[1] + i / 3 % 3 - 1, cube[2] + i / 9 - 1});
      if (at != cubes.end()) near.insert(near.end(), at->second.begin(), at->second.end());
    }
    std::sort(near.begin(), near.end());
    for (const Node to : near) {
      if ((p_world_m_[to] - p_world_m_[from]).squaredNorm() <= reach_m * reach_m) link(from, to);
    }
  };
  const auto lattice =
      static_cast<Node>(1 + lattice_size_[0] * lattice_size_[1] * lattice_size_[2]);
  for (Node node = 1; node < size(); ++node) {
    if (is_open_[node] == 0) continue;
    if (node >= lattice) link_to_near(node);
    cubes[cube_of(p_world_m_[node])].push_back(node);
  }
  link_to_near(here());
}

void Roadmap::find_reachable() {
  is_reachable_.assign(size(), 0);
  std::vector<Node> open = {here()};
  is_reachable_[here()] = 1;
  while (!open.empty()) {
    const Node node = open.back();
    open.pop_back();
    for (const Node next : legs_[node]) {
      if (is_reachable_[next] != 0) continue;
      is_reachable_[next] = 1;
      open.push_back(next);
    }
  }
}

void Roadmap::follow(const OccupancyGrid& grid, const OpenSpace& space, const Vec3& here_world_m) {
  grid_ = &grid;
  space_ = &space;
  ++follows_;
  rows_.erase(here());
  std::erase_if(rows_, [&](const auto& row) { return row.second.made + kRowFollows < follows_; });
  p_world_m_[here()] = here_world_m;
  is_open_.resize(size(), 0);
  opened_.resize(size(), 0);
  for (Node node = 1; node < size(); ++node) {
    const bool is_open = space.is_open(grid, geometry_.key_of(p_world_m_[node]));
    if (is_open && is_open_[node] == 0) opened_[node] = follows_;
    is_open_[node] = is_open ? 1 : 0;
  }
  legs_.assign(size(), {});
  link_lattice();
  link_others();
  find_reachable();
}

/// Lazy Theta* (Nash, Koenig, Tovey 2010) from one node to all: a way may cut across the lattice
/// wherever the straight line is open, which is asked once a node, when the node is reached. Until
/// then the way is taken to come straight from the node before the neighbour's own.
struct Roadmap::LazyGraph {
  const Roadmap& map;
  Ways<float>& ways;
  Node from;

  float rest_m(Node /*node*/) const { return 0.0F; }
  std::uint64_t rank(Node node) const { return node; }
  AtNode come_to(Node node, float found_m) const {
    if (!is_straight_from(ways.before[node], node)) {
      ways.length_m[node] = std::numeric_limits<float>::infinity();
      for (const Node near : map.legs_[node]) {
        if (ways.is_done[near] == 0) continue;
        const float by_m = ways.length_m[near] + map.leg_m(near, node);
        if (by_m >= ways.length_m[node]) continue;
        ways.length_m[node] = by_m;
        ways.before[node] = near;
      }
      if (ways.length_m[node] > found_m) return AtNode::put_back;
    }
    // here() moves on, while the row is kept
    return node == here() && from != here() ? AtNode::skip : AtNode::expand;
  }
  template <typename Use>
  void visit(Node node, const Use& use) const {
    const Node before = ways.before[node];
    for (const Node next : map.legs_[node]) use(before, next, map.leg_m(before, next));
  }
  bool may_fly(Node /*node*/, Node /*next*/) const { return true; }

 private:
  bool is_straight_from(Node before, Node node) const {
    if (before == node) return true;
    return map.leg_m(before, node) <= static_cast<float>(kLongestLegSteps * map.step_m_) &&
           map.space_->is_line_open(*map.grid_, map.p_world_m_[before], map.p_world_m_[node]);
  }
};

/// Adds ways to nodes that have opened since, over the legs to them.
void Roadmap::extend(Row& row) const {
  Ways<float>& ways = row.ways;
  ways.grow(size());
  for (bool has_more = true; has_more;) {
    has_more = false;
    for (Node node = 1; node < size(); ++node) {
      if (opened_[node] <= row.followed || is_open_[node] == 0) continue;
      for (const Node near : legs_[node]) {
        if (near == here()) continue;
        const float by_m = ways.length_m[near] + leg_m(near, node);
        if (by_m >= ways.length_m[node]) continue;
        ways.length_m[node] = by_m;
        ways.before[node] = near;
        has_more = true;
      }
    }
  }
  row.followed = follows_;
}

const Roadmap::Row& Roadmap::row(Node from) {
  const auto [at, is_new] = rows_.try_emplace(from);
  Row& row = at->second;
  if (is_new) {
    row.made = row.followed = follows_;
    row.ways.grow(size());
    LazyGraph graph{*this, row.ways, from};
    find_ways(graph, from, row.ways);
  }
  if (row.followed < follows_) extend(row);
  return row;
}

std::vector<Vec3> Roadmap::via_world_m(Node from, Node to) {
  std::vector<Vec3> via_m;
  for (const Node node : nodes_between(row(from).ways, from, to)) via_m.push_back(p_world_m_[node]);
  return via_m;
}

}  // namespace gnbv
