// Where views may be taken from, and the ways between those places.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/tour/open_space.hpp"

namespace gnbv {

/// A lattice in the navigation box, further places beside it, and where the vehicle is. The number
/// of a place stays its own for ever; that of here() moves with the vehicle.
class TourPlaces {
 public:
  using Place = std::uint32_t;
  static constexpr Place kNone = 0xffffffffU;

  /// The lattice's places are middles of voxels, about `step_m` apart.
  TourPlaces(const GridGeometry& geometry, const Box3& navigation_m, double step_m);

  /// One more place, off the lattice: the middle of the voxel at the point.
  Place add(const Vec3& p_world_m);

  /// Which places are open now and can be reached from `here_world_m`, and over which legs. Rows
  /// are kept for some calls: they learn of places that have opened, but not of shorter ways, and
  /// what has closed since may make them too short.
  void follow(const OccupancyGrid& grid, const OpenSpace& space, const Vec3& here_world_m);

  std::size_t size() const { return p_world_m_.size(); }
  static constexpr Place here() { return 0; }
  const Vec3& p_world_m(Place place) const { return p_world_m_[place]; }
  bool is_reachable(Place place) const { return is_reachable_[place] != 0; }

  void forget_ways() { rows_.clear(); }

  /// Metres from the place to each one, along free space; infinite where no way leads. No way from
  /// elsewhere leads by here() or to it.
  std::span<const float> row_m(Place from);
  /// The points between the two; requires a way.
  std::vector<Vec3> via_world_m(Place from, Place to);

 private:
  struct Row {
    std::vector<float> length_m;
    std::vector<Place> before;
    std::uint32_t made = 0;      // in which follow() it was searched,
    std::uint32_t followed = 0;  // and up to which it knows the places
  };
  void link(Place a, Place b);
  void link_all();
  const Row& row(Place from);
  Row search(Place from) const;
  void extend(Row& row) const;

  GridGeometry geometry_;
  double step_m_ = 0.0;
  std::array<std::int32_t, 3> lattice_size_ = {0, 0, 0};
  std::vector<Vec3> p_world_m_;
  std::vector<std::uint8_t> is_open_, is_reachable_;
  std::vector<std::uint32_t> opened_;     // in which follow() each did, last
  std::vector<std::vector<Place>> legs_;  // from each place
  const OccupancyGrid* grid_ = nullptr;   // of the last follow()
  const OpenSpace* space_ = nullptr;
  std::map<Place, Row> rows_;
  std::uint32_t follows_ = 0;
};

}  // namespace gnbv
