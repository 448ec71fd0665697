#include "planner/tour/waypoints.hpp"

#include <numeric>

#include "planner/tour/short_tour.hpp"

namespace gnbv {

std::size_t Waypoints::index_of(std::uint32_t node) const {
  return static_cast<std::size_t>(std::find(nodes_.begin(), nodes_.end(), node) - nodes_.begin());
}

double Waypoints::length_m() const {
  double length_m = 0.0;
  for (std::size_t i = 1; i < nodes_.size(); ++i) length_m += leg_m(nodes_[i - 1], nodes_[i]);
  return length_m;
}

double Waypoints::saved_without_m(std::uint32_t node) const {
  const std::size_t at = index_of(node);
  const double to_m = leg_m(nodes_[at - 1], node);
  if (at + 1 == nodes_.size()) return to_m;
  return to_m + leg_m(node, nodes_[at + 1]) - leg_m(nodes_[at - 1], nodes_[at + 1]);
}

void Waypoints::remove(std::uint32_t node) {
  nodes_.erase(nodes_.begin() + static_cast<std::ptrdiff_t>(index_of(node)));
}

void Waypoints::find_rows() {
  rows_m_.clear();
  for (const std::uint32_t node : nodes_) rows_m_.push_back((*row_m_)(node).data());
}

/// A visit to node n between the waypoints a and b adds d(a, n) + d(n, b) - d(a, b); behind the
/// last one, z, it adds d(z, n). The least of these is kept, with where it comes. Each pass runs
/// over all nodes in memory order, so that it is vectorized.
void Waypoints::find_detours() {
  find_rows();
  const std::size_t nodes = (*row_m_)(nodes_.back()).size();
  least_m_.assign(rows_m_.back(), rows_m_.back() + nodes);
  at_.assign(nodes, static_cast<std::int32_t>(nodes_.size()));
  float* const least_m = least_m_.data();
  std::int32_t* const at = at_.data();
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    const float* const from_m = rows_m_[i - 1];
    const float way_m = from_m[nodes_[i]];
    const float leg_m = std::isfinite(way_m) ? way_m : 0.0F;
    const float* const to_m = rows_m_[i];
    for (std::size_t n = 0; n < nodes; ++n) {
      const float extra = from_m[n] + to_m[n] - leg_m;
      at[n] = extra < least_m[n] ? static_cast<std::int32_t>(i) : at[n];
      least_m[n] = std::min(extra, least_m[n]);
    }
  }
  extra_m_.resize(nodes);
  for (std::size_t n = 0; n < nodes; ++n) extra_m_[n] = std::max(least_m_[n], 0.0F);
  for (const std::uint32_t node : nodes_) extra_m_[node] = 0.0F;
}

void Waypoints::insert(std::uint32_t node) {
  nodes_.insert(nodes_.begin() + at_[node], node);
  find_detours();
}

/// The improvement needs ways that are as long both ways round, and that lead somewhere.
void Waypoints::shorten(int kicks) {
  constexpr float kNoWay_m = 1e6F;
  find_rows();
  Distances distance_m(nodes_.size(), std::vector<double>(nodes_.size()));
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      const float way_m = std::min(rows_m_[i][nodes_[j]], rows_m_[j][nodes_[i]]);
      distance_m[i][j] = static_cast<double>(std::min(way_m, kNoWay_m));
    }
  }
  std::vector<std::size_t> order(nodes_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  improve_tour_with_kicks(distance_m, order, kicks);
  std::vector<std::uint32_t> nodes;
  for (const std::size_t waypoint : order) nodes.push_back(nodes_[waypoint]);
  nodes_ = std::move(nodes);
}

}  // namespace gnbv
