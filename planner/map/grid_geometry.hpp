// The bounded voxel lattice of a workspace, aligned with OctoMap's: voxel k of an axis covers
// [k r, (k + 1) r), and k equals OctoMap's key minus 32768 (OcTreeBaseImpl::coordToKey).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "sim/core/pose.hpp"

namespace gnbv {

using Key = std::array<std::int32_t, 3>;  // signed lattice coordinates
using VoxelIndex = std::uint32_t;         // position in the dense arrays, x fastest

/// The cube that holds the point, of those of that side that fill space from the origin on.
inline Key cube_of(const Vec3& p_m, double side_m) {
  const Eigen::Array3i cube = (p_m / side_m).array().floor().cast<int>();
  return {cube[0], cube[1], cube[2]};
}

/// Keys from low to high, both included. Empty at first.
struct KeyBox {
  Key low = {0, 0, 0}, high = {-1, -1, -1};
  bool is_empty() const { return low[0] > high[0] || low[1] > high[1] || low[2] > high[2]; }
  bool contains(const Key& key) const {
    return key[0] >= low[0] && key[1] >= low[1] && key[2] >= low[2] &&  //
           key[0] <= high[0] && key[1] <= high[1] && key[2] <= high[2];
  }
};

/// The key and those about it: 26 at a `reach` of 1.
inline KeyBox keys_about(const Key& key, std::int32_t reach = 1) {
  return {{key[0] - reach, key[1] - reach, key[2] - reach},
          {key[0] + reach, key[1] + reach, key[2] + reach}};
}

/// Calls use(key) for each key of the box, x fastest.
template <typename Use>
void for_each_key(const KeyBox& keys, const Use& use) {
  Key key;
  for (key[2] = keys.low[2]; key[2] <= keys.high[2]; ++key[2]) {
    for (key[1] = keys.low[1]; key[1] <= keys.high[1]; ++key[1]) {
      for (key[0] = keys.low[0]; key[0] <= keys.high[0]; ++key[0]) use(key);
    }
  }
}

class GridGeometry {
 public:
  GridGeometry() = default;
  /// All voxels that overlap the box with more than a face. Throws BadInput for a resolution that
  /// is not positive, an empty box, or one that does not fit OctoMap's 16-bit keys or 31-bit
  /// indices.
  GridGeometry(const Box3& bounds_m, double resolution_m);

  double resolution_m() const { return resolution_m_; }
  /// The factor of key_of.
  double inverse_resolution() const { return inverse_resolution_; }
  const Key& min_key() const { return min_; }
  const Key& size() const { return size_; }
  std::size_t voxel_count() const {
    return static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
           static_cast<std::size_t>(size_[2]);
  }

  /// As OctoMap's coordToKey: floor of the coordinate times the resolution factor, in double.
  /// Coordinates beyond +-2^30 voxels, and NaN, give a key outside every grid.
  std::int32_t key_of(double coordinate_m) const {
    constexpr double kLimit = 1 << 30;
    const double scaled = inverse_resolution_ * coordinate_m;
    const double bounded = scaled > -kLimit ? (scaled < kLimit ? scaled : kLimit) : -kLimit;
    const auto truncated = static_cast<std::int32_t>(bounded);
    return truncated - static_cast<std::int32_t>(bounded < truncated);
  }
  Key key_of(const Vec3& p_world_m) const {
    return {key_of(p_world_m.x()), key_of(p_world_m.y()), key_of(p_world_m.z())};
  }
  /// The same for float32 points: OctoMap widens each coordinate to double.
  Key key_of(const Vec3f& p_world_m) const {
    return {key_of(static_cast<double>(p_world_m.x())), key_of(static_cast<double>(p_world_m.y())),
            key_of(static_cast<double>(p_world_m.z()))};
  }
  /// As OctoMap's keyToCoord: the centre of the voxel.
  double center_m(std::int32_t key) const {
    return (static_cast<double>(key) + 0.5) * resolution_m_;
  }
  Vec3 center_m(const Key& key) const {
    return {center_m(key[0]), center_m(key[1]), center_m(key[2])};
  }

  /// The nearest point that lies in a voxel of the grid also as float32: a point on an upper face
  /// belongs to the voxel beyond it.
  Vec3 nearest_inside(const Vec3& p_world_m) const {
    constexpr double kFace_m = 1e-4;
    Vec3 inside_m;
    for (Eigen::Index a = 0; a < 3; ++a) {
      const auto i = static_cast<std::size_t>(a);
      inside_m[a] = std::clamp(p_world_m[a], min_[i] * resolution_m_ + kFace_m,
                               (min_[i] + size_[i]) * resolution_m_ - kFace_m);
    }
    return inside_m;
  }

  bool contains(const Key& key) const {
    return static_cast<std::uint32_t>(key[0] - min_[0]) < static_cast<std::uint32_t>(size_[0]) &&
           static_cast<std::uint32_t>(key[1] - min_[1]) < static_cast<std::uint32_t>(size_[1]) &&
           static_cast<std::uint32_t>(key[2] - min_[2]) < static_cast<std::uint32_t>(size_[2]);
  }
  /// Those of the grid that hold a point of the box, or are up to `more` keys away from one that
  /// does.
  KeyBox keys_in(const Box3& box_m, std::int32_t more = 0) const;
  /// Requires contains(key).
  VoxelIndex index_of(const Key& key) const {
    return static_cast<VoxelIndex>(((key[2] - min_[2]) * size_[1] + (key[1] - min_[1])) * size_[0] +
                                   (key[0] - min_[0]));
  }
  Key key_at(VoxelIndex index) const {
    const auto i = static_cast<std::int32_t>(index);
    return {i % size_[0] + min_[0], (i / size_[0]) % size_[1] + min_[1],
            i / (size_[0] * size_[1]) + min_[2]};
  }

 private:
  double resolution_m_ = 1.0;
  double inverse_resolution_ = 1.0;
  Key min_ = {0, 0, 0};
  Key size_ = {0, 0, 0};
};

}  // namespace gnbv
