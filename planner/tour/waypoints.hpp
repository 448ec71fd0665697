// The waypoints of an open tour while a search changes it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace gnbv {

/// Metres from this node to each node, the same both ways; infinite where no way leads.
using RowOf = std::function<std::span<const float>(std::uint32_t node)>;

/// Nodes of a roadmap in the order of the tour, each once, and what a further one would add.
/// Copied, it is a state to return to.
class Waypoints {
 public:
  /// Begins with these, the start first. Keeps a reference to the rows.
  Waypoints(std::vector<std::uint32_t> nodes, const RowOf& row_m)
      : row_m_(&row_m), nodes_(std::move(nodes)) {}
  Waypoints(std::vector<std::uint32_t> nodes, RowOf&& row_m) = delete;  // it would not live on

  const std::vector<std::uint32_t>& nodes() const { return nodes_; }
  /// Which of the tour it is; the number of all where it is none.
  std::size_t index_of(std::uint32_t node) const;
  bool has(std::uint32_t node) const { return index_of(node) < nodes_.size(); }
  double length_m() const;
  /// What the tour would be shorter without this waypoint, which is not the first.
  double saved_without_m(std::uint32_t node) const;
  void remove(std::uint32_t node);

  /// What a waypoint at each node would add at the cheapest position: 0 where there is one. As of
  /// the last find_detours().
  std::span<const float> extra_m() const { return extra_m_; }
  void find_detours();
  /// At the cheapest position as of the last find_detours(), and finds the detours of now.
  void insert(std::uint32_t node);

  /// 2-opt and Or-opt, with `kicks` in between (short_tour.hpp).
  void shorten(int kicks = 0);

 private:
  double leg_m(std::uint32_t from, std::uint32_t to) const {
    return static_cast<double>((*row_m_)(from)[to]);
  }
  void find_rows();

  const RowOf* row_m_;
  std::vector<std::uint32_t> nodes_;
  std::vector<const float*> rows_m_;  // of each waypoint
  std::vector<float> least_m_;        // of each node, less than nothing where ways are not shortest
  std::vector<float> extra_m_;        // the same, but never less than nothing
  std::vector<std::int32_t> at_;      // of each node: where among the waypoints it would come
};

}  // namespace gnbv
