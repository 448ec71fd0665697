// The cloud kernels, once for each SimdLevel.
#include "planner/map/cloud_kernels.hpp"
#include "planner/map/frame_kernels.hpp"
#include "sim/core/lanes.hpp"

namespace gnbv {
namespace {

/// Cell and place in the bucket along one axis. The quotient is exact: s + 1/2 is at least 1 / 128
/// of a bucket from its ends, and with at most 2^16 cells the rounding stays below that.
struct AlongAxis {
  Ints cell, in_bucket;
};
inline AlongAxis along_axis(const LeafTable& t, int axis, Floats p_m) {
  const Ints s = floored(p_m * all(t.inverse_leaf_1_m)) - all(t.first_leaf[axis]);
  const float inverse = 1.0F / static_cast<float>(t.leaves_per_bucket);
  const Ints cell = truncated((to_floats(s) + all(0.5F)) * all(inverse));
  return {cell, s - cell * all(t.leaves_per_bucket)};
}

inline Ints combine(Ints z, Ints y, Ints x, std::int32_t y_count, std::int32_t x_count) {
  return (z * all(y_count) + y) * all(x_count) + x;
}

/// Those of `wanted` whose leaf is not taken.
inline Mask untaken(const LeafTable& t, Mask wanted, const Floats p_m[3]) {
  const AlongAxis x = along_axis(t, 0, p_m[0]);
  const AlongAxis y = along_axis(t, 1, p_m[1]);
  const AlongAxis z = along_axis(t, 2, p_m[2]);
  const std::int32_t n = t.leaves_per_bucket;
  const Ints bit = combine(z.in_bucket, y.in_bucket, x.in_bucket, n, n);
  const Ints bucket =
      gather(wanted, t.bucket_at, combine(z.cell, y.cell, x.cell, t.cells[1], t.cells[0]));
  const Ints word = gather(wanted, t.taken, bucket * all(t.words_per_bucket) + shift_right<5>(bit));
  return wanted & has_none(word, all(1) << (bit & all(31)));
}

std::size_t find_untaken(const LeafTable& table, const PixelColumns& pixels, std::size_t begin,
                         std::size_t end, std::int32_t* out) {
  std::int32_t* next = out;
  for_lanes(static_cast<int>(end - begin), [&](int from_begin, int left) {
    const std::size_t i = begin + static_cast<std::size_t>(from_begin);
    Mask wanted = equal_bytes(pixels.kind + i, static_cast<std::uint8_t>(PixelRay::hits), left);
    if (!any(wanted)) return;
    Floats p_m[3];
    for (int a = 0; a < 3; ++a) {
      p_m[a] = load(pixels.p_m[a] + i, left);
      wanted = wanted & less_equal(all(table.low_m[a]), p_m[a]) &
               less_equal(p_m[a], all(table.high_m[a]));
    }
    const Ints pixel = all(static_cast<std::int32_t>(i)) + int_ramp();
    next += pack(untaken(table, wanted, p_m), pixel, next);
  });
  return static_cast<std::size_t>(next - out);
}

/// A bit for each point within the radius.
inline std::uint32_t near_bits(const PointBlock& block, const Floats p_m[3], Floats radius2_m2) {
  std::uint32_t near = 0;
  for (std::uint32_t first = 0; first < kPointsPerBlock; first += kLanes) {
    const Floats dx = load(block.x_m + first) - p_m[0];
    const Floats dy = load(block.y_m + first) - p_m[1];
    const Floats dz = load(block.z_m + first) - p_m[2];
    near |= bits(less_equal(dx * dx + dy * dy + dz * dz, radius2_m2)) << first;
  }
  return near;
}

/// Of one bucket.
inline std::uint64_t count_in_bucket(const PointTable& t, const CloudBucket& bucket,
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

std::uint64_t count_neighbours(const PointTable& table, const float* point_m, const CellBox& cells,
                               VoxelPoints* voxels) {
  const Floats p_m[3] = {all(point_m[0]), all(point_m[1]), all(point_m[2])};
  std::uint64_t near_count = 0;
  for (std::size_t z = cells.low[2]; z <= cells.high[2]; ++z) {
    for (std::size_t y = cells.low[1]; y <= cells.high[1]; ++y) {
      const std::uint32_t* const row = table.bucket_at + (z * table.cells_y + y) * table.cells_x;
      for (std::size_t x = cells.low[0]; x <= cells.high[0]; ++x) {
        if (row[x] != 0) near_count += count_in_bucket(table, table.buckets[row[x]], p_m, voxels);
      }
    }
  }
  return near_count;
}

}  // namespace
}  // namespace gnbv

namespace gnbv::GNBV_SIMD_LEVEL {

const CloudKernels kCloudKernels = {find_untaken, count_neighbours};

}  // namespace gnbv::GNBV_SIMD_LEVEL
