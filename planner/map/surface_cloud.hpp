// What is believed about the surface: a leaf-filtered cloud with an exact, incremental density.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/map/grid_geometry.hpp"
#include "planner/map/scan_rays.hpp"
#include "sim/core/zeroed_array.hpp"

namespace gnbv {

using LeafKey = Key;

/// Cubes [k leaf, (k + 1) leaf). The float32 product is pcl::VoxelGrid's, so that a point on a
/// border falls into the same leaf.
class LeafLattice {
 public:
  explicit LeafLattice(double leaf_m) : inverse_leaf_(1.0F / static_cast<float>(leaf_m)) {}
  LeafKey key_of(const Vec3f& p_m) const {
    return {floor_to_int(p_m[0] * inverse_leaf_), floor_to_int(p_m[1] * inverse_leaf_),
            floor_to_int(p_m[2] * inverse_leaf_)};
  }
  float inverse_leaf_1_m() const { return inverse_leaf_; }

 private:
  float inverse_leaf_;
};

/// Sums of the points in each leaf of one batch. Memory is reused from batch to batch.
class LeafSums {
 public:
  void reset();
  /// Leaves keep the order in which they were first reached.
  void add(const LeafKey& leaf, const Vec3f& p_m);
  std::size_t size() const { return sums_.size(); }
  const LeafKey& leaf(std::size_t i) const { return sums_[i].leaf; }
  /// Never outside the leaf: the mean of float32 numbers of an interval rounds into it.
  Vec3f centroid_m(std::size_t i) const {
    return (sums_[i].sum_m / static_cast<double>(sums_[i].count)).cast<float>();
  }
  std::vector<Vec3f> centroids_m() const;

 private:
  struct Sum {
    LeafKey leaf;
    std::uint32_t count;
    Vec3 sum_m;
  };
  std::uint32_t& slot_of(const LeafKey& leaf);

  static constexpr std::uint32_t kEmpty = 0xffffffffU;
  std::vector<std::uint32_t> slots_;  // open addressing, a power of two: index into sums_
  std::vector<Sum> sums_;
  std::uint32_t last_ = kEmpty;  // neighbouring pixels mostly share a leaf
};

/// The centroids of `points_m`, leaves in the order in which they were first reached.
std::vector<Vec3f> leaf_filter(std::span<const Vec3f> points_m, double leaf_m);

/// Defaults: the released filter sizes.
struct CloudConfig {
  double leaf_m = 0.02;         // RGBD points
  double profile_leaf_m = 0.1;  // LIDAR points
};

/// At most one point a leaf. Leaves are cubes [k leaf, (k + 1) leaf). The first batch with points
/// in a leaf puts their centroid there, and no later one changes it.
///
/// Density (paper section 2.1, Fig. 3): mean, over the cloud points in a voxel, of the number of
/// cloud points within r = voxel / sqrt(2), the point itself included. Counts are integers, kept
/// exact as points arrive: equal to a full recomputation at any time. "Within r" is the float32
/// comparison dx dx + dy dy + dz dz <= r r, which is the same from either point.
class SurfaceCloud {
 public:
  /// Throws BadInput naming leaf_m when it is not positive or less than a 64th of a voxel. An empty
  /// cloud takes no memory. It takes more as voxels get points; map_bytes() has the most.
  SurfaceCloud(const CloudConfig& config, const GridGeometry& voxels);

  const CloudConfig& config() const { return config_; }

  /// Adds one batch (a frame, a profile) through the leaf filter of `leaf_m`, then the cloud's own.
  /// Points outside the workspace are ignored. Returns how many points the cloud gained; they stand
  /// at the end of points_world_m(), in the order in which the batch first reached their leaves.
  std::size_t add(std::span<const Vec3f> points_world_m, double leaf_m);
  /// The same for the pixels of the frames that hit, frame by frame, as one batch with the cloud's
  /// own filter.
  std::size_t add(std::span<const FrameRays> frames);

  /// Fills an empty cloud with the points_world_m() of another one, of the same settings: every
  /// count is the other's then, and after all that is added later. False, and the cloud half
  /// filled, when a point lies outside the workspace, or two in one leaf.
  [[nodiscard]] bool restore(std::span<const Vec3f> points_world_m);

  std::span<const Vec3f> points_world_m() const { return points_; }
  /// The voxels that hold points, in the order in which they got their first one.
  std::span<const VoxelIndex> voxels() const { return voxels_with_points_; }
  /// Points per voxel of the occupancy grid.
  std::uint32_t point_count(VoxelIndex v) const { return voxel_points_[slot_of_[v]].point_count; }
  /// Sum of the neighbour counts of the points in the voxel.
  std::uint64_t neighbour_sum(VoxelIndex v) const {
    return voxel_points_[slot_of_[v]].neighbour_sum;
  }
  /// Mean neighbour count of the points in the voxel; 0 without points.
  double density(VoxelIndex v) const {
    const auto& [sum, count] = voxel_points_[slot_of_[v]];
    return count == 0 ? 0.0 : static_cast<double>(sum) / count;
  }
  /// The released normaliser, 3 (voxel / leaf)^2: 300 at 0.2 m and 0.02 m. No plane reaches it. One
  /// with normal n crosses |nx| + |ny| + |nz| leaves a leaf's face, so that a point of a fully
  /// scanned one has pi / 2 (voxel / leaf)^2 (|nx| + |ny| + |nz|) neighbours: 157 on a wall along
  /// the axes, 272 on one oblique to all three, and half as many at a free edge.
  double density_max() const {
    const double ratio = voxels_.resolution_m() / config_.leaf_m;
    return 3.0 * ratio * ratio;
  }
  double search_radius_m() const { return voxels_.resolution_m() / std::sqrt(2.0); }

 private:
  struct Leaf {
    std::size_t cell;   // of its bucket, into bucket_at_
    std::uint32_t bit;  // into the bucket's mask
  };
  Leaf place_of(const LeafKey& leaf) const;
  std::size_t word_of(std::uint32_t bucket, std::uint32_t bit) const;  // into taken_
  bool take(const Leaf& leaf);
  void point_table_at_arrays();
  std::size_t insert_batch(bool is_own_leaf);
  CellBox cells_within_reach(const Vec3f& p_m) const;
  void insert(const Vec3f& p_m, const Leaf& leaf);

  CloudConfig config_;
  GridGeometry voxels_;
  LeafLattice lattice_;
  float bucket_m_ = 1.0F;
  std::vector<Vec3f> points_;
  ZeroedArray<std::uint32_t> slot_of_;     // of each voxel: index into voxel_points_
  std::vector<VoxelPoints> voxel_points_;  // the first one is that of all voxels without points
  std::vector<VoxelIndex> voxels_with_points_;  // of the slots from the second on

  CloudTable table_{};                    // its pointers are set before each use
  ZeroedArray<std::uint32_t> bucket_at_;  // of each cell: index into buckets_
  std::vector<CloudBucket> buckets_;      // the first one is that of all cells without points
  std::vector<std::uint32_t> taken_;      // words_per_bucket for each bucket, a bit a leaf
  std::vector<PointBlock> blocks_;        // the first one is none
  std::vector<std::uint32_t> next_block_;
  LeafSums batch_;
};

}  // namespace gnbv
