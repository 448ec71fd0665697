#include "planner/map/surface_cloud.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr std::int32_t kMostLeavesPerBucket = 64;
constexpr double kMostCells = 2147483648.0;  // their indices are signed 32-bit in the gathers
constexpr std::size_t kPixelsAtOnce = 8192;  // their columns and indices stay in the cache
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The first float32 number whose voxel is not below `key` along an axis.
float first_of_voxel(const GridGeometry& voxels, std::int32_t key) {
  auto at_m = static_cast<float>(key * voxels.resolution_m());
  while (voxels.key_of(at_m) >= key) at_m = std::nextafter(at_m, -kInfinity);
  while (voxels.key_of(at_m) < key) at_m = std::nextafter(at_m, kInfinity);
  return at_m;
}

}  // namespace

void LeafSums::reset() {
  std::fill(slots_.begin(), slots_.end(), kEmpty);
  sums_.clear();
  last_ = kEmpty;
}

std::uint32_t& LeafSums::slot_of(const LeafKey& leaf) {
  const auto bits = [&](std::size_t a) { return std::uint64_t{leaf[a] & 0x1fffffU}; };
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = mix_bits(bits(0) | bits(1) << 21 | bits(2) << 42) & mask;
  while (slots_[slot] != kEmpty && sums_[slots_[slot]].leaf != leaf) slot = (slot + 1) & mask;
  return slots_[slot];
}

void LeafSums::add(const LeafKey& leaf, const Vec3f& p_m) {
  constexpr std::size_t kFewestSlots = 4096;
  if (last_ == kEmpty || sums_[last_].leaf != leaf) {
    if (2 * (sums_.size() + 1) > slots_.size()) {
      slots_.assign(std::max(kFewestSlots, 2 * slots_.size()), kEmpty);
      for (std::uint32_t i = 0; i < sums_.size(); ++i) slot_of(sums_[i].leaf) = i;
    }
    std::uint32_t& slot = slot_of(leaf);
    if (slot == kEmpty) {
      slot = static_cast<std::uint32_t>(sums_.size());
      sums_.push_back({leaf, 0, Vec3::Zero()});
    }
    last_ = slot;
  }
  sums_[last_].count += 1;
  sums_[last_].sum_m += p_m.cast<double>();
}

std::vector<Vec3f> LeafSums::centroids_m() const {
  std::vector<Vec3f> centroids(size());
  for (std::size_t i = 0; i < size(); ++i) centroids[i] = centroid_m(i);
  return centroids;
}

std::vector<Vec3f> leaf_filter(std::span<const Vec3f> points_m, double leaf_m) {
  const LeafLattice lattice(leaf_m);
  LeafSums sums;
  for (const Vec3f& p_m : points_m) sums.add(lattice.key_of(p_m), p_m);
  return sums.centroids_m();
}

SurfaceCloud::SurfaceCloud(const CloudConfig& config, const GridGeometry& voxels)
    : config_(config), voxels_(voxels), lattice_(config.leaf_m) {
  const double voxel_m = voxels.resolution_m();
  if (!(config.leaf_m > 0.0) || !(voxel_m <= config.leaf_m * kMostLeavesPerBucket)) {
    throw BadInput(fmt::format("leaf_m: {} is not between a {}th of resolution_m {} and infinity",
                               config.leaf_m, kMostLeavesPerBucket, voxel_m));
  }
  table_.radius2_m2 = static_cast<float>(search_radius_m() * search_radius_m());
  slot_of_ = ZeroedArray<std::uint32_t>(voxels.voxel_count());
  voxel_points_.resize(1);

  const double side = std::ceil(voxel_m / config.leaf_m - 1e-9);  // of a bucket, in leaves
  const double bucket_m = side * config.leaf_m;
  bucket_m_ = static_cast<float>(bucket_m);
  table_.inverse_leaf_1_m = lattice_.inverse_leaf_1_m();
  table_.leaves_per_bucket = static_cast<std::int32_t>(side);
  table_.words_per_bucket = static_cast<std::int32_t>(std::ceil(side * side * side / 32.0));
  double cells = 1.0;
  for (int a = 0; a < 3; ++a) {
    // a bucket more on each side, so that the neighbours of any point have a cell
    const std::int32_t begin = voxels.min_key()[a];
    const std::int32_t end = begin + voxels.size()[a];
    table_.first_bucket[a] = static_cast<std::int32_t>(std::floor(begin * voxel_m / bucket_m)) - 2;
    table_.cells[a] = static_cast<std::int32_t>(std::floor(end * voxel_m / bucket_m)) + 3 -
                      table_.first_bucket[a];
    cells *= table_.cells[a];
    table_.low_m[a] = first_of_voxel(voxels, begin);
    table_.high_m[a] = std::nextafter(first_of_voxel(voxels, end), -kInfinity);
  }
  if (cells >= kMostCells) {
    throw BadInput(fmt::format("resolution_m: {} makes {:.3g} buckets of points, more than 2^31",
                               voxel_m, cells));
  }
  bucket_at_ = ZeroedArray<std::uint32_t>(static_cast<std::size_t>(cells));
  buckets_.resize(1);
  taken_.resize(table_.words_per_bucket, 0);
  blocks_.resize(1);
  next_block_.resize(1, 0);
}

SurfaceCloud::Leaf SurfaceCloud::place_of(const LeafKey& leaf) const {
  const auto side = static_cast<std::uint32_t>(table_.leaves_per_bucket);
  Leaf place{0, 0};
  for (int a = 2; a >= 0; --a) {
    const std::uint32_t from_first = leaf[a] - table_.first_bucket[a] * table_.leaves_per_bucket;
    const std::uint32_t cell = from_first / side;
    place.cell = place.cell * table_.cells[a] + cell;
    place.bit = place.bit * side + (from_first - cell * side);
  }
  return place;
}

std::size_t SurfaceCloud::word_of(std::uint32_t bucket, std::uint32_t bit) const {
  return std::size_t{bucket} * table_.words_per_bucket + bit / 32;
}

bool SurfaceCloud::take(const Leaf& leaf) {
  std::uint32_t& bucket = bucket_at_[leaf.cell];
  if (bucket == 0) {
    bucket = static_cast<std::uint32_t>(buckets_.size());
    buckets_.emplace_back();
    taken_.resize(word_of(bucket + 1, 0), 0);
    GNBV_CHECK(taken_.size() <= std::numeric_limits<std::int32_t>::max(), "{} buckets", bucket);
  }
  std::uint32_t& word = taken_[word_of(bucket, leaf.bit)];
  const std::uint32_t mask = 1U << (leaf.bit % 32);
  if ((word & mask) != 0) return false;
  word |= mask;
  return true;
}

void SurfaceCloud::point_table_at_arrays() {
  table_.bucket_at = bucket_at_.data();
  table_.taken = taken_.data();
  table_.buckets = buckets_.data();
  table_.blocks = blocks_.data();
  table_.next_block = next_block_.data();
}

std::size_t SurfaceCloud::add(std::span<const Vec3f> points_world_m, double leaf_m) {
  GNBV_CHECK(leaf_m > 0.0, "leaf of {} m", leaf_m);
  const bool is_own_leaf = leaf_m == config_.leaf_m;
  const LeafLattice batch_lattice(leaf_m);
  batch_.reset();
  for (const Vec3f& p_m : points_world_m) {
    if (!voxels_.contains(voxels_.key_of(p_m))) continue;
    const LeafKey leaf = batch_lattice.key_of(p_m);
    if (is_own_leaf) {
      // a centroid stays in its leaf, so those of taken leaves need not be computed
      const auto [cell, bit] = place_of(leaf);
      if ((taken_[word_of(bucket_at_[cell], bit)] >> (bit % 32) & 1U) != 0) continue;
    }
    batch_.add(leaf, p_m);
  }
  return insert_batch(is_own_leaf);
}

std::size_t SurfaceCloud::add(std::span<const FrameRays> frames) {
  batch_.reset();
  point_table_at_arrays();
  std::array<std::int32_t, kPixelsAtOnce> untaken;
  for (const FrameRays& frame : frames) {
    for (std::size_t begin = 0; begin < frame.kind.size(); begin += kPixelsAtOnce) {
      const auto count = static_cast<int>(std::min(frame.kind.size() - begin, kPixelsAtOnce));
      const std::size_t found =
          cloud_kernels().find_untaken(table_, frame.row(begin), count, untaken.data());
      for (const std::int32_t pixel : std::span(untaken).first(found)) {
        const Vec3f p_m = frame.end_world_m(begin + pixel);
        batch_.add(lattice_.key_of(p_m), p_m);
      }
    }
  }
  return insert_batch(true);
}

std::size_t SurfaceCloud::insert_batch(bool is_own_leaf) {
  const std::size_t before = points_.size();
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    const Vec3f p_m = batch_.centroid_m(i);
    const Leaf leaf = place_of(is_own_leaf ? batch_.leaf(i) : lattice_.key_of(p_m));
    if (take(leaf)) insert(p_m, leaf);
  }
  return points_.size() - before;
}

bool SurfaceCloud::restore(std::span<const Vec3f> points_world_m) {
  GNBV_CHECK(points_.empty(), "{} points are there already", points_.size());
  for (const Vec3f& p_m : points_world_m) {
    if (!voxels_.contains(voxels_.key_of(p_m))) return false;
    const Leaf leaf = place_of(lattice_.key_of(p_m));
    if (!take(leaf)) return false;
    insert(p_m, leaf);
  }
  return true;
}

CellBox SurfaceCloud::cells_within_reach(const Vec3f& p_m) const {
  // the slack covers rounding of leaf borders and of the distance
  const float reach_m = static_cast<float>(search_radius_m()) * 1.001F + 1e-5F * bucket_m_;
  CellBox cells;
  for (int a = 0; a < 3; ++a) {
    const float slack_m = reach_m + 4e-7F * std::fabs(p_m[a]);
    cells.low[a] = floor_to_int((p_m[a] - slack_m) / bucket_m_) - table_.first_bucket[a];
    cells.high[a] = floor_to_int((p_m[a] + slack_m) / bucket_m_) - table_.first_bucket[a];
  }
  return cells;
}

void SurfaceCloud::insert(const Vec3f& p_m, const Leaf& leaf) {
  const VoxelIndex voxel = voxels_.index_of(voxels_.key_of(p_m));
  std::uint32_t& slot = slot_of_[voxel];
  if (slot == 0) {
    voxels_with_points_.push_back(voxel);
    slot = static_cast<std::uint32_t>(voxel_points_.size());
    voxel_points_.emplace_back();
  }
  point_table_at_arrays();
  const std::uint64_t neighbours = cloud_kernels().count_neighbours(
      table_, p_m.data(), cells_within_reach(p_m), voxel_points_.data());
  voxel_points_[slot].neighbour_sum += neighbours + 1;  // the point itself
  ++voxel_points_[slot].point_count;

  CloudBucket& bucket = buckets_[bucket_at_[leaf.cell]];
  if (bucket.last_block == 0) bucket.slot = slot;
  bucket.has_one_voxel &= bucket.slot == slot;
  if (bucket.last_block == 0 || bucket.last_count == kPointsPerBlock) {
    PointBlock& block = blocks_.emplace_back();
    for (auto& column : block.p_m) std::fill(std::begin(column), std::end(column), kInfinity);
    next_block_.push_back(bucket.last_block);
    bucket.last_block = static_cast<std::uint32_t>(blocks_.size() - 1);
    bucket.last_count = 0;
  }
  PointBlock& block = blocks_[bucket.last_block];
  for (int a = 0; a < 3; ++a) block.p_m[a][bucket.last_count] = p_m[a];
  block.slot[bucket.last_count++] = slot;
  points_.push_back(p_m);
}

}  // namespace gnbv
