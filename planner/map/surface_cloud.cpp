#include "planner/map/surface_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::int32_t kMostLeavesPerBucket = 64;
constexpr double kMostCells = 2147483648.0;  // their indices are signed 32-bit in the gathers
constexpr std::size_t kPixelsAtOnce = 8192;  // their columns and indices stay in the cache

std::int32_t floor_div(std::int32_t a, std::int32_t b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/// The first float32 number whose voxel is not below `key` along an axis.
float first_of_voxel(const GridGeometry& voxels, std::int32_t key) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  auto at_m = static_cast<float>(key * voxels.resolution_m());
  while (voxels.key_of(static_cast<double>(at_m)) >= key) at_m = std::nextafter(at_m, -kInfinity);
  while (voxels.key_of(static_cast<double>(at_m)) < key) at_m = std::nextafter(at_m, kInfinity);
  return at_m;
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
  slot_of_ = ZeroedArray<std::uint32_t>(voxels.voxel_count());
  voxel_points_.resize(1);

  leaves_per_bucket_ = static_cast<std::int32_t>(std::ceil(voxel_m / config.leaf_m - 1e-9));
  bucket_m_ = static_cast<float>(leaves_per_bucket_ * config.leaf_m);
  const auto leaves = static_cast<std::size_t>(leaves_per_bucket_);
  words_per_bucket_ = (leaves * leaves * leaves + 31) / 32;
  double cells = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    // a bucket more on each side, so that the neighbours of any point have a cell
    const double min_m = voxels.min_key()[a] * voxel_m;
    const double max_m = (voxels.min_key()[a] + voxels.size()[a]) * voxel_m;
    const double bucket_m = leaves_per_bucket_ * config.leaf_m;
    first_bucket_[a] = static_cast<std::int32_t>(std::floor(min_m / bucket_m)) - 2;
    bucket_cells_[a] =
        static_cast<std::int32_t>(std::floor(max_m / bucket_m)) + 3 - first_bucket_[a];
    cells *= bucket_cells_[a];
    low_m_[a] = first_of_voxel(voxels, voxels.min_key()[a]);
    high_m_[a] = std::nextafter(first_of_voxel(voxels, voxels.min_key()[a] + voxels.size()[a]),
                                -std::numeric_limits<float>::infinity());
  }
  if (cells >= kMostCells) {
    throw BadInput(fmt::format("resolution_m: {} makes {:.3g} buckets of points, more than 2^31",
                               voxel_m, cells));
  }
  bucket_at_ = ZeroedArray<std::uint32_t>(static_cast<std::size_t>(cells));
  buckets_.resize(1);
  taken_.resize(words_per_bucket_, 0);
  blocks_.resize(1);
  next_block_.resize(1, 0);
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
  const std::size_t bucket = bucket_at_[leaf.bucket_cell];
  return (taken_[bucket * words_per_bucket_ + leaf.bit / 32] >> (leaf.bit % 32) & 1U) != 0;
}

bool SurfaceCloud::take(const Leaf& leaf) {
  std::uint32_t& bucket = bucket_at_[leaf.bucket_cell];
  if (bucket == 0) {
    bucket = static_cast<std::uint32_t>(buckets_.size());
    buckets_.emplace_back();
    taken_.resize(taken_.size() + words_per_bucket_, 0);
    GNBV_CHECK(taken_.size() <= std::numeric_limits<std::int32_t>::max(), "{} buckets", bucket);
  }
  std::uint32_t& word = taken_[bucket * words_per_bucket_ + leaf.bit / 32];
  const std::uint32_t mask = 1U << (leaf.bit % 32);
  if ((word & mask) != 0) return false;
  word |= mask;
  return true;
}

std::size_t SurfaceCloud::add(std::span<const Vec3f> points_world_m, double leaf_m) {
  GNBV_CHECK(leaf_m > 0.0, "leaf of {} m", leaf_m);
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
  return insert_batch(is_own_leaf);
}

std::size_t SurfaceCloud::add(std::span<const FrameRays> frames, double leaf_m) {
  if (leaf_m != config_.leaf_m) {
    std::vector<Vec3f> points_m;
    for (const FrameRays& frame : frames) {
      for (std::size_t i = 0; i < frame.kind.size(); ++i) {
        if (frame.kind[i] != PixelRay::hits) continue;
        points_m.emplace_back(frame.x_m[i], frame.y_m[i], frame.z_m[i]);
      }
    }
    return add(points_m, leaf_m);
  }
  batch_.reset();
  for (const FrameRays& frame : frames) add_untaken(frame);
  return insert_batch(true);
}

LeafTable SurfaceCloud::leaf_table() const {
  LeafTable table{.bucket_at = bucket_at_.data(),
                  .taken = taken_.data(),
                  .words_per_bucket = static_cast<std::int32_t>(words_per_bucket_),
                  .leaves_per_bucket = leaves_per_bucket_,
                  .first_leaf = {},
                  .cells_x = bucket_cells_[0],
                  .cells_y = bucket_cells_[1],
                  .inverse_leaf_1_m = lattice_.inverse_leaf_1_m(),
                  .low_m = {},
                  .high_m = {}};
  for (std::size_t a = 0; a < 3; ++a) {
    table.first_leaf[a] = first_bucket_[a] * leaves_per_bucket_;
    table.low_m[a] = low_m_[a];
    table.high_m[a] = high_m_[a];
  }
  return table;
}

void SurfaceCloud::add_untaken(const FrameRays& frame) {
  static_assert(sizeof(PixelRay) == 1);
  const LeafTable table = leaf_table();
  const PixelColumns pixels{.p_m = {frame.x_m.data(), frame.y_m.data(), frame.z_m.data()},
                            .kind = reinterpret_cast<const std::uint8_t*>(frame.kind.data())};
  const FindUntaken find_untaken = cloud_kernels().find_untaken;
  const std::size_t count = frame.kind.size();
  untaken_.resize(kPixelsAtOnce);
  for (std::size_t begin = 0; begin < count; begin += kPixelsAtOnce) {
    const std::size_t end = std::min(begin + kPixelsAtOnce, count);
    const std::size_t found = find_untaken(table, pixels, begin, end, untaken_.data());
    for (const std::int32_t pixel : std::span(untaken_).first(found)) {
      const auto i = static_cast<std::size_t>(pixel);
      const Vec3f p_m(frame.x_m[i], frame.y_m[i], frame.z_m[i]);
      batch_.add(lattice_.key_of(p_m), p_m);
    }
  }
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
  const float reach_m = static_cast<float>(search_radius_m_) * 1.001F + 1e-5F * bucket_m_;
  CellBox cells;
  for (std::size_t a = 0; a < 3; ++a) {
    const float at_m = p_m[static_cast<Eigen::Index>(a)];
    const float slack_m = reach_m + 4e-7F * std::fabs(at_m);
    const auto cell_of = [&](float x_m) {
      const float scaled = x_m / bucket_m_;
      const auto truncated = static_cast<std::int32_t>(scaled);
      const auto is_below = static_cast<std::int32_t>(scaled < static_cast<float>(truncated));
      return static_cast<std::size_t>(truncated - is_below - first_bucket_[a]);
    };
    cells.low[a] = cell_of(at_m - slack_m);
    cells.high[a] = cell_of(at_m + slack_m);
  }
  return cells;
}

std::uint32_t SurfaceCloud::slot_of(const Vec3f& p_m) {
  const VoxelIndex voxel = voxels_.index_of(voxels_.key_of(p_m));
  std::uint32_t& slot = slot_of_[voxel];
  if (slot == 0) {
    voxels_with_points_.push_back(voxel);
    slot = static_cast<std::uint32_t>(voxel_points_.size());
    voxel_points_.emplace_back();
  }
  return slot;
}

void SurfaceCloud::append(CloudBucket& bucket, const Vec3f& p_m, std::uint32_t slot) {
  if (bucket.last_block == 0) {
    bucket.slot = slot;
  } else {
    bucket.has_one_voxel &= bucket.slot == slot;
  }
  if (bucket.last_block == 0 || bucket.last_count == kPointsPerBlock) {
    PointBlock& block = blocks_.emplace_back();
    for (float* const column : {block.x_m, block.y_m, block.z_m}) {
      std::fill_n(column, kPointsPerBlock, std::numeric_limits<float>::infinity());
    }
    next_block_.push_back(bucket.last_block);
    bucket.last_block = static_cast<std::uint32_t>(blocks_.size() - 1);
    bucket.last_count = 0;
  }
  PointBlock& block = blocks_[bucket.last_block];
  const std::uint32_t i = bucket.last_count++;
  block.x_m[i] = p_m[0];
  block.y_m[i] = p_m[1];
  block.z_m[i] = p_m[2];
  block.slot[i] = slot;
}

void SurfaceCloud::insert(const Vec3f& p_m, const Leaf& leaf) {
  const std::uint32_t slot = slot_of(p_m);
  const PointTable table{.bucket_at = bucket_at_.data(),
                         .buckets = buckets_.data(),
                         .blocks = blocks_.data(),
                         .next_block = next_block_.data(),
                         .cells_x = static_cast<std::size_t>(bucket_cells_[0]),
                         .cells_y = static_cast<std::size_t>(bucket_cells_[1]),
                         .radius2_m2 = search_radius2_m2_};
  const std::uint64_t neighbours = cloud_kernels().count_neighbours(
      table, p_m.data(), cells_within_reach(p_m), voxel_points_.data());
  voxel_points_[slot].neighbour_sum += neighbours + 1;  // the point itself
  ++voxel_points_[slot].point_count;
  append(buckets_[bucket_at_[leaf.bucket_cell]], p_m, slot);
  points_.push_back(p_m);
}

}  // namespace gnbv
