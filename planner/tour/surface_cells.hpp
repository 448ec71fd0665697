// The surface as the tour sees it: cells with the plane that fits their points, and which of their
// small voxels hold a point already.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "sim/core/zeroed_array.hpp"

namespace gnbv {

/// Sums over points, relative to their cell's centre.
struct PointMoments {
  double count = 0.0;
  Vec3 sum_m = Vec3::Zero();
  Eigen::Matrix3d squares_m2 = Eigen::Matrix3d::Zero();

  void add(const Vec3& p_m);
  /// The other's, whose centre lies at `offset_m` from ours.
  void add(const PointMoments& other, const Vec3& offset_m);
};

/// A cube of kSide voxels of the detail along each edge, aligned with the world's lattice.
struct SurfaceCell {
  static constexpr int kSide = 4;

  Key key = {0, 0, 0};
  PointMoments moments;        // of its own points
  std::uint64_t covered = 0;   // voxels that hold a point, x fastest
  std::uint64_t expected = 0;  // voxels of which the plane crosses enough, or a bar's axis any
  bool has_plane = false;
  bool is_bar = false;       // the plane is one through the axis of a thin bar
  bool is_boundary = false;  // no plane: unknown space beside free and occupied, normal outwards
  Vec3f on_plane_m = Vec3f::Zero();  // the middle of what the plane has of the cell
  Vec3f normal = Vec3f::Zero();      // of no particular side, the same side for ever
  std::array<std::uint8_t, 2> observations = {0, 0};  // from the normal's side, and from the other
  std::vector<Vec3f> discs_m;                         // middles of discs that stand for the surface
  std::uint32_t changed = 0;  // in which add() what is expected of it last changed

  bool is_extrapolated() const { return moments.count == 0.0; }
};

/// A section counts as a voxel of the surface from this share of a face on, as it does in the
/// reference (a tenth) with a margin for the plane's error.
constexpr double kExpectedFaceShare = 0.3;

class SurfaceCells {
 public:
  /// Throws BadInput naming planner.tour.detail_m when its lattice does not fit the workspace.
  SurfaceCells(const Box3& workspace_m, double detail_m);

  /// Adds points, and fits again what they change. Cells beside those with points are extrapolated
  /// along the plane, but not into space that the map knows to be free. Points that lie along a
  /// line and on no plane are those of a thin bar.
  void add(std::span<const Vec3f> points_world_m, const OccupancyGrid& grid, int threads);
  /// Drops extrapolated cells that the map has found free, and finds the boundaries anew: unknown
  /// voxels beside free and occupied ones, where the cells expect nothing.
  void follow_map(const OccupancyGrid& grid);

  double edge_m() const { return lattice_.resolution_m(); }
  double detail_m() const { return detail_m_; }
  const GridGeometry& lattice() const { return lattice_; }
  std::span<const SurfaceCell> cells() const { return cells_; }
  /// Calls of add() so far.
  std::uint32_t updates() const { return updates_; }
  /// Of add() and follow_map() so far.
  std::uint64_t version() const { return version_; }
  void count_observation(std::uint32_t cell, std::size_t side);
  /// Centre of a voxel of the cell, by its bit.
  Vec3 voxel_center_m(const SurfaceCell& cell, int bit) const;

 private:
  std::uint32_t cell_at(const Key& key);
  const SurfaceCell* find(const Key& key) const;
  PointMoments moments_around(const Key& key) const;
  void fit(SurfaceCell& cell, const OccupancyGrid& grid) const;
  void expect_section(SurfaceCell& cell) const;
  void expect_bar(SurfaceCell& cell, const Vec3& axis) const;
  int bit_at(const Vec3& from_center_m) const;
  void place_discs(SurfaceCell& cell) const;
  void mark_boundary(const OccupancyGrid& grid, const Key& voxel);

  double detail_m_;
  GridGeometry lattice_;
  ZeroedArray<std::uint32_t> at_;  // of each cell of the lattice: 1 + index into cells_
  std::vector<SurfaceCell> cells_;
  std::uint32_t updates_ = 0;
  std::uint64_t version_ = 0;
};

}  // namespace gnbv
