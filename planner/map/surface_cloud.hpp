// What is believed about the surface: a leaf-filtered cloud with an exact, incremental density.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/map/grid_geometry.hpp"
#include "planner/map/leaf_filter.hpp"

namespace gnbv {

/// Defaults: the released filter sizes.
struct CloudConfig {
  double leaf_m = 0.02;         // RGBD points
  double profile_leaf_m = 0.1;  // LIDAR points
};

/// Points with at most one a leaf. Leaves are cubes [k leaf, (k + 1) leaf). A leaf gets the
/// centroid of the points that the first batch to reach it put there, and keeps it.
///
/// Density (paper section 2.1, Fig. 3): mean, over the cloud points in a voxel, of the number of
/// cloud points within r = voxel / sqrt(2), the point itself included. Counts are integers, kept
/// exact as points arrive: equal to a full recomputation at any time. "Within r" is the float32
/// comparison dx dx + dy dy + dz dz <= r r, which is the same from either point.
class SurfaceCloud {
 public:
  /// Throws BadInput naming leaf_m when it is not positive or less than a 64th of a voxel.
  SurfaceCloud(const CloudConfig& config, const GridGeometry& voxels);

  /// Adds one batch (a frame, a profile) through the leaf filter of `leaf_m`, then the cloud's own.
  /// Points outside the workspace are ignored. Returns how many points the cloud gained; they stand
  /// at the end of points_world_m(), in the order in which the batch first reached their leaves.
  std::size_t add(std::span<const Vec3f> points_world_m, double leaf_m);

  std::span<const Vec3f> points_world_m() const { return points_; }
  /// The voxels that hold points, in the order in which they got their first one.
  std::span<const VoxelIndex> voxels() const { return voxels_with_points_; }
  /// Points per voxel of the occupancy grid.
  std::uint32_t point_count(VoxelIndex v) const { return point_count_[v]; }
  /// Sum of the neighbour counts of the points in the voxel.
  std::uint64_t neighbour_sum(VoxelIndex v) const { return neighbour_sum_[v]; }
  /// Mean neighbour count of the points in the voxel; 0 without points.
  double density(VoxelIndex v) const {
    return point_count_[v] == 0
               ? 0.0
               : static_cast<double>(neighbour_sum_[v]) / static_cast<double>(point_count_[v]);
  }
  /// Density of a fully scanned plane: 3 (voxel / leaf)^2, the released normaliser.
  double density_max() const { return density_max_; }
  double search_radius_m() const { return search_radius_m_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr std::size_t kBlockPoints = 16;
  /// Points of one bucket, in columns for the distance loop; unused places lie at infinity.
  struct Block {
    std::array<float, kBlockPoints> x, y, z;
    std::array<VoxelIndex, kBlockPoints> voxel;
    std::uint32_t next = kNone;  // block of the same bucket
  };
  /// A cube of leaves_per_bucket_ leaves a side, at least a search radius wide.
  struct Bucket {
    std::uint32_t last_block = kNone;
    std::uint32_t last_count = 0;
    VoxelIndex voxel = 0;  // of all its points, if
    bool has_one_voxel = true;
  };
  struct Leaf {
    std::size_t bucket_cell;  // into bucket_at_
    std::uint32_t bit;        // into the bucket's mask
  };
  Leaf place_of(const LeafKey& leaf) const;
  bool is_taken(const Leaf& leaf) const;
  bool take(const Leaf& leaf);
  void insert(const Vec3f& p_m, const Leaf& leaf);
  std::uint64_t count_pairs(const Vec3f& p_m, const Bucket& bucket);
  void append(Bucket& bucket, const Vec3f& p_m, VoxelIndex voxel);

  CloudConfig config_;
  GridGeometry voxels_;
  LeafLattice lattice_;
  double density_max_ = 0.0;
  double search_radius_m_ = 0.0;
  float search_radius2_m2_ = 0.0F;
  std::vector<Vec3f> points_;
  std::vector<VoxelIndex> voxels_with_points_;
  std::vector<std::uint32_t> point_count_;
  std::vector<std::uint64_t> neighbour_sum_;

  std::int32_t leaves_per_bucket_ = 1;
  std::size_t words_per_bucket_ = 1;
  float bucket_m_ = 1.0F;
  LeafKey first_bucket_ = {0, 0, 0};
  std::array<std::int32_t, 3> bucket_cells_ = {0, 0, 0};
  std::vector<std::uint32_t> bucket_at_;  // dense over the workspace: index into buckets_
  std::vector<Bucket> buckets_;
  std::vector<std::uint64_t> taken_;  // words_per_bucket_ for each bucket, a bit a leaf
  std::vector<Block> blocks_;
  LeafSums batch_;
};

}  // namespace gnbv
