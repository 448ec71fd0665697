// The surface as the tour sees it: cells with the plane that fits their points, and which of their
// small voxels hold a point already.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/motion/config.hpp"

namespace gnbv {

/// Area of the section of a cube by a plane of the unit normal at a distance from the cube's
/// centre. Of the unit cube it is the second difference of a truncated square along each axis of
/// the normal: sum over the corners s of (-1)^|s| max(0, t - s n)^2 / (2 n_x n_y n_z), where t is
/// the plane's distance from the lowest corner. Within a percent where a component of the normal
/// is below 0.01.
double plane_section_area(const Vec3& normal, double distance, double edge);

/// Sums over points, relative to their cell's centre.
struct PointMoments {
  double count = 0.0;
  double weight = 0.0;  // of all points; the sums below are of weighted ones
  Vec3 sum_m = Vec3::Zero();
  Eigen::Matrix3d squares_m2 = Eigen::Matrix3d::Zero();

  Vec3 mean_m() const { return sum_m / weight; }
  void add(const Vec3& p_m, double point_weight = 1.0);
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
  bool is_bar = false;         // the plane is one through the axis of a thin bar
  bool is_boundary = false;    // no plane: unknown space beside free and occupied, normal outwards
  Vec3f on_plane_m = Vec3f::Zero();  // the middle of what the plane has of the cell
  Vec3f normal = Vec3f::Zero();      // of no particular side, the same side for ever
  std::array<std::uint8_t, 2> observations = {0, 0};  // from the normal's side, and from the other
  std::vector<Vec3f> discs_m;                         // middles of discs that stand for the surface
  std::uint32_t changed = 0;  // in which version what is expected of it last did

  bool has_plane() const { return expected != 0; }
  bool is_extrapolated() const { return moments.count == 0.0; }
  /// How far a point lies off the plane, on the normal's side.
  double off_plane_m(const Vec3& p_m) const {
    const Vec3 n = normal.cast<double>();
    return n.dot(p_m - on_plane_m.cast<double>());
  }
};

/// Calls use(bit) for each voxel of a cell's mask, in ascending order.
template <typename Use>
void for_each_voxel(std::uint64_t mask, const Use& use) {
  for (; mask != 0; mask &= mask - 1) use(std::countr_zero(mask));
}

class SurfaceCells {
 public:
  /// Within this share of a small voxel's edge a point is accurate (score's accurate coverage).
  static constexpr double kNear = 0.2;

  /// Throws BadInput naming planner.tour.detail_m when its lattice does not fit the workspace.
  SurfaceCells(const Box3& workspace_m, double detail_m);

  /// Adds points, and fits again what they change. Cells beside those with points are extrapolated
  /// along the plane, but not into space that the map knows to be free. Points that lie along a
  /// line and on no plane are those of a thin bar. `covers`: whether the voxels with the points
  /// hold one from now on, or are only expected to. `certainty`: of each point, the probability
  /// that it lies within kNear of the surface; none given: all do. A point weighs as its square,
  /// the inverse of its variance, and covers as often as it lies there.
  void add(std::span<const Vec3f> points_world_m, const OccupancyGrid& grid, int threads,
           const HeedStop& stop = {}, bool covers = true, std::span<const float> certainty = {});
  /// Drops extrapolated cells that the map has found free, and finds the boundaries anew: unknown
  /// voxels beside free and occupied ones, where the cells expect nothing.
  void follow_map(const OccupancyGrid& grid);

  double edge_m() const { return lattice_.resolution_m(); }
  double detail_m() const { return detail_m_; }
  const GridGeometry& lattice() const { return lattice_; }
  std::span<const SurfaceCell> cells() const { return cells_; }
  /// Calls of add() and follow_map() so far.
  std::uint32_t version() const { return version_; }
  void count_observation(std::uint32_t cell, std::size_t side) {
    std::uint8_t& observations = cells_[cell].observations[side];
    if (observations < 0xff) ++observations;
  }
  /// Centre of a voxel of the cell, by its bit.
  Vec3 voxel_center_m(const SurfaceCell& cell, int bit) const;

 private:
  std::uint32_t cell_at(const Key& key);
  PointMoments moments_around(const Key& key) const;
  double noise_m(const SurfaceCell& cell) const;
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
  std::vector<std::uint32_t> to_fit_;  // what add() was stopped before
  std::uint32_t version_ = 0;
};

}  // namespace gnbv
