// The frame kernels: pixels become rays, and voxels find the rays that pass them.
//
// A row of voxels along x is asked, kLanes at a time, in the order of what it costs:
// 1. clip: the row is cut to the pyramid of rays (six planes).
// 2. passed_at_center: take the pixel nearest to a voxel's centre. If its ray runs through the ball
//    in the voxel, goes deeper than the centre and ends outside the voxel, it passes the voxel.
// 3. hidden: the corners of a voxel bound the pixels whose rays can meet it (pixel_box). If all of
//    them end before its nearest depth, none passes it. Four overlapping windows of 2^k x 2^k tiles
//    cover these pixels, and the furthest depth of each window is known.
// 4. is_passed (cone_loops.hpp) looks at the rays one by one. Those that rounding leaves in doubt
//    are walked later, as OctoMap walks them.
#include "planner/map/cone_loops.hpp"

namespace gnbv {
namespace {

// ---- pixels -------------------------------------------------------------------------------------

void rays_of_row(const PixelRow& given) {
  const PixelRow row = given;  // no output can be part of it
  constexpr int kClears = static_cast<int>(PixelRay::clears);
  constexpr int kHits = static_cast<int>(PixelRay::hits);
  const Doubles infinite = all(static_cast<double>(__builtin_inff()));
  const float range_max_m = static_cast<float>(row.range_max_m);
  for_lanes(row.width, [&](int u, int left) {
    const Floats depth_m = load(row.depth_m + u, left);
    const Mask has_ray =
        less_equal(all(row.range_min_m), depth_m) & less_equal(depth_m, all(row.says_until_m));
    const Mask is_return = less_equal(depth_m, all(row.range_max_compared_m));
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
    store_bytes(reinterpret_cast<std::uint8_t*>(row.kind) + u, select(has_ray, says, all(0)), left);
    const Floats inverse = all(1.0F) / select(is_return, depth_m, all(range_max_m));
    store(row.inverse_depth + u, select(has_ray, inverse, all(__builtin_inff())));
  });
}

/// Index of each lane's voxel; -1 without a hit in the grid.
HWY_INLINE Ints voxels_of_ends(const FrameView& view, const EndRow& row, int u, int left) {
  const auto* const kind = reinterpret_cast<const std::uint8_t*>(row.kind);
  Mask inside = equal_bytes(kind + u, static_cast<std::uint8_t>(PixelRay::hits), left);
  Ints index = all(0);
  for (int a = 2; a >= 0; --a) {
    const Ints key = floored(widen(load(row.end_m[a] + u, left)) * all(view.inverse_resolution));
    const Ints from_min = key - all(view.min_key[a]);
    inside = without(inside, less(from_min, all(0))) & less(from_min, all(view.size[a]));
    index = index * all(view.size[a]) + from_min;
  }
  return select(inside, index, all(-1));
}

int ends_of_row(const FrameView& view, const EndRow& given, std::int32_t* voxels) {
  const EndRow row = given;
  const Mask is_first = hn::FirstN(kIntTag, 1);
  Ints last = all(-1);  // its first lane: the voxel of the pixel before
  int count = 0;
  for_lanes(view.width, [&](int u, int left) {
    const Ints here = voxels_of_ends(view, row, u, left);
    const Ints turned = turn_up(here);
    const Mask is_known = equal(here, select(is_first, last, turned)) | equal(here, all(-1));
    const Mask is_new = without(every_lane(), is_known);
    if (any(is_new)) count += pack(is_new, here, voxels + count);
    last = turned;
  });
  return count;
}

// ---- voxels -------------------------------------------------------------------------------------

constexpr float kNearest_m = 0.01F;  // nearer to the camera plane, projections mean nothing

/// Centres of kLanes neighbours along x: in the world relative to the camera, and along its axes.
struct Centers {
  Floats world_m[3];
  Floats camera_m[3];
};

inline Centers make_centers(const FrameView& view, const double first_m[3]) {
  Centers c;
  c.world_m[0] =
      all(static_cast<float>(first_m[0])) + ramp() * all(static_cast<float>(view.resolution_m));
  c.world_m[1] = all(static_cast<float>(first_m[1]));
  c.world_m[2] = all(static_cast<float>(first_m[2]));
  for (int k = 0; k < 3; ++k) {
    const float* const axis = view.camera_axis[k];
    c.camera_m[k] =
        all(axis[0]) * c.world_m[0] + (all(axis[1]) * c.world_m[1] + all(axis[2]) * c.world_m[2]);
  }
  return c;
}

/// Lanes whose voxel is passed by the ray of the pixel nearest to its centre.
inline Mask passed_at_center(const FrameView& view, const Centers& c) {
  const Floats z_m = c.camera_m[2];
  const float room_m = view.half_voxel_m - view.margin_m;
  // the ray passes through the ball in the voxel
  Mask is_seen = less_equal(all(kNearest_m), z_m) & less(z_m * all(view.center_slack), all(room_m));
  Floats pixel[2];
  const float last[2] = {static_cast<float>(view.width - 1), static_cast<float>(view.height - 1)};
  for (int k = 0; k < 2; ++k) {
    const Floats at = c.camera_m[k] / z_m * all(view.focal_px[k]) + all(view.center_px[k]);
    const Floats within = hn::Min(hn::Max(at, all(0.0F)), all(last[k]));
    is_seen = is_seen & less_equal(all(-0.5F), at) & less_equal(at, all(last[k] + 0.5F));
    pixel[k] = hn::Round(within);
  }
  const Floats stride = all(static_cast<float>(view.row_stride));
  const Floats inverse = gather(view.inverse_depth, truncated(pixel[1] * stride + pixel[0]));
  const Floats depth_m = all(1.0F) / inverse;
  Floats away_m = all(0.0F);
  for (int a = 0; a < 3; ++a) {
    const Floats direction =
        all(view.toward[a]) + pixel[0] * all(view.right[a]) + pixel[1] * all(view.down[a]);
    away_m = hn::Max(away_m, hn::Abs(depth_m * direction - c.world_m[a]));
  }
  return is_seen & less(z_m, depth_m) & less(all(view.half_voxel_m + view.margin_m), away_m);
}

/// Pixels whose rays can meet the voxels: columns and rows, as whole numbers.
struct PixelBox {
  Floats first[2], last[2];
  Floats inverse_nearest;
  Mask is_empty;
};

inline PixelBox pixel_box(const FrameView& view, const Centers& c) {
  PixelBox box;
  const Floats zero = all(0.0F);
  const Floats nearest_m = c.camera_m[2] - all(view.extent_m[2]);
  const Mask is_ahead = less_equal(all(kNearest_m), nearest_m);
  const Floats inverse_nearest = all(1.0F) / nearest_m;
  const Floats inverse_furthest = all(1.0F) / (c.camera_m[2] + all(view.extent_m[2]));
  box.inverse_nearest = select(is_ahead, inverse_nearest, all(__builtin_inff()));
  box.is_empty = no_lane();
  const float last_px[2] = {static_cast<float>(view.width - 1),
                            static_cast<float>(view.height - 1)};
  for (int k = 0; k < 2; ++k) {
    const Floats low_m = c.camera_m[k] - all(view.extent_m[k]);
    const Floats high_m = c.camera_m[k] + all(view.extent_m[k]);
    const Floats low = low_m * select(less(low_m, zero), inverse_nearest, inverse_furthest);
    const Floats high = high_m * select(less(high_m, zero), inverse_furthest, inverse_nearest);
    const Floats end = all(last_px[k]);
    const auto pixel = [&](Floats at) {
      return at * all(view.focal_px[k]) + all(view.center_px[k]);
    };
    const Floats first = select(is_ahead, pixel(low), zero);
    const Floats last = select(is_ahead, pixel(high), end);
    box.is_empty = box.is_empty | less(last, zero) | less(end, first);
    box.first[k] = hn::Trunc(hn::Min(hn::Max(first, zero), end));
    box.last[k] = hn::Trunc(hn::Min(hn::Max(last, zero), end));
  }
  return box;
}

/// Lanes before whose voxel every ray ends.
inline Mask hidden(const FrameView& view, const PixelBox& box) {
  constexpr int kExponentBits = 0x7f800000;  // of a float32
  Floats first[2];
  Floats last[2];
  for (int k = 0; k < 2; ++k) {
    first[k] = hn::Trunc(box.first[k] * all(1.0F / kTile_px));
    last[k] = hn::Trunc(box.last[k] * all(1.0F / kTile_px));
  }
  const Floats tiles = hn::Max(last[0] - first[0], last[1] - first[1]);
  const Ints window_bits = as_ints(hn::Max(tiles, all(1.0F)));
  const Floats window = as_floats(window_bits & all(kExponentBits));  // 2^floor(log2)
  const Floats back = window - all(1.0F);
  for (int k = 0; k < 2; ++k) last[k] = hn::Max(last[k] - back, first[k]);
  const Floats log2 = to_floats(shift_right<23>(window_bits) - all(127));
  const Floats level = log2 * all(static_cast<float>(view.level_stride));
  const Floats stride = all(static_cast<float>(view.tile_stride));
  const auto least = [&](Floats tx, Floats ty) {
    return gather(view.tile_windows, truncated(level + ty * stride + tx));
  };
  const Floats upper = hn::Min(least(first[0], first[1]), least(last[0], first[1]));
  const Floats lower = hn::Min(least(first[0], last[1]), least(last[0], last[1]));
  return less_equal(box.inverse_nearest, hn::Min(upper, lower));
}

/// Tests lane by lane, ray by ray.
inline void resolve(const FrameView& view, const Centers& c, const PixelBox& box,
                    std::uint32_t lanes, const int first_key[3], std::uint8_t* voxel,
                    const FrameMarks& marks) {
  float center_m[3][kLanes], first_px[2][kLanes], last_px[2][kLanes], inverse_nearest[kLanes];
  for (int a = 0; a < 3; ++a) store(center_m[a], c.world_m[a]);
  for (int k = 0; k < 2; ++k) {
    store(first_px[k], box.first[k]);
    store(last_px[k], box.last[k]);
  }
  store(inverse_nearest, box.inverse_nearest);
  for (; lanes != 0; lanes &= lanes - 1) {
    const int l = __builtin_ctz(lanes);
    SeenVoxel seen;
    for (int a = 0; a < 3; ++a) {
      seen.low_m[a] = center_m[a][l] - view.half_voxel_m;
      seen.high_m[a] = center_m[a][l] + view.half_voxel_m;
      seen.from_camera[a] = first_key[a] - view.camera_key[a];
    }
    seen.from_camera[0] += l;
    seen.inverse_nearest = inverse_nearest[l];
    for (int k = 0; k < 2; ++k) {
      seen.first_px[k] = static_cast<int>(first_px[k][l]);
      seen.last_px[k] = static_cast<int>(last_px[k][l]);
    }
    if (is_passed(view, seen, marks)) voxel[l] = kFreed;
  }
}

/// The voxels of a row whose centres lie in the pyramid of rays, grown: x from min_key.
struct Run {
  int first, last;
};

inline Run clip(const FrameView& view, const double first_center_m[3]) {
  constexpr double kSlack = 1e-6;
  double low = view.box_first[0];
  double high = view.box_last[0];
  for (const double(&plane)[4] : view.plane) {
    const double at = plane[0] * first_center_m[0] + plane[1] * first_center_m[1] +
                      plane[2] * first_center_m[2] + plane[3];
    const double per_voxel = plane[0] * view.resolution_m;
    const double bound = -at / per_voxel;
    if (per_voxel > 0.0 && bound - kSlack > low) low = bound - kSlack;
    if (per_voxel < 0.0 && bound + kSlack < high) high = bound + kSlack;
    if (per_voxel == 0.0 && at < 0.0) return {0, -1};
  }
  if (!(low <= high)) return {0, -1};
  const int first = static_cast<int>(low);
  return {first + static_cast<int>(first < low), static_cast<int>(high)};
}

void project_row(const FrameView& view, int y, int z, const FrameMarks& marks) {
  int key[3] = {view.min_key[0], view.min_key[1] + y, view.min_key[2] + z};
  double center_m[3];
  for (int a = 0; a < 3; ++a) {
    center_m[a] = (key[a] + 0.5) * view.resolution_m - view.origin_m[a];
  }
  const Run run = clip(view, center_m);
  const auto row_start = (static_cast<std::ptrdiff_t>(z) * view.size[1] + y) * view.size[0];
  const double row_start_m = center_m[0];
  for_lanes(run.last - run.first + 1, [&](int from_first, int left) {
    const int x = run.first + from_first;
    std::uint8_t* const voxel = marks.voxel + row_start + x;
    // what lies beyond the run may be another thread's
    const Mask untouched = less(int_ramp(), all(left)) & equal_bytes(voxel, kUntouched, left);
    const Mask is_settled = equal(load(view.words + row_start + x), all(view.settled_word));
    const std::uint32_t open = bits(without(untouched, is_settled));
    if (open == 0) return;
    center_m[0] = row_start_m + x * view.resolution_m;
    const Centers c = make_centers(view, center_m);
    const std::uint32_t freed = open & bits(passed_at_center(view, c));
    for (std::uint32_t lanes = freed; lanes != 0; lanes &= lanes - 1) {
      voxel[__builtin_ctz(lanes)] = kFreed;
    }
    if (open == freed) return;
    const PixelBox box = pixel_box(view, c);
    const std::uint32_t settled = freed | bits(box.is_empty | hidden(view, box));
    key[0] = view.min_key[0] + x;
    resolve(view, c, box, open & ~settled, key, voxel, marks);
  });
}

void project_layer(const FrameView& view, int z, const FrameMarks& marks) {
  for (int y = view.box_first[1]; y <= view.box_last[1]; ++y) project_row(view, y, z, marks);
}

}  // namespace

namespace GNBV_SIMD_LEVEL {

const FrameKernels kFrameKernels = {
    .rays_of_row = rays_of_row, .ends_of_row = ends_of_row, .project_layer = project_layer};

}  // namespace GNBV_SIMD_LEVEL
}  // namespace gnbv
