// The loops of map insertion, compiled once for each SimdLevel (frame_loops.cpp): plain pointers
// in, plain pointers out. Whoever calls them owns the memory and knows the frames.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/core/simd.hpp"

namespace gnbv {

/// What a pixel of a depth frame says. The rules are the released code's, see FIDELITY.md.
enum class PixelRay : std::uint8_t {
  none = 0,    // kInvalidRange, or nearer than range_min_m: says nothing
  clears = 1,  // no return, or beyond range_max_m (a plane), or below the floor: free up to the end
  hits = 2     // free up to the end, which is surface
};

constexpr int kPadding = 16;  // elements a row may be read beyond its end: one vector
constexpr int kTile_px = 8;   // side of the squares of which the furthest depth is kept

/// What one row of pixels needs to become rays: end = origin + depth * (across[u] + down).
struct PixelRow {
  const float* depth_m;  // (width)
  int width;
  const double* across[3];  // (width + kPadding), world, metres per metre of depth
  double down[3];
  double origin_m[3];
  double range_max_m;
  double floor_z_m;
  float range_min_m;  // as compared with depths
  float range_max_compared_m;
  float* end_m[3];     // (width), out, world
  std::uint8_t* kind;  // (width), out, PixelRay
};

/// What a row of ray ends needs to become voxels.
struct EndRow {
  const float* end_m[3];  // (width), world
  const std::uint8_t* kind;
  int width;
  double inverse_resolution;
  std::int32_t min_key[3];
  std::int32_t size[3];
  std::int32_t* scratch;  // (width + 1 + kPadding)
};

/// A frame as the voxels see it. World coordinates here are relative to the camera.
struct FrameView {
  // the map before the frame; voxels of the settled word are passed over, as a miss changes nothing
  // of them
  const std::uint32_t* words;
  std::uint32_t settled_word;
  // 1 / depth of each pixel's end, infinite without a ray; rows padded with infinity
  const float* inverse_depth;
  int width, height, row_stride;
  // tile_windows[level] + ty * tile_stride + tx: the least inverse depth of the 2^level x 2^level
  // tiles from (tx, ty) on
  const float* tile_windows;
  int tile_stride, level_stride;
  // direction of pixel (u, v), per metre of depth: toward + u * right + v * down
  float toward[3], right[3], down[3];
  float camera_axis[3][3];          // unit x, y and z axes of the camera, world
  float focal_px[2], center_px[2];  // pixel = focal * x / z + center
  float center_slack;  // from a point of the image to the nearest pixel, at most, per metre
  float half_voxel_m, margin_m;
  float extent_m[3];   // half of a voxel's extent along each camera axis, and the margin
  double plane[6][4];  // (n, d): centres of voxels that the pyramid of rays meets have n p + d >= 0
  double origin_m[3];
  double resolution_m;
  int min_key[3], size[3];
  int camera_key[3];
  // OctoMap's distances from the camera to the borders of its voxel, negative and positive; and by
  // how much, per metre of depth, OctoMap's rounded direction of a ray may differ from its pixel's
  float lower_border_m[3], upper_border_m[3], direction_slack;
  int box_first[3], box_last[3];  // voxels from min_key that rays can reach
};

/// What one thread writes.
struct FrameMarks {
  std::uint8_t* voxel;   // of the whole grid; kUntouched or kEnd before, some kFreed after
  std::uint8_t* walk;    // (height, width): set to 1 for rays that have to be walked
  std::int32_t* doubts;  // (height * width + kPadding), scratch
};
constexpr std::uint8_t kUntouched = 0;
constexpr std::uint8_t kFreed = 1;
constexpr std::uint8_t kEnd = 2;

struct FrameKernels {
  void (*rays_of_row)(const PixelRow& row);
  /// Writes to `voxels` (width + kPadding) the indices of those in the grid that hold the ends of
  /// hits, without repeating one from pixel to pixel, and returns how many.
  int (*ends_of_row)(const EndRow& row, std::int32_t* voxels);
  /// `inverse_depth` (width + padding to a whole tile and kPadding): see FrameView.
  void (*invert_row)(const PixelRow& row, float* inverse_depth, int padded_width);
  /// Frees the voxels of a layer (z from min_key) that some ray is proven to pass, but not settled
  /// ones. Of the others, asks for a walk of every ray that might pass one.
  void (*project_layer)(const FrameView& view, int layer, const FrameMarks& marks);
};

GNBV_KERNELS(FrameKernels, frame_kernels)

}  // namespace gnbv
