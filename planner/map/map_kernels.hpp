// The hot loops of the map, compiled once for each SimdLevel (frame_loops.cpp, fan_loops.cpp,
// cloud_loops.cpp), and the plain structs that they share with their callers (sim/core/lanes.hpp
// says why plain). The caller owns the memory and knows the frames.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/core/simd.hpp"

namespace gnbv {

constexpr int kPadding = 16;  // elements that a loop may read or write beyond a row: one vector

// ---- what is known of a voxel -------------------------------------------------------------------

enum class VoxelState : std::uint8_t { unknown = 0, free = 1, occupied = 2 };

/// All that the rays of a candidate view ask of a voxel, in one load (one lane of a gather):
/// bits 0-1: VoxelState; bit 2: a scan has touched the voxel; bit 3: symmetry predicts surface;
/// bit 4: in the shadow band behind a surface; the first measurement clears bits 3 and 4;
/// bit 5: outside the object bounds, where nothing counts: its entropy is 0;
/// bits 8-31: ln 2 minus the entropy, Eq. (1), in 2^-24 nat. An untouched voxel inside has 0.
using VoxelWord = std::uint32_t;
constexpr VoxelWord kStateMask = 3U;
constexpr VoxelWord kMeasuredBit = 4U;
constexpr VoxelWord kPredictedBit = 8U;
constexpr VoxelWord kShadowBit = 16U;
constexpr VoxelWord kOutsideBit = 32U;
constexpr unsigned kKnownShift = 8;
constexpr std::uint32_t kLn2Units = 11629080;  // ln 2 in 2^-24 nat; exactly float32's ln 2
constexpr double kEntropyUnit_nat = 0x1p-24;

constexpr VoxelState state_of(VoxelWord word) { return static_cast<VoxelState>(word & kStateMask); }
/// Eq. (1) in 2^-24 nat. An integer, so that sums do not depend on their order.
constexpr std::uint32_t entropy_units_of(VoxelWord word) {
  return kLn2Units - (word >> kKnownShift);
}
constexpr VoxelWord measured_word(VoxelState state, std::uint32_t entropy_units) {
  return static_cast<VoxelWord>(state) | kMeasuredBit | (kLn2Units - entropy_units) << kKnownShift;
}

// ---- depth frames (frame_loops.cpp) -------------------------------------------------------------

/// What a pixel without a return says: all is free up to range_max_m (the released code), or
/// nothing.
enum class NoReturn { free, unknown };

/// What a pixel of a depth frame says. The rules are the released code's, see FIDELITY.md.
enum class PixelRay : std::uint8_t {
  none = 0,    // kInvalidRange, nearer than range_min_m, or NoReturn::unknown: says nothing
  clears = 1,  // no return, or beyond range_max_m (a plane), or below the floor: free up to the end
  hits = 2     // free up to the end, which is surface
};

/// A row of pixels that become rays: end = origin + depth * (across[u] + down), world.
struct PixelRow {
  const float* depth_m;  // (width)
  int width;
  const double* across[3];  // (width + kPadding), metres per metre of depth
  double down[3], origin_m[3];
  double range_max_m, floor_z_m;
  float range_min_m, range_max_compared_m;  // depths are compared as float32
  float says_until_m;                       // infinite: no return says something, too
  float* end_m[3];                          // (width), out
  PixelRay* kind;                           // (width), out
  float* inverse_depth;  // (width + kPadding), out: 1 / depth of the end, infinite without a ray
};

/// A row of ray ends (width), world.
struct EndRow {
  const float* end_m[3];
  const PixelRay* kind;
};

constexpr int kTile_px = 8;  // side of the squares of pixels of which the furthest depth is kept

/// A frame as the voxels see it. World coordinates here are relative to the camera, and keys along
/// an axis of the box begin with 0 at min_key.
struct FrameView {
  // the map before the frame; a miss changes nothing of voxels with the settled word
  const VoxelWord* words;
  VoxelWord settled_word;
  const float* inverse_depth;  // PixelRow's, padded with infinity to row_stride
  int width, height, row_stride;
  // tile_windows[level * level_stride + ty * tile_stride + tx]: the least inverse depth of the
  // 2^level x 2^level tiles from (tx, ty) on
  const float* tile_windows;
  int tile_stride, level_stride;
  float toward[3], right[3], down[3];  // pixel (u, v) looks along toward + u right + v down
  float camera_axis[3][3];             // unit x, y and z axes of the camera, world
  float focal_px[2], center_px[2];     // pixel = focal * x / z + center
  float center_slack;  // per metre, at most, from a point of the image to the nearest pixel
  float half_voxel_m, margin_m;
  float extent_m[3];   // along each camera axis: half of a voxel, and the margin
  double plane[6][4];  // (n, d): centres of voxels that the pyramid of rays meets have n p + d >= 0
  double origin_m[3];
  double resolution_m, inverse_resolution;
  int min_key[3], size[3], camera_key[3];
  float lower_border_m[3], upper_border_m[3];  // RayOrigin's
  float direction_slack;          // of OctoMap's rounded direction of a ray, per metre of depth
  int box_first[3], box_last[3];  // voxels that rays can reach
};

/// What one thread writes.
struct FrameMarks {
  std::uint8_t* voxel;   // of the whole grid: kUntouched or kEnd before, some kFreed after
  std::uint8_t* walk;    // (height, width): set to 1 for rays that have to be walked
  std::int32_t* doubts;  // (height * width + kPadding), scratch
};
constexpr std::uint8_t kUntouched = 0;
constexpr std::uint8_t kFreed = 1;
constexpr std::uint8_t kEnd = 2;

struct FrameKernels {
  void (*rays_of_row)(const PixelRow& row);
  /// Writes the indices of the grid's voxels that hold the ends of hits to `voxels`
  /// (width + kPadding) and returns how many. Neighbours in the row list a voxel once.
  int (*ends_of_row)(const FrameView& view, const EndRow& row, std::int32_t* voxels);
  /// Frees the voxels of a layer (z from min_key) that a ray is sure to pass, but not settled ones.
  /// Of the others, asks for a walk of each ray that might pass one.
  void (*project_layer)(const FrameView& view, int layer, const FrameMarks& marks);
};
GNBV_KERNELS(FrameKernels, frame_kernels)

// ---- rays of a scan (fan_loops.cpp) -------------------------------------------------------------

/// Marks of the voxels of a grid with a frame one voxel wide around it.
constexpr std::uint8_t kFanUnlisted = 0;
constexpr std::uint8_t kFanListed = 1;
constexpr std::uint8_t kFanFrame = 2;

constexpr std::size_t kFanBundle = 16;  // rays that are walked by one call

/// A bundle of RaySteps in columns. Places are indices of the framed grid. Each ray begins at a
/// place that is listed already. One of length -RaySteps::kNever takes no step.
struct FanRays {
  double t_next[3][kFanBundle], t_voxel[3][kFanBundle];
  double length_m[kFanBundle];
  std::int64_t place[kFanBundle], move[3][kFanBundle];
  std::int64_t end[kFanBundle];  // where the walk stops; -1: not in the grid
};

struct FanKernels {
  /// Walks every ray to its end or to the frame and marks what it crosses. Writes the places that
  /// were not marked to `listed`, which has room for a place a step and one more, and returns how
  /// many. Rays that have ended wait at `resting`, a place marked as listed.
  std::size_t (*walk)(const FanRays& rays, std::int32_t resting, std::uint8_t* marks,
                      std::int32_t* listed);
};
GNBV_KERNELS(FanKernels, fan_kernels)

// ---- points of the cloud (cloud_loops.cpp) ------------------------------------------------------

constexpr std::uint32_t kPointsPerBlock = 16;

/// Points of one bucket, in columns; unused places lie at infinity.
struct alignas(64) PointBlock {
  float p_m[3][kPointsPerBlock];
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

/// The points of the cloud. Space is cut into cells, x fastest, each of which may have a bucket.
/// Bucket 0 and block 0 hold nothing.
struct CloudTable {
  const std::uint32_t* bucket_at;  // of each cell
  const std::uint32_t* taken;      // words_per_bucket for each bucket, a bit a leaf with a point
  const CloudBucket* buckets;
  const PointBlock* blocks;
  const std::uint32_t* next_block;  // in the same bucket
  std::int32_t words_per_bucket;
  std::int32_t leaves_per_bucket;  // a side, at most 64
  std::int32_t first_bucket[3];    // where the cells begin
  std::int32_t cells[3];           // along each axis
  float inverse_leaf_1_m;
  float low_m[3], high_m[3];  // the workspace, both ends inside
  float radius2_m2;
};

/// Cells from low to high, both included.
struct CellBox {
  std::int32_t low[3], high[3];
};

struct CloudKernels {
  /// Of `count` pixels, finds the hits inside the workspace in leaves that are not taken. Writes
  /// their indices, ascending, to `out` (count rounded up to kPadding) and returns how many.
  std::size_t (*find_untaken)(const CloudTable& table, const EndRow& pixels, int count,
                              std::int32_t* out);
  /// Counts the points of the cells within the radius of a point (SurfaceCloud's float32
  /// comparison) and adds 1 to neighbour_sum of the voxel of each, in `voxels` by slot.
  std::uint64_t (*count_neighbours)(const CloudTable& table, const float* p_m, const CellBox& cells,
                                    VoxelPoints* voxels);
};
GNBV_KERNELS(CloudKernels, cloud_kernels)

}  // namespace gnbv
