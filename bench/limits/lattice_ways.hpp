// Collision-free ways between legal viewpoints, by someone who knows where the structure is.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "bench/limits/legal_viewpoints.hpp"

namespace gnbv {

struct Way {
  double length_m = 0.0;
  std::vector<Vec3> via_world_m = {};  // points between the ends; none: straight
};

/// Ways from place to place. A place is a legal viewpoint by its index, or start() itself. Shortest
/// ways over the lattice's legs from a place are found once (Dijkstra 1959) and kept.
class LatticeWays {
 public:
  /// Keeps references to both.
  LatticeWays(const RayScene& scene, const LegalViewpoints& legal, double radius_m);

  std::size_t start() const { return legal_.size(); }
  const Vec3& p_world_m(std::size_t place) const;

  /// Finds what way() needs, from these places.
  void prepare(const std::vector<std::size_t>& from, int threads);

  /// Straight when that keeps the radius; else along the lattice from `from`, a prepared place, cut
  /// short where a leg between its points keeps the radius, too.
  Way way(std::size_t from, std::size_t to) const;

  /// From a place, prepared or not, to each of the others: the length of way() before it is cut
  /// short, straight only where that keeps the radius. Beyond 12 m a guess: straight, unless the
  /// lattice's way is so much longer that something must be in between.
  std::vector<float> distances_m(std::size_t from, std::span<const std::size_t> to,
                                 int threads) const;

 private:
  struct Tree {
    std::vector<double> length_m;
    std::vector<std::uint32_t> before;
  };
  struct Leg {
    std::uint32_t to = 0;
    double length_m = 0.0;
  };
  std::span<const Leg> legs_from(std::size_t place) const {
    return std::span(legs_).subspan(first_leg_[place], first_leg_[place + 1] - first_leg_[place]);
  }
  Tree grow(std::size_t from) const;
  double straight_m(std::size_t from, std::size_t to) const {
    return (p_world_m(to) - p_world_m(from)).norm();
  }
  bool is_straight_clear(std::size_t from, std::size_t to) const;

  const RayScene& scene_;
  const LegalViewpoints& legal_;
  double radius_m_;
  std::vector<Leg> legs_;               // from each place, the start's last
  std::vector<std::size_t> first_leg_;  // of each place, and the end of the last
  std::map<std::size_t, Tree> trees_;
};

}  // namespace gnbv
