// The frame kernels, once for each SimdLevel; here those of pixels, the others in voxel_loops.hpp.
#include "planner/map/voxel_loops.hpp"

namespace gnbv {
namespace {

inline Mask has_ray(const PixelRow& row, Floats depth_m) {
  return less_equal(all(row.range_min_m), depth_m);
}
inline Mask has_return(const PixelRow& row, Floats depth_m) {
  return less_equal(depth_m, all(row.range_max_compared_m));
}

void rays_of_row(const PixelRow& given) {
  const PixelRow row = given;  // no output can be part of it
  constexpr int kClears = static_cast<int>(PixelRay::clears);
  constexpr int kHits = static_cast<int>(PixelRay::hits);
  const Doubles infinite = all(static_cast<double>(__builtin_inff()));
  for_lanes(row.width, [&](int u, int left) {
    const Floats depth_m = load(row.depth_m + u, left);
    const Mask is_return = has_return(row, depth_m);
    const Doubles returned_m = widen(select(is_return, depth_m, all(__builtin_inff())));
    const Doubles along_m = select_less(returned_m, infinite, returned_m, all(row.range_max_m));
    Doubles p_m = along_m;
    for (int a = 0; a < 3; ++a) {
      p_m = all(row.origin_m[a]) + along_m * (load(row.across[a] + u) + all(row.down[a]));
      store(row.end_m[a] + u, narrow(p_m), left);
    }
    // p_m is the height now
    const Floats height = narrow(select_less(p_m, all(row.floor_z_m), all(-1.0), all(1.0)));
    const Ints says = select(is_return & less(all(0.0F), height), all(kHits), all(kClears));
    store_bytes(row.kind + u, select(has_ray(row, depth_m), says, all(0)), left);
  });
}

/// Index of each lane's voxel; -1 without a hit in the grid.
HWY_INLINE Ints voxels_of_ends(const EndRow& row, int u, int left) {
  Mask inside = equal_bytes(row.kind + u, static_cast<std::uint8_t>(PixelRay::hits), left);
  Ints index = all(0);
  for (int a = 2; a >= 0; --a) {
    const Ints key = floored(widen(load(row.end_m[a] + u, left)) * all(row.inverse_resolution));
    const Ints from_min = key - all(row.min_key[a]);
    inside = without(inside, less(from_min, all(0))) & less(from_min, all(row.size[a]));
    index = index * all(row.size[a]) + from_min;
  }
  return select(inside, index, all(-1));
}

int ends_of_row(const EndRow& given, std::int32_t* voxels) {
  const EndRow row = given;
  std::int32_t* const voxel = row.scratch + 1;  // before it stands the pixel before the first one
  row.scratch[0] = -1;
  for_lanes(row.width, [&](int u, int left) { store(voxel + u, voxels_of_ends(row, u, left)); });
  int count = 0;
  for (int u = 0; u < row.width; u += kLanes) {
    const Ints here = load(voxel + u);
    const Mask is_known = equal(here, load(voxel + u - 1)) | equal(here, all(-1));
    const Mask is_new = without(every_lane(), is_known);
    if (any(is_new)) count += pack(is_new, here, voxels + count);
  }
  return count;
}

void invert_row(const PixelRow& row, float* inverse_depth, int padded_width) {
  const Floats range_max_m = all(static_cast<float>(row.range_max_m));
  const Floats none = all(__builtin_inff());
  for_lanes(row.width, [&](int u, int left) {
    const Floats depth_m = load(row.depth_m + u, left);
    const Floats along_m = select(has_return(row, depth_m), depth_m, range_max_m);
    store(inverse_depth + u, select(has_ray(row, depth_m), all(1.0F) / along_m, none));
  });
  for (int u = row.width; u < padded_width; ++u) inverse_depth[u] = __builtin_inff();
}

}  // namespace

namespace GNBV_SIMD_LEVEL {

const FrameKernels kFrameKernels = {.rays_of_row = rays_of_row,
                                    .ends_of_row = ends_of_row,
                                    .invert_row = invert_row,
                                    .project_layer = project_layer};

}  // namespace GNBV_SIMD_LEVEL
}  // namespace gnbv
