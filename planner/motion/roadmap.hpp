// Where views may be taken from, and the ways between those nodes.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "planner/motion/free_space.hpp"
#include "planner/motion/graph_search.hpp"

namespace gnbv {

/// A lattice in the navigation box, further nodes beside it, and where the vehicle is. The number
/// of a node stays its own for ever; that of here() moves with the vehicle.
class Roadmap {
 public:
  using Node = GraphNode;

  /// The lattice's nodes are middles of voxels, about `step_m` apart.
  Roadmap(const GridGeometry& geometry, const Box3& navigation_m, double step_m);

  /// One more node, off the lattice: the middle of the voxel at the point.
  Node add(const Vec3& p_world_m);

  /// Finds which nodes are open now and can be reached from `here_world_m`, and over which legs:
  /// those from there are asked of `space` itself, all others of `open`. Keeps references to `open`
  /// and to what `space` refers to. Rows are kept for some calls. They learn of nodes that have
  /// opened, but neither of shorter ways nor of what has closed.
  void follow(const FreeSpace& space, const OpenSpace& open, const Vec3& here_world_m,
              const HeedStop& stop = {});

  std::size_t size() const { return p_world_m_.size(); }
  static constexpr Node here() { return 0; }
  const Vec3& p_world_m(Node node) const { return p_world_m_[node]; }
  /// The node of the lattice, open or not, that is nearest to a point.
  Node nearest(const Vec3& p_world_m) const;
  /// Ascending, without here().
  std::span<const Node> reachable() const { return reachable_; }

  void forget_ways() { rows_.clear(); }

  /// Metres from the node to each one, along open space; infinite where no way leads. No way from
  /// elsewhere leads by here() or to it.
  std::span<const float> row_m(Node from, const HeedStop& stop = {}) {
    return row(from, stop).ways.length_m;
  }
  /// The points between the two; requires a way.
  std::vector<Vec3> via_world_m(Node from, Node to);

 private:
  /// Which lines between two nodes are open, as long as nothing changes: rows ask of four in five
  /// again.
  class KnownLines {
   public:
    void forget() {
      slots_.assign(slots_.size(), 0);
      used_ = 0;
    }
    /// What is known of the line; else what ask() says of it.
    template <typename Ask>
    bool is_open(Node from, Node to, const Ask& ask);

   private:
    void grow();
    /// Where the line is or would be.
    std::size_t slot_of(std::uint64_t line) const;

    std::vector<std::uint64_t> slots_;  // twice the line, and 1 more where it is open; 0: none
    std::size_t used_ = 0;
  };
  struct Row {
    Ways<float> ways = {};
    std::uint32_t made = 0;      // in which follow() it was searched,
    std::uint32_t followed = 0;  // and up to which it knows the nodes
  };
  struct LazyGraph;
  /// The lattice's nodes come after here(), by layers.
  Node lattice_node(const Key& at) const {
    return static_cast<Node>(1 + (at[2] * lattice_size_[1] + at[1]) * lattice_size_[0] + at[0]);
  }
  void link(Node a, Node b);
  void link_lattice(const HeedStop& stop);
  void link_others(const HeedStop& stop);
  /// The vehicle may be nearer to something than any node is.
  bool is_line_open(Node from, Node to) const {
    const Vec3& to_m = p_world_m_[to];
    return from == here() ? space_->is_leg_free(p_world_m_[from], to_m)
                          : open_->is_line_open(space_->grid, p_world_m_[from], to_m);
  }
  float leg_m(Node a, Node b) const {
    return static_cast<float>((p_world_m_[a] - p_world_m_[b]).norm());
  }
  const Row& row(Node from, const HeedStop& stop);
  void extend(Row& row) const;

  GridGeometry geometry_;
  double step_m_ = 0.0;
  std::array<std::vector<double>, 3> along_m_;  // of the lattice's nodes, ascending
  Key lattice_size_ = {0, 0, 0};
  std::vector<Vec3> p_world_m_;
  std::vector<std::uint8_t> is_open_;
  std::vector<std::uint32_t> opened_;    // in which follow() each did, last
  std::vector<std::vector<Node>> legs_;  // from each node
  std::vector<Node> reachable_;
  std::optional<FreeSpace> space_;  // of the last follow()
  const OpenSpace* open_ = nullptr;
  std::map<Node, Row> rows_;
  KnownLines lines_;
  std::uint64_t lines_of_ = 0;  // OccupancyGrid::updates()
  std::uint32_t follows_ = 0;
};

}  // namespace gnbv
