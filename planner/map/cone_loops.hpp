// Which pixels' rays pass a voxel, and how deep such a ray must go to leave it. For frame_loops.cpp
// alone.
//
// Pixel (u, v) looks along d = toward + u right + v down. Its ray is at t d where it is t deep. The
// voxel is a box [low, high] relative to the camera: what three slabs have in common. On an axis on
// which the camera is outside the slab, mirror the axis (`sign`) so that the slab lies ahead: the
// ray enters the slab at t = near / d and leaves it at t = far / d. On an axis on which the camera
// is inside, the ray is in the slab from the start and leaves by the face that d points to. The ray
// passes the box if it enters no slab b after it has left another slab a:
//
//   near_b / d_b <= far_a / d_a,  that is  far_a d_b - near_b d_a >= 0.
//
// d is linear in u and v, so this is one side of a line in the image. All such lines together
// outline the voxel; in row v they bound u from below or above. The ray leaves the box with the
// first slab that it leaves, at 1 / t = the greatest d_a / far_a, again linear in u and v. It ends
// beyond the box if 1 / depth is less than that.
//
// All this is done twice: with the box grown by the margin of rounding (rays that might pass), and
// with the box shrunk by it (rays that are sure to pass).
#pragma once

#include "planner/map/map_kernels.hpp"
#include "sim/core/lanes.hpp"

namespace gnbv {
namespace {

/// A voxel relative to the camera, and the pixels its rays can have.
struct SeenVoxel {
  float low_m[3], high_m[3];
  float inverse_nearest;  // 1 / least depth of the voxel, infinite when it reaches the camera plane
  int first_px[2], last_px[2];  // columns, rows
  int from_camera[3];           // voxels from the camera's own
};

/// Lines in the image, u = at + slope * v.
struct Lines {
  float at[12], slope[12];
  int count = 0;
};

/// The rays between the lines pass a box. One ends beyond the box where 1 / depth is less than the
/// greatest exit at its pixel.
struct Cone {
  Lines lower, upper;  // bounds of u
  float exit_at[6], exit_u[6], exit_v[6];
  int exits = 0;
  float least_exit = 0.0F;
};

/// Keeps the pixels where of_b d_b + of_a d_a >= 0, whose rays look along d; with a slack also
/// those where that is so for some d whose components differ by the slack.
inline void keep_side(const FrameView& view, Cone& cone, int b, float of_b, int a, float of_a,
                      float slack) {
  constexpr float kLevel = 1e-20F;  // a line along the rows becomes one that is almost so
  const float room = slack * (__builtin_fabsf(of_b) + __builtin_fabsf(of_a));
  const float at = of_b * view.toward[b] + of_a * view.toward[a] + room;
  const float per_u = of_b * view.right[b] + of_a * view.right[a];
  const float per_v = of_b * view.down[b] + of_a * view.down[a];
  const float slant = per_u >= 0.0F && per_u < kLevel ? kLevel : per_u;
  Lines& lines = per_u >= 0.0F ? cone.lower : cone.upper;
  lines.at[lines.count] = -at / slant;
  lines.slope[lines.count++] = -per_v / slant;
}

/// A face at distance `far_m` along `sign` times axis a, by which rays leave.
inline void add_exit(const FrameView& view, Cone& cone, int a, float sign, float far_m,
                     float inverse_nearest) {
  constexpr float kTouching_m = 1e-9F;
  if (far_m < kTouching_m) {  // the camera is at the face: any ray might leave by it
    cone.least_exit = inverse_nearest;
    return;
  }
  const float scale = sign / far_m;
  cone.exit_at[cone.exits] = view.toward[a] * scale;
  cone.exit_u[cone.exits] = view.right[a] * scale;
  cone.exit_v[cone.exits++] = view.down[a] * scale;
}

/// The cone of the voxel grown by `margin_m` on all sides. Rays leave it that much before the faces
/// of the voxel itself.
inline Cone make_grown_cone(const FrameView& view, const SeenVoxel& voxel, float margin_m) {
  Cone cone;
  float near_m[3], far_m[3], sign[3];
  bool is_outside[3];
  for (int a = 0; a < 3; ++a) {
    const float low_m = voxel.low_m[a] - margin_m;
    const float high_m = voxel.high_m[a] + margin_m;
    is_outside[a] = low_m > 0.0F || high_m < 0.0F;
    sign[a] = high_m < 0.0F ? -1.0F : 1.0F;
    near_m[a] = high_m < 0.0F ? -high_m : low_m;
    far_m[a] = high_m < 0.0F ? -low_m : high_m;
    const float left_m = far_m[a] - 2.0F * margin_m;
    add_exit(view, cone, a, sign[a], left_m, voxel.inverse_nearest);
    if (!is_outside[a]) {
      add_exit(view, cone, a, -1.0F, -low_m - 2.0F * margin_m, voxel.inverse_nearest);
    }
  }
  for (int b = 0; b < 3; ++b) {
    if (!is_outside[b]) continue;
    for (int a = 0; a < 3; ++a) {
      if (a == b) continue;
      keep_side(view, cone, b, sign[b] * far_m[a], a, -sign[a] * near_m[b], 0.0F);
      if (is_outside[a]) continue;
      keep_side(view, cone, b, -sign[b] * near_m[a], a, sign[a] * near_m[b], 0.0F);
    }
  }
  return cone;
}

/// Whether the camera is so close to the voxel that a margin says nothing, yet on none of the
/// borders that OctoMap has rays cross: then directions alone tell which voxels a ray enters.
inline bool is_at_camera(const FrameView& view, const SeenVoxel& voxel) {
  for (int a = 0; a < 3; ++a) {
    if (voxel.low_m[a] > view.margin_m || voxel.high_m[a] < -view.margin_m) return false;
    if (!(view.lower_border_m[a] < 0.0F && view.upper_border_m[a] > 0.0F)) return false;
  }
  return true;
}

/// The cone of a voxel that touches or is next to the camera's: its rays cross the border to it
/// before they leave the camera's voxel, or the one beside it, along another axis. Those of
/// `is_sure` do so however their directions are rounded, and end at least two voxels on.
inline Cone make_cone_at_camera(const FrameView& view, const SeenVoxel& voxel, bool is_sure) {
  Cone cone;
  cone.least_exit =
      is_sure ? 1.0F / (4.0F * (view.half_voxel_m + view.margin_m)) : __builtin_inff();
  const float slack = is_sure ? -view.direction_slack : view.direction_slack;
  for (int b = 0; b < 3; ++b) {
    const int step = voxel.from_camera[b];
    if (step == 0) continue;
    const auto sign = static_cast<float>(step);
    const float near_m = step > 0 ? view.upper_border_m[b] : -view.lower_border_m[b];
    keep_side(view, cone, b, sign, b, 0.0F, slack);
    for (int a = 0; a < 3; ++a) {
      if (a == b) continue;
      const int other = voxel.from_camera[a];
      const float voxel_m = other == 0 ? 0.0F : 2.0F * view.half_voxel_m;
      const float up_m = view.upper_border_m[a] + voxel_m;
      const float down_m = voxel_m - view.lower_border_m[a];
      if (other >= 0) keep_side(view, cone, b, sign * up_m, a, -near_m, slack);
      if (other <= 0) keep_side(view, cone, b, sign * down_m, a, near_m, slack);
    }
  }
  return cone;
}

/// The cone of rays that might pass the voxel, or of those that are sure to.
inline Cone make_cone(const FrameView& view, const SeenVoxel& voxel, bool is_sure) {
  if (is_at_camera(view, voxel)) return make_cone_at_camera(view, voxel, is_sure);
  return make_grown_cone(view, voxel, is_sure ? -view.margin_m : view.margin_m);
}

/// The columns of a cone's rays in kLanes rows of pixels, from first_u to last_u.
struct Spans {
  float first_u[kLanes], last_u[kLanes];
  std::uint32_t rows;  // bit r: the row has columns
};

inline Spans spans_of(const Cone& cone, const SeenVoxel& voxel, int first_v) {
  const Floats v = all(static_cast<float>(first_v)) + ramp();
  Floats first_u = all(static_cast<float>(voxel.first_px[0]));
  Floats last_u = all(static_cast<float>(voxel.last_px[0]));
  for (int i = 0; i < cone.lower.count; ++i) {
    first_u = hn::Max(first_u, all(cone.lower.at[i]) + all(cone.lower.slope[i]) * v);
  }
  for (int i = 0; i < cone.upper.count; ++i) {
    last_u = hn::Min(last_u, all(cone.upper.at[i]) + all(cone.upper.slope[i]) * v);
  }
  Spans spans;
  store(spans.first_u, first_u);
  store(spans.last_u, last_u);
  const Mask is_in = less_equal(v, all(static_cast<float>(voxel.last_px[1])));
  spans.rows = bits(less_equal(first_u, last_u) & is_in);
  return spans;
}

/// Lanes, pixels of row v, whose rays are in the span and end beyond the box.
inline Mask passing(const Cone& cone, const Spans& spans, int row, float v, Floats u,
                    Floats inverse_depth) {
  Floats exit = all(cone.least_exit);
  for (int i = 0; i < cone.exits; ++i) {
    exit = hn::Max(exit, all(cone.exit_at[i] + cone.exit_v[i] * v) + all(cone.exit_u[i]) * u);
  }
  return less(inverse_depth, exit) & less_equal(all(spans.first_u[row]), u) &
         less_equal(u, all(spans.last_u[row]));
}

/// Whether some ray is sure to pass the voxel. If none is, asks for a walk of those that might.
inline bool is_passed(const FrameView& view, const SeenVoxel& voxel, const FrameMarks& marks) {
  const Cone might = make_cone(view, voxel, false);
  Cone sure;  // made when the first ray might pass
  bool has_sure = false;
  int doubts = 0;
  for (int v0 = voxel.first_px[1]; v0 <= voxel.last_px[1]; v0 += kLanes) {
    const Spans spans = spans_of(might, voxel, v0);
    Spans sure_spans;
    bool has_sure_spans = false;
    for (std::uint32_t rows = spans.rows; rows != 0; rows &= rows - 1) {
      const int row = __builtin_ctz(rows);
      const auto v = static_cast<float>(v0 + row);
      const std::ptrdiff_t first = std::ptrdiff_t{v0 + row} * view.row_stride;
      const int last_u = static_cast<int>(spans.last_u[row]);
      for (int u0 = static_cast<int>(spans.first_u[row]); u0 <= last_u; u0 += kLanes) {
        const Floats u = all(static_cast<float>(u0)) + ramp();
        const Floats inverse_depth = load(view.inverse_depth + first + u0);
        std::uint32_t lanes = bits(passing(might, spans, row, v, u, inverse_depth));
        if (lanes == 0) continue;
        if (!has_sure) sure = make_cone(view, voxel, true);
        if (!has_sure_spans) sure_spans = spans_of(sure, voxel, v0);
        has_sure = has_sure_spans = true;
        if (any(passing(sure, sure_spans, row, v, u, inverse_depth))) return true;
        for (; lanes != 0; lanes &= lanes - 1) {
          marks.doubts[doubts++] = (v0 + row) * view.width + u0 + __builtin_ctz(lanes);
        }
      }
    }
  }
  for (int i = 0; i < doubts; ++i) marks.walk[marks.doubts[i]] = 1;
  return false;
}

}  // namespace
}  // namespace gnbv
