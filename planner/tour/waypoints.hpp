// The waypoints of an open tour while a search changes it: what a further one would add, how their
// order is shortened, and which views a search takes out at random.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sim/core/rng.hpp"

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

  /// improve_tour(), the first waypoint being the start.
  void shorten(int kicks = 0);

 private:
  double leg_m(std::uint32_t from, std::uint32_t to) const { return (*row_m_)(from)[to]; }
  void find_rows();

  const RowOf* row_m_;
  std::vector<std::uint32_t> nodes_;
  std::vector<const float*> rows_m_;  // of each waypoint
  std::vector<float> extra_m_;        // of each node
  std::vector<std::int32_t> at_;      // of each node: where among the waypoints it would come
};

/// Symmetric distances between stops, each of which has its row.
using Distances = std::vector<std::vector<double>>;

/// Along the stops in their order.
double tour_length_m(const Distances& distances_m, const std::vector<std::size_t>& tour);

/// Shortens an open tour, whose first stop stays and whose end is free. It ends when neither
/// reversing a part (2-opt, Croes 1958) nor moving up to three neighbours elsewhere (Or-opt, Or
/// 1976) helps. Then it swaps two parts at random and improves again, `kicks` times, and keeps the
/// shorter of each two tours (iterated local search, Martin, Otto, Felten 1991: the double bridge).
/// Deterministic.
void improve_tour(const Distances& distances_m, std::vector<std::size_t>& tour, int kicks = 0);

/// What an iteration of a large-neighbourhood search takes out: 2 to 15 of the chosen views, at
/// random some in a row, the nearest of one, or any. `node_of`: of each view; `chosen` is not
/// empty.
std::vector<std::uint32_t> views_to_remove(std::span<const std::uint32_t> chosen,
                                           std::span<const std::uint32_t> node_of,
                                           const Waypoints& waypoints, const RowOf& row_m,
                                           Rng& rng);

/// Random factors of each view's gain per metre; every other time none. Without them the best view
/// always wins, and two views that a third one outbids are never tried together.
std::vector<double> perturbation_weights(std::size_t views, Rng& rng);

}  // namespace gnbv
