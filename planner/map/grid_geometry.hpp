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

/// The greatest integer that is not above x; std::floor would be a call. Requires |x| < 2^31.
template <typename T>
std::int32_t floor_to_int(T x) {
  const auto truncated = static_cast<std::int32_t>(x);
  return truncated - static_cast<std::int32_t>(x < static_cast<T>(truncated));
}

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
  std::size_t voxel_count() const { return std::size_t{1} * size_[0] * size_[1] * size_[2]; }
  bool operator==(const GridGeometry&) const = default;

  /// The lattice with so many more voxels on each side.
  GridGeometry grown(std::int32_t voxels) const {
    GridGeometry grid = *this;
    for (std::int32_t& first : grid.min_) first -= voxels;
    for (std::int32_t& count : grid.size_) count += 2 * voxels;
    return grid;
  }

  /// As OctoMap's coordToKey: floor of the coordinate times the resolution factor, in double.
  /// Coordinates beyond +-2^30 voxels, and NaN, give a key outside every grid.
  std::int32_t key_of(double coordinate_m) const {
    constexpr double kLimit = 1 << 30;
    const double scaled = inverse_resolution_ * coordinate_m;
    return floor_to_int(scaled > -kLimit ? (scaled < kLimit ? scaled : kLimit) : -kLimit);
  }
  /// OctoMap widens each coordinate of float32 points to double.
  template <typename Scalar>
  Key key_of(const Eigen::Matrix<Scalar, 3, 1>& p_world_m) const {
    return {key_of(double{p_world_m.x()}), key_of(double{p_world_m.y()}),
            key_of(double{p_world_m.z()})};
  }
  /// As OctoMap's keyToCoord: the centre of the voxel.
  double center_m(std::int32_t key) const { return (key + 0.5) * resolution_m_; }
  Vec3 center_m(const Key& key) const {
    return {center_m(key[0]), center_m(key[1]), center_m(key[2])};
  }

  /// The nearest point that lies in a voxel of the grid also as float32: a point on an upper face
  /// belongs to the voxel beyond it.
  Vec3 nearest_inside(const Vec3& p_world_m) const {
    constexpr double kFace_m = 1e-4;
    Vec3 inside_m;
    for (int a = 0; a < 3; ++a) {
      inside_m[a] = std::clamp(p_world_m[a], min_[a] * resolution_m_ + kFace_m,
                               (min_[a] + size_[a]) * resolution_m_ - kFace_m);
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

/// Larger maps are refused before the start.
constexpr double kMapBudget_bytes = 6.0 * 1024 * 1024 * 1024;

/// The most that the dense arrays of a map take, once every page of them is written. A voxel takes
/// 8 bytes in OccupancyGrid (float32 log-odds, VoxelWord), 4 in SurfaceCloud and 4 in its buckets,
/// 1 each in ShadowBand, the frontier marks and the FrameInserter of each camera, and 2 for each
/// thread (VisitMarks, FanWalker). Not counted are what grows with the surface, some 50 to 150
/// bytes a point of the cloud, and a planner's own arrays (planning_bytes() in planner/planners.hpp
/// has them).
double map_bytes(const Box3& workspace_m, double resolution_m, int threads, std::size_t cameras);

}  // namespace gnbv
