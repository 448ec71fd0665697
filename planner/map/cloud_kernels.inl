// What the levels of cloud_kernels.hpp have in common. The including unit defines, in the namespace
// of its level, near_mask(block, p_m, radius2_m2), a bit a point, and find_in_lanes(), which treats
// whole vectors from the front and returns where it stopped; then it includes this in the same one.

inline std::uint32_t bit_count(std::uint32_t mask) {
#ifdef __POPCNT__
  return static_cast<std::uint32_t>(__builtin_popcount(mask));
#else  // of 16 bits; the baseline would call a library
  mask = mask - (mask >> 1 & 0x5555U);
  mask = (mask & 0x3333U) + (mask >> 2 & 0x3333U);
  mask = (mask + (mask >> 4)) & 0x0f0fU;
  return (mask + (mask >> 8)) & 0x1fU;
#endif
}

/// Cell and place in the bucket along one axis. The quotient is exact: s + 1/2 is at least 1 / 128
/// of a bucket from its ends, and with at most 2^16 cells the rounding stays below that.
struct AlongAxis {
  std::int32_t cell, in_bucket;
};
inline AlongAxis along_axis(const LeafTable& t, int axis, float p_m) {
  const float scaled = p_m * t.inverse_leaf_1_m;
  const auto truncated = static_cast<std::int32_t>(scaled);
  const std::int32_t leaf =
      truncated - static_cast<std::int32_t>(scaled < static_cast<float>(truncated));
  const std::int32_t s = leaf - t.first_leaf[axis];
  const auto cell = static_cast<std::int32_t>((static_cast<float>(s) + 0.5F) *
                                              (1.0F / static_cast<float>(t.leaves_per_bucket)));
  return {cell, s - cell * t.leaves_per_bucket};
}

inline bool is_untaken(const LeafTable& t, float x_m, float y_m, float z_m) {
  if (!(x_m >= t.low_m[0] && x_m <= t.high_m[0] && y_m >= t.low_m[1] && y_m <= t.high_m[1] &&
        z_m >= t.low_m[2] && z_m <= t.high_m[2])) {
    return false;
  }
  const AlongAxis x = along_axis(t, 0, x_m);
  const AlongAxis y = along_axis(t, 1, y_m);
  const AlongAxis z = along_axis(t, 2, z_m);
  const std::uint32_t bucket = t.bucket_at[(z.cell * t.cells_y + y.cell) * t.cells_x + x.cell];
  const std::int32_t n = t.leaves_per_bucket;
  const auto bit = static_cast<std::uint32_t>((z.in_bucket * n + y.in_bucket) * n + x.in_bucket);
  const std::uint32_t word =
      t.taken[bucket * static_cast<std::uint32_t>(t.words_per_bucket) + bit / 32];
  return (word >> bit % 32 & 1U) == 0;
}

std::size_t find_untaken(const LeafTable& table, const PixelColumns& pixels, std::size_t begin,
                         std::size_t end, std::uint32_t* out) {
  std::size_t found = 0;
  for (std::size_t i = find_in_lanes(table, pixels, begin, end, out, found); i < end; ++i) {
    if (pixels.kind[i] != pixels.hits) continue;
    if (!is_untaken(table, pixels.x_m[i], pixels.y_m[i], pixels.z_m[i])) continue;
    out[found++] = static_cast<std::uint32_t>(i);
  }
  return found;
}

/// Of one bucket.
inline std::uint64_t count_in_bucket(const PointTable& t, const CloudBucket& bucket,
                                     const float* p_m, VoxelPoints* voxels) {
  std::uint64_t near = 0;
  for (std::uint32_t b = bucket.last_block; b != 0; b = t.next_block[b]) {
    std::uint32_t mask = near_mask(t.blocks[b], p_m, t.radius2_m2);
    near += bit_count(mask);
    if (bucket.has_one_voxel) continue;
    for (; mask != 0; mask &= mask - 1) {
      ++voxels[t.blocks[b].slot[__builtin_ctz(mask)]].neighbour_sum;
    }
  }
  if (bucket.has_one_voxel) voxels[bucket.slot].neighbour_sum += near;
  return near;
}

std::uint64_t count_neighbours(const PointTable& table, const float* p_m, const CellBox& cells,
                               VoxelPoints* voxels) {
  std::uint64_t near = 0;
  for (std::size_t z = cells.low[2]; z <= cells.high[2]; ++z) {
    for (std::size_t y = cells.low[1]; y <= cells.high[1]; ++y) {
      const std::uint32_t* const row = table.bucket_at + (z * table.cells_y + y) * table.cells_x;
      for (std::size_t x = cells.low[0]; x <= cells.high[0]; ++x) {
        if (row[x] != 0) near += count_in_bucket(table, table.buckets[row[x]], p_m, voxels);
      }
    }
  }
  return near;
}
