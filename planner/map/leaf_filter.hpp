// One centroid per leaf, as pcl::VoxelGrid, but without its limit on the number of leaves.
#pragma once

#include <span>
#include <vector>

#include "planner/map/grid_geometry.hpp"

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

}  // namespace gnbv
