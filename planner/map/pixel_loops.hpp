// Loops over the pixels of a frame. For frame_loops.cpp alone.
#pragma once

#include "planner/map/frame_kernels.hpp"
#include "planner/map/pixel_ray.hpp"
#include "sim/core/lanes.hpp"

namespace gnbv {
namespace {

inline Mask has_ray(const PixelRow& row, Floats depth_m) {
  return less_equal(all(row.range_min_m), depth_m);
}
inline Mask has_return(const PixelRow& row, Floats depth_m) {
  return less_equal(depth_m, all(row.range_max_compared_m));
}

/// kLanes pixels from column u; the outputs at these pixels.
inline void rays_of_pixels(const PixelRow& row, int u, Floats depth_m, float* const end_m[3],
                           std::uint8_t* kind) {
  const Mask is_return = has_return(row, depth_m);
  const Doubles infinite = all(static_cast<double>(__builtin_inff()));
  const Doubles returned_m = widen(select(is_return, depth_m, all(__builtin_inff())));
  const Doubles along_m = select_less(returned_m, infinite, returned_m, all(row.range_max_m));
  Doubles p_m = along_m;
  for (int a = 0; a < 3; ++a) {
    p_m = all(row.origin_m[a]) + along_m * (load(row.across[a] + u) + all(row.down[a]));
    store(end_m[a], narrow(p_m));
  }
  constexpr int kClears = static_cast<int>(PixelRay::clears);
  constexpr int kHits = static_cast<int>(PixelRay::hits);
  // of the last axis, z
  const Ints above_floor =
      truncated(select_less(p_m, all(row.floor_z_m), all(double{kClears}), all(double{kHits})));
  const Ints says = select(is_return, above_floor, all(kClears));
  store_bytes(kind, select(has_ray(row, depth_m), says, all(0)));
}

void rays_of_row(const PixelRow& row) {
  int u = 0;
  for (; u + kLanes <= row.width; u += kLanes) {
    float* const end_m[3] = {row.end_m[0] + u, row.end_m[1] + u, row.end_m[2] + u};
    rays_of_pixels(row, u, load(row.depth_m + u), end_m, row.kind + u);
  }
  const int left = row.width - u;
  if (left == 0) return;
  const Tail<float> depth_m(row.depth_m + u, left);
  Tail<float> end_m[3];
  Tail<std::uint8_t> kind;
  float* const ends_m[3] = {end_m[0].at, end_m[1].at, end_m[2].at};
  rays_of_pixels(row, u, load(depth_m.at), ends_m, kind.at);
  for (int a = 0; a < 3; ++a) end_m[a].copy_to(row.end_m[a] + u, left);
  kind.copy_to(row.kind + u, left);
}

/// Index of each lane's voxel; -1 without a hit in the grid.
inline Ints voxels_of_ends(const EndRow& row, const float* const end_m[3],
                           const std::uint8_t* kind) {
  Mask inside = equal_bytes(kind, static_cast<std::uint8_t>(PixelRay::hits));
  Ints index = all(0);
  for (int a = 2; a >= 0; --a) {
    const Ints key = floored(widen(load(end_m[a])) * all(row.inverse_resolution));
    const Ints from_min = key - all(row.min_key[a]);
    inside = without(inside, less(from_min, all(0))) & less(from_min, all(row.size[a]));
    index = index * all(row.size[a]) + from_min;
  }
  return select(inside, index, all(-1));
}

int ends_of_row(const EndRow& row, std::uint32_t* voxels) {
  std::int32_t* const voxel = row.scratch + 1;
  row.scratch[0] = -1;
  int u = 0;
  for (; u + kLanes <= row.width; u += kLanes) {
    const float* const end_m[3] = {row.end_m[0] + u, row.end_m[1] + u, row.end_m[2] + u};
    store(voxel + u, voxels_of_ends(row, end_m, row.kind + u));
  }
  const int left = row.width - u;
  if (left > 0) {
    const Tail<float> x_m(row.end_m[0] + u, left);
    const Tail<float> y_m(row.end_m[1] + u, left);
    const Tail<float> z_m(row.end_m[2] + u, left);
    const float* const end_m[3] = {x_m.at, y_m.at, z_m.at};
    const Tail<std::uint8_t> kind(row.kind + u, left);
    store(voxel + u, voxels_of_ends(row, end_m, kind.at));
  }
  int count = 0;
  for (u = 0; u < row.width; u += kLanes) {
    const Ints here = load(voxel + u);
    const Mask is_known = equal(here, load(voxel + u - 1)) | equal(here, all(-1));
    for (std::uint32_t lanes = bits(without(every_lane(), is_known)); lanes != 0;
         lanes &= lanes - 1) {
      voxels[count++] = static_cast<std::uint32_t>(voxel[u + __builtin_ctz(lanes)]);
    }
  }
  return count;
}

inline Floats inverse_of(const PixelRow& row, Floats depth_m) {
  const Floats range_max_m = all(static_cast<float>(row.range_max_m));
  const Floats along_m = select(has_return(row, depth_m), depth_m, range_max_m);
  return select(has_ray(row, depth_m), all(1.0F) / along_m, all(__builtin_inff()));
}

void invert_row(const PixelRow& row, float* inverse_depth, int padded_width) {
  int u = 0;
  for (; u + kLanes <= row.width; u += kLanes) {
    store(inverse_depth + u, inverse_of(row, load(row.depth_m + u)));
  }
  if (u < row.width) {
    const Tail<float> depth_m(row.depth_m + u, row.width - u);
    store(inverse_depth + u, inverse_of(row, load(depth_m.at)));
  }
  for (u = row.width; u < padded_width; ++u) inverse_depth[u] = __builtin_inff();
}

}  // namespace
}  // namespace gnbv
