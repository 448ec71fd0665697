// Loops over the voxels that a frame can reach. For frame_loops.cpp alone.
//
// Rows of voxels along x, kLanes at a time, are asked in the order of what it costs:
// 1. The row is cut to the pyramid of rays (six planes).
// 2. passed_at_center: of the pixel nearest to a voxel's centre, whose ray runs through the ball in
//    the voxel, the ray goes deeper than the centre and ends outside the voxel: it passes it.
// 3. hidden: the voxel's corners bound the pixels whose rays can meet it (pixel_box). If all of
// them
//    end before its nearest depth, none passes it. Four overlapping windows of 2^k tiles cover the
//    pixels, and of each window the furthest depth is known.
// 4. is_passed (cone_loops.hpp) looks at the rays one by one; those that rounding leaves in doubt
// are
//    walked later, as OctoMap walks them.
#pragma once

#include "planner/map/cone_loops.hpp"

namespace gnbv {
namespace {

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

/// Lanes whose voxel is passed by the ray of the pixel at its centre.
inline Mask passed_at_center(const FrameView& view, const Centers& c) {
  constexpr float kNearest_m = 0.01F;
  const Floats z_m = c.camera_m[2];
  const float room_m = view.half_voxel_m - view.margin_m;
  // the pixel nearest to the centre passes through the ball in the voxel
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
  constexpr float kNearest_m = 0.01F;
  PixelBox box;
  const Floats nearest_m = c.camera_m[2] - all(view.extent_m[2]);
  const Mask is_ahead = less_equal(all(kNearest_m), nearest_m);
  const Floats inverse_nearest = all(1.0F) / nearest_m;
  const Floats inverse_furthest = all(1.0F) / (c.camera_m[2] + all(view.extent_m[2]));
  box.inverse_nearest = select(is_ahead, inverse_nearest, all(__builtin_inff()));
  box.is_empty = less(all(1.0F), all(0.0F));
  const float size_px[2] = {static_cast<float>(view.width), static_cast<float>(view.height)};
  for (int k = 0; k < 2; ++k) {
    const Floats low_m = c.camera_m[k] - all(view.extent_m[k]);
    const Floats high_m = c.camera_m[k] + all(view.extent_m[k]);
    const Floats zero = all(0.0F);
    const Floats low = low_m * select(less(low_m, zero), inverse_nearest, inverse_furthest);
    const Floats high = high_m * select(less(high_m, zero), inverse_furthest, inverse_nearest);
    const Floats end = all(size_px[k] - 1.0F);
    const Floats first =
        select(is_ahead, low * all(view.focal_px[k]) + all(view.center_px[k]), zero);
    const Floats last =
        select(is_ahead, high * all(view.focal_px[k]) + all(view.center_px[k]), end);
    box.is_empty = box.is_empty | less(last, zero) | less(end, first);
    box.first[k] = hn::Trunc(hn::Min(hn::Max(first, zero), end));
    box.last[k] = hn::Trunc(hn::Min(hn::Max(last, zero), end));
  }
  return box;
}

/// Lanes before whose voxel every ray ends: four windows of tiles cover the pixels.
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
  float center_m[3][kLanes];
  float pixel[4][kLanes];
  float inverse_nearest[kLanes];
  for (int a = 0; a < 3; ++a) store(center_m[a], c.world_m[a]);
  for (int k = 0; k < 2; ++k) {
    store(pixel[2 * k], box.first[k]);
    store(pixel[2 * k + 1], box.last[k]);
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
    seen.first_u = static_cast<int>(pixel[0][l]);
    seen.last_u = static_cast<int>(pixel[1][l]);
    seen.first_v = static_cast<int>(pixel[2][l]);
    seen.last_v = static_cast<int>(pixel[3][l]);
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
    if (per_voxel > 0.0) {
      const double bound = -at / per_voxel - kSlack;
      if (bound > low) low = bound;
    } else if (per_voxel < 0.0) {
      const double bound = -at / per_voxel + kSlack;
      if (bound < high) high = bound;
    } else if (at < 0.0) {
      return {0, -1};
    }
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
}  // namespace gnbv
