// The cloud kernels: which pixels lie in new leaves, and how many points are near a new one.
#include "planner/map/map_kernels.hpp"
#include "sim/core/lanes.hpp"

namespace gnbv {
namespace {

/// Cell and place in the bucket along one axis. The quotient is exact: s + 1/2 is at least 1 / 128
/// of a bucket from its ends, and with at most 2^16 cells the rounding stays below that.
struct AlongAxis {
  Ints cell, in_bucket;
};
inline AlongAxis along_axis(const CloudTable& t, int axis, Floats p_m) {
  const Ints first = all(t.first_bucket[axis] * t.leaves_per_bucket);
  const Ints s = floored(p_m * all(t.inverse_leaf_1_m)) - first;
  const float inverse = 1.0F / static_cast<float>(t.leaves_per_bucket);
  const Ints cell = truncated((to_floats(s) + all(0.5F)) * all(inverse));
  return {cell, s - cell * all(t.leaves_per_bucket)};
}

/// Those of `wanted` whose leaf is not taken.
inline Mask untaken(const CloudTable& t, Mask wanted, const Floats p_m[3]) {
  Ints cell = all(0);
  Ints bit = all(0);
  for (int a = 2; a >= 0; --a) {
    const AlongAxis at = along_axis(t, a, p_m[a]);
    cell = cell * all(t.cells[a]) + at.cell;
    bit = bit * all(t.leaves_per_bucket) + at.in_bucket;
  }
  const Ints bucket = gather(wanted, t.bucket_at, cell);
  const Ints word = gather(wanted, t.taken, bucket * all(t.words_per_bucket) + shift_right<5>(bit));
  return wanted & has_none(word, all(1) << (bit & all(31)));
}

std::size_t find_untaken(const CloudTable& given, const EndRow& pixels, int count,
                         std::int32_t* out) {
  const CloudTable table = given;  // no output can be part of it
  const auto* const kind = reinterpret_cast<const std::uint8_t*>(pixels.kind);
  std::int32_t* next = out;
  for_lanes(count, [&](int i, int left) {
    Mask wanted = equal_bytes(kind + i, static_cast<std::uint8_t>(PixelRay::hits), left);
    if (!any(wanted)) return;
    Floats p_m[3];
    for (int a = 0; a < 3; ++a) {
      p_m[a] = load(pixels.end_m[a] + i, left);
      wanted = wanted & less_equal(all(table.low_m[a]), p_m[a]) &
               less_equal(p_m[a], all(table.high_m[a]));
    }
    next += pack(untaken(table, wanted, p_m), all(i) + int_ramp(), next);
  });
  return static_cast<std::size_t>(next - out);
}

/// A bit for each point within the radius.
inline std::uint32_t near_bits(const PointBlock& block, const Floats p_m[3], Floats radius2_m2) {
  std::uint32_t near = 0;
  for (std::uint32_t first = 0; first < kPointsPerBlock; first += kLanes) {
    const Floats dx = load(block.p_m[0] + first) - p_m[0];
    const Floats dy = load(block.p_m[1] + first) - p_m[1];
    const Floats dz = load(block.p_m[2] + first) - p_m[2];
    near |= bits(less_equal(dx * dx + dy * dy + dz * dz, radius2_m2)) << first;
  }
  return near;
}

inline std::uint64_t count_in_bucket(const CloudTable& t, const CloudBucket& bucket,
                                     const Floats p_m[3], VoxelPoints* voxels) {
  const Floats radius2_m2 = all(t.radius2_m2);
  std::uint64_t near_count = 0;
  for (std::uint32_t b = bucket.last_block; b != 0; b = t.next_block[b]) {
    std::uint32_t near = near_bits(t.blocks[b], p_m, radius2_m2);
    near_count += static_cast<std::uint64_t>(__builtin_popcount(near));
    if (bucket.has_one_voxel) continue;
    for (; near != 0; near &= near - 1) {
      ++voxels[t.blocks[b].slot[__builtin_ctz(near)]].neighbour_sum;
    }
  }
  if (bucket.has_one_voxel) voxels[bucket.slot].neighbour_sum += near_count;
  return near_count;
}

std::uint64_t count_neighbours(const CloudTable& t, const float* point_m, const CellBox& cells,
                               VoxelPoints* voxels) {
  const Floats p_m[3] = {all(point_m[0]), all(point_m[1]), all(point_m[2])};
  std::uint64_t near_count = 0;
  for (std::int64_t z = cells.low[2]; z <= cells.high[2]; ++z) {
    for (std::int64_t y = cells.low[1]; y <= cells.high[1]; ++y) {
      const std::uint32_t* const row = t.bucket_at + (z * t.cells[1] + y) * t.cells[0];
      for (std::int64_t x = cells.low[0]; x <= cells.high[0]; ++x) {
        if (row[x] != 0) near_count += count_in_bucket(t, t.buckets[row[x]], p_m, voxels);
      }
    }
  }
  return near_count;
}

}  // namespace

namespace GNBV_SIMD_LEVEL {

const CloudKernels kCloudKernels = {find_untaken, count_neighbours};

}  // namespace GNBV_SIMD_LEVEL
}  // namespace gnbv
