// The two hot loops of SurfaceCloud, compiled once for each SimdLevel (cloud_loops.cpp). Plain
// structs and pointers only, see sim/core/lanes.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/core/simd.hpp"

namespace gnbv {

constexpr std::uint32_t kPointsPerBlock = 16;

/// Points of one bucket, in columns; unused places lie at infinity.
struct alignas(64) PointBlock {
  float x_m[kPointsPerBlock], y_m[kPointsPerBlock], z_m[kPointsPerBlock];
  std::uint32_t slot[kPointsPerBlock];  // of the point's voxel
};

/// A cube of leaves, at least a search radius wide.
struct CloudBucket {
  std::uint32_t last_block = 0;  // 0: none
  std::uint32_t last_count = 0;  // points in that block
  std::uint32_t slot = 0;        // of the voxel of all its points, if
  bool has_one_voxel = true;
};

/// What is counted of a voxel that holds points.
struct VoxelPoints {
  std::uint64_t neighbour_sum = 0;
  std::uint32_t point_count = 0;
};

/// Which leaves hold a point. Cells of buckets are x fastest; bucket 0 holds nothing.
struct LeafTable {
  const std::uint32_t* bucket_at;  // of each cell
  const std::uint32_t* taken;      // words_per_bucket for each bucket, a bit a leaf
  std::int32_t words_per_bucket;
  std::int32_t leaves_per_bucket;  // a side, at most 64
  std::int32_t first_leaf[3];      // where the cells begin
  std::int32_t cells[3];           // along each axis
  float inverse_leaf_1_m;
  float low_m[3], high_m[3];  // the workspace, both ends inside
};

/// The points of a frame, column by column.
struct PixelColumns {
  const float* p_m[3];
  const std::uint8_t* kind;  // PixelRay
};

/// The points of the cloud, found by cells.
struct PointTable {
  const std::uint32_t* bucket_at;
  const CloudBucket* buckets;
  const PointBlock* blocks;         // block 0 is none
  const std::uint32_t* next_block;  // in the same bucket
  std::size_t cells_x, cells_y;
  float radius2_m2;
};

/// Cells from low to high, both included.
struct CellBox {
  std::size_t low[3], high[3];
};

struct CloudKernels {
  /// Writes the indices, ascending, of those pixels from `begin` up to `end` that are hits inside
  /// the workspace in leaves not taken, and returns how many. `out` has room for `end` - `begin`
  /// numbers, rounded up to 16.
  std::size_t (*find_untaken)(const LeafTable& table, const PixelColumns& pixels, std::size_t begin,
                              std::size_t end, std::int32_t* out);
  /// Counts the points of the cells within the radius of a point (SurfaceCloud's float32
  /// comparison) and adds 1 to neighbour_sum of the voxel of each, in `voxels` by slot.
  std::uint64_t (*count_neighbours)(const PointTable& table, const float* p_m, const CellBox& cells,
                                    VoxelPoints* voxels);
};

GNBV_KERNELS(CloudKernels, cloud_kernels)

}  // namespace gnbv
