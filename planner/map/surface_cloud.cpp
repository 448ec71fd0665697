#include "planner/map/surface_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::int32_t kMostLeavesPerBucket = 64;

std::int32_t floor_div(std::int32_t a, std::int32_t b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

}  // namespace

SurfaceCloud::SurfaceCloud(const CloudConfig& config, const GridGeometry& voxels)
    : config_(config), voxels_(voxels), lattice_(config.leaf_m) {
  const double voxel_m = voxels.resolution_m();
  if (!(config.leaf_m > 0.0) || !(voxel_m <= config.leaf_m * kMostLeavesPerBucket)) {
    throw BadInput(fmt::format("leaf_m: {} is not between a {}th of resolution_m {} and infinity",
                               config.leaf_m, kMostLeavesPerBucket, voxel_m));
  }
  density_max_ = 3.0 * (voxel_m / config.leaf_m) * (voxel_m / config.leaf_m);
  search_radius_m_ = voxel_m / std::sqrt(2.0);
  search_radius2_m2_ = static_cast<float>(search_radius_m_ * search_radius_m_);
  point_count_.assign(voxels.voxel_count(), 0);
  neighbour_sum_.assign(voxels.voxel_count(), 0);

  leaves_per_bucket_ = static_cast<std::int32_t>(std::ceil(voxel_m / config.leaf_m - 1e-9));
  bucket_m_ = static_cast<float>(leaves_per_bucket_ * config.leaf_m);
  const auto leaves = static_cast<std::size_t>(leaves_per_bucket_);
  words_per_bucket_ = (leaves * leaves * leaves + 63) / 64;
  std::size_t cells = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    // a bucket more on each side, so that the neighbours of any point have a cell
    const double min_m = voxels.min_key()[a] * voxel_m;
    const double max_m = (voxels.min_key()[a] + voxels.size()[a]) * voxel_m;
    const double bucket_m = leaves_per_bucket_ * config.leaf_m;
    first_bucket_[a] = static_cast<std::int32_t>(std::floor(min_m / bucket_m)) - 2;
    bucket_cells_[a] =
        static_cast<std::int32_t>(std::floor(max_m / bucket_m)) + 3 - first_bucket_[a];
    cells *= static_cast<std::size_t>(bucket_cells_[a]);
  }
  bucket_at_.assign(cells, kNone);
}

SurfaceCloud::Leaf SurfaceCloud::place_of(const LeafKey& leaf) const {
  std::array<std::int32_t, 3> cell;
  std::array<std::int32_t, 3> in_bucket;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int32_t bucket = floor_div(leaf[a], leaves_per_bucket_);
    cell[a] = bucket - first_bucket_[a];
    in_bucket[a] = leaf[a] - bucket * leaves_per_bucket_;
  }
  const auto cell_index =
      (static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(bucket_cells_[1]) +
       static_cast<std::size_t>(cell[1])) *
          static_cast<std::size_t>(bucket_cells_[0]) +
      static_cast<std::size_t>(cell[0]);
  const std::int32_t bit =
      (in_bucket[2] * leaves_per_bucket_ + in_bucket[1]) * leaves_per_bucket_ + in_bucket[0];
  return {cell_index, static_cast<std::uint32_t>(bit)};
}

bool SurfaceCloud::is_taken(const Leaf& leaf) const {
  const std::uint32_t bucket = bucket_at_[leaf.bucket_cell];
  return bucket != kNone &&
         (taken_[bucket * words_per_bucket_ + leaf.bit / 64] >> (leaf.bit % 64) & 1U) != 0;
}

bool SurfaceCloud::take(const Leaf& leaf) {
  std::uint32_t& bucket = bucket_at_[leaf.bucket_cell];
  if (bucket == kNone) {
    bucket = static_cast<std::uint32_t>(buckets_.size());
    buckets_.emplace_back();
    taken_.resize(taken_.size() + words_per_bucket_, 0);
  }
  std::uint64_t& word = taken_[bucket * words_per_bucket_ + leaf.bit / 64];
  const std::uint64_t mask = std::uint64_t{1} << (leaf.bit % 64);
  if ((word & mask) != 0) return false;
  word |= mask;
  return true;
}

std::size_t SurfaceCloud::add(std::span<const Vec3f> points_world_m, double leaf_m) {
  GNBV_CHECK(leaf_m > 0.0, "leaf of {} m", leaf_m);
  const std::size_t before = points_.size();
  const bool is_own_leaf = leaf_m == config_.leaf_m;
  const LeafLattice batch_lattice(leaf_m);
  batch_.reset();
  for (const Vec3f& p_m : points_world_m) {
    if (!voxels_.contains(voxels_.key_of(p_m))) continue;
    const LeafKey leaf = batch_lattice.key_of(p_m);
    // a centroid stays in its leaf, so those of taken leaves need not be computed
    if (is_own_leaf && is_taken(place_of(leaf))) continue;
    batch_.add(leaf, p_m);
  }
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    const Vec3f p_m = batch_.centroid_m(i);
    const Leaf leaf = place_of(is_own_leaf ? batch_.leaf(i) : lattice_.key_of(p_m));
    if (take(leaf)) insert(p_m, leaf);
  }
  return points_.size() - before;
}

std::uint64_t SurfaceCloud::count_pairs(const Vec3f& p_m, const Bucket& bucket) {
  std::uint64_t pairs = 0;
  for (std::uint32_t b = bucket.last_block; b != kNone; b = blocks_[b].next) {
    const Block& block = blocks_[b];
    std::array<std::int32_t, kBlockPoints> is_near;
    for (std::size_t i = 0; i < kBlockPoints; ++i) {
      const float dx = block.x[i] - p_m[0];
      const float dy = block.y[i] - p_m[1];
      const float dz = block.z[i] - p_m[2];
      is_near[i] = dx * dx + dy * dy + dz * dz <= search_radius2_m2_ ? 1 : 0;
    }
    std::int32_t in_block = 0;
    for (const std::int32_t n : is_near) in_block += n;
    pairs += static_cast<std::uint64_t>(in_block);
    if (bucket.has_one_voxel || in_block == 0) continue;
    for (std::size_t i = 0; i < kBlockPoints; ++i) {
      if (is_near[i] != 0) ++neighbour_sum_[block.voxel[i]];
    }
  }
  if (bucket.has_one_voxel) neighbour_sum_[bucket.voxel] += pairs;
  return pairs;
}

void SurfaceCloud::append(Bucket& bucket, const Vec3f& p_m, VoxelIndex voxel) {
  if (bucket.last_block == kNone) {
    bucket.voxel = voxel;
  } else {
    bucket.has_one_voxel &= bucket.voxel == voxel;
  }
  if (bucket.last_block == kNone || bucket.last_count == kBlockPoints) {
    Block block;
    block.x.fill(std::numeric_limits<float>::infinity());
    block.y = block.x;
    block.z = block.x;
    block.voxel.fill(0);
    block.next = bucket.last_block;
    bucket.last_block = static_cast<std::uint32_t>(blocks_.size());
    bucket.last_count = 0;
    blocks_.push_back(block);
  }
  Block& block = blocks_[bucket.last_block];
  const std::size_t i = bucket.last_count++;
  block.x[i] = p_m[0];
  block.y[i] = p_m[1];
  block.z[i] = p_m[2];
  block.voxel[i] = voxel;
}

void SurfaceCloud::insert(const Vec3f& p_m, const Leaf& leaf) {
  const VoxelIndex voxel = voxels_.index_of(voxels_.key_of(p_m));
  // buckets within reach; the slack covers rounding of leaf borders and of the distance
  const auto nx = static_cast<std::size_t>(bucket_cells_[0]);
  const auto ny = static_cast<std::size_t>(bucket_cells_[1]);
  const float reach_m = static_cast<float>(search_radius_m_) * 1.001F + 1e-5F * bucket_m_;
  std::array<std::size_t, 3> low;
  std::array<std::size_t, 3> high;
  for (std::size_t a = 0; a < 3; ++a) {
    const float at_m = p_m[static_cast<Eigen::Index>(a)];
    const float slack_m = reach_m + 4e-7F * std::fabs(at_m);
    const auto cell_of = [&](float x_m) {
      return static_cast<std::size_t>(static_cast<std::int32_t>(std::floor(x_m / bucket_m_)) -
                                      first_bucket_[a]);
    };
    low[a] = cell_of(at_m - slack_m);
    high[a] = cell_of(at_m + slack_m);
  }
  std::uint64_t neighbours = 0;
  for (std::size_t z = low[2]; z <= high[2]; ++z) {
    for (std::size_t y = low[1]; y <= high[1]; ++y) {
      for (std::size_t x = low[0]; x <= high[0]; ++x) {
        const std::uint32_t bucket = bucket_at_[(z * ny + y) * nx + x];
        if (bucket != kNone) neighbours += count_pairs(p_m, buckets_[bucket]);
      }
    }
  }
  neighbour_sum_[voxel] += neighbours + 1;  // the point itself
  if (point_count_[voxel]++ == 0) voxels_with_points_.push_back(voxel);
  append(buckets_[bucket_at_[leaf.bucket_cell]], p_m, voxel);
  points_.push_back(p_m);
}

}  // namespace gnbv
