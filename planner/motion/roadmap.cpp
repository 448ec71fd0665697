#include "planner/motion/roadmap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/rng.hpp"

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
  for (int a = 0; a < 3; ++a) {
    const bool begins_low = a == 2;  // the lowest nodes see the undersides
    along_m_[a] = lattice_along_m(geometry, navigation_m.min()[a], navigation_m.max()[a], step_m_,
                                  begins_low);
    lattice_size_[a] = static_cast<std::int32_t>(along_m_[a].size());
  }
  for (const double z : along_m_[2]) {
    for (const double y : along_m_[1]) {
      for (const double x : along_m_[0]) p_world_m_.emplace_back(x, y, z);
    }
  }
}

Roadmap::Node Roadmap::add(const Vec3& p_world_m) {
  p_world_m_.push_back(geometry_.center_m(geometry_.key_of(geometry_.nearest_inside(p_world_m))));
  return static_cast<Node>(p_world_m_.size() - 1);
}

Roadmap::Node Roadmap::nearest(const Vec3& p_world_m) const {
  Key at;
  for (int a = 0; a < 3; ++a) {
    const std::vector<double>& along_m = along_m_[a];
    const auto first = along_m.begin();
    auto nearest = std::lower_bound(first, along_m.end() - 1, p_world_m[a]);
    if (nearest != first && p_world_m[a] - nearest[-1] < nearest[0] - p_world_m[a]) --nearest;
    at[a] = static_cast<std::int32_t>(nearest - first);
  }
  return lattice_node(at);
}

template <typename Ask>
bool Roadmap::KnownLines::is_open(Node from, Node to, const Ask& ask) {
  if (2 * used_ >= slots_.size()) grow();
  const std::uint64_t line = std::uint64_t{from} << 32 | (to + 1);
  std::uint64_t& slot = slots_[slot_of(line)];
  if (slot == 0) {
    slot = 2 * line + (ask() ? 1 : 0);
    ++used_;
  }
  return (slot & 1) != 0;
}

std::size_t Roadmap::KnownLines::slot_of(std::uint64_t line) const {
  const std::size_t last = slots_.size() - 1;  // a mask: their number is a power of 2
  std::size_t at = mix_bits(line) & last;
  while (slots_[at] != 0 && slots_[at] / 2 != line) at = (at + 1) & last;
  return at;
}

void Roadmap::KnownLines::grow() {
  constexpr std::size_t kFirst = 1 << 14;
  std::vector<std::uint64_t> known(std::max(kFirst, 2 * slots_.size()), 0);
  known.swap(slots_);
  for (const std::uint64_t slot : known) {
    if (slot != 0) slots_[slot_of(slot / 2)] = slot;
  }
}

void Roadmap::link(Node a, Node b) {
  if (is_open_[b] == 0 || !is_line_open(a, b)) return;
  legs_[a].push_back(b);
  legs_[b].push_back(a);
}

/// Each open node of the lattice with those of its 26 neighbours that are open.
void Roadmap::link_lattice(const HeedStop& stop) {
  const auto& n = lattice_size_;
  const KeyBox lattice = {{0, 0, 0}, {n[0] - 1, n[1] - 1, n[2] - 1}};
  for_each_key(lattice, [&](const Key& at) {
    const Node node = lattice_node(at);
    if (is_open_[node] == 0) return;
    heed(stop);
    for_each_key(keys_about(at), [&](const Key& to) {
      if (lattice.contains(to) && lattice_node(to) > node) link(node, lattice_node(to));
    });
  });
}

/// The nodes beside the lattice, and then here(), with all before them within a diagonal of the
/// lattice: sorted into cubes of that edge, of which the 27 about a node hold them all.
void Roadmap::link_others(const HeedStop& stop) {
  const double reach_m = 1.01 * std::sqrt(3.0) * step_m_;
  std::map<Key, std::vector<Node>> cubes;
  const auto link_to_near = [&](Node from) {
    heed(stop);
    std::vector<Node> near;
    for_each_key(keys_about(cube_of(p_world_m_[from], reach_m)), [&](const Key& cube) {
      const auto at = cubes.find(cube);
      if (at != cubes.end()) near.insert(near.end(), at->second.begin(), at->second.end());
    });
    std::sort(near.begin(), near.end());
    for (const Node to : near) {
      if ((p_world_m_[to] - p_world_m_[from]).squaredNorm() <= reach_m * reach_m) link(from, to);
    }
  };
  const Node lattice = lattice_node({0, 0, lattice_size_[2]});
  for (Node node = 1; node < size(); ++node) {
    if (is_open_[node] == 0) continue;
    if (node >= lattice) link_to_near(node);
    cubes[cube_of(p_world_m_[node], reach_m)].push_back(node);
  }
  link_to_near(here());
}

void Roadmap::follow(const FreeSpace& space, const OpenSpace& open, const Vec3& here_world_m,
                     const HeedStop& stop) {
  space_.emplace(space);
  open_ = &open;
  ++follows_;
  rows_.erase(here());
  lines_.forget();
  std::erase_if(rows_, [&](const auto& row) { return row.second.made + kRowFollows < follows_; });
  p_world_m_[here()] = here_world_m;
  is_open_.resize(size(), 0);
  opened_.resize(size(), 0);
  for (Node node = 1; node < size(); ++node) {
    const bool is_open = open.is_open(space.grid, geometry_.key_of(p_world_m_[node]));
    if (is_open && is_open_[node] == 0) opened_[node] = follows_;
    is_open_[node] = is_open ? 1 : 0;
  }
  legs_.assign(size(), {});
  link_lattice(stop);
  link_others(stop);
  reachable_.clear();
  const std::span<const float> from_here_m = row_m(here(), stop);
  for (Node node = 1; node < size(); ++node) {
    if (std::isfinite(from_here_m[node])) reachable_.push_back(node);
  }
}

/// Lazy Theta* (Nash, Koenig, Tovey 2010) from one node to all. A node is at first taken to be
/// reached straight from the node before its neighbour, across the lattice. Whether that line is
/// open is asked only once the search comes to the node; if not, the way leads over a leg.
struct Roadmap::LazyGraph {
  Roadmap& map;
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
    for (const Node next : map.legs_[node]) {
      if (ways.is_done[next] == 0) use(before, next, map.leg_m(before, next));
    }
  }
  bool may_fly(Node /*node*/, Node /*next*/) const { return true; }

 private:
  bool is_straight_from(Node before, Node node) const {
    if (before == node) return true;
    return map.leg_m(before, node) <= static_cast<float>(kLongestLegSteps * map.step_m_) &&
           map.lines_.is_open(before, node, [&] { return map.is_line_open(before, node); });
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

const Roadmap::Row& Roadmap::row(Node from, const HeedStop& stop) {
  auto at = rows_.find(from);
  if (at == rows_.end()) {
    Row made{.made = follows_, .followed = follows_};
    made.ways.grow(size());
    if (lines_of_ != space_->grid.updates()) lines_.forget();
    lines_of_ = space_->grid.updates();
    LazyGraph graph{*this, made.ways, from};
    find_ways(graph, from, made.ways, stop);
    at = rows_.emplace(from, std::move(made)).first;
  }
  if (at->second.followed < follows_) extend(at->second);
  return at->second;
}

std::vector<Vec3> Roadmap::via_world_m(Node from, Node to) {
  const Ways<float>& ways = row(from, {}).ways;
  return points_on_way(ways, from, ways.before[to], [&](Node node) { return p_world_m_[node]; });
}

}  // namespace gnbv
