// Which pixels' rays pass a voxel: its outline in the image, and how deep a ray must go to leave
// it. For frame_loops.cpp alone.
#pragma once

#include "planner/map/frame_kernels.hpp"
#include "sim/core/lanes.hpp"

namespace gnbv {
namespace {

/// A voxel relative to the camera, and the pixels its rays can have.
struct SeenVoxel {
  float low_m[3], high_m[3];
  float inverse_nearest;  // 1 / least depth of the voxel, infinite when it reaches the camera plane
  int first_u, last_u, first_v, last_v;
  int from_camera[3];  // voxels from the camera's own
};

constexpr int kMostLines = 12;

/// The rays that pass a box are those between the lines u = at + slope * v, and one ends beyond
/// the box where 1 / depth is less than the greatest of `exit` at its pixel.
struct Cone {
  float lower_at[kMostLines], lower_slope[kMostLines];
  float upper_at[kMostLines], upper_slope[kMostLines];
  float exit_at[6], exit_u[6], exit_v[6];
  int lowers = 0, uppers = 0, exits = 0;
  float least_exit = 0.0F;
};

/// Keeps the pixels where at + u * per_u + v * per_v >= 0.
inline void keep_side(Cone& cone, float at, float per_u, float per_v) {
  constexpr float kLevel = 1e-20F;  // a line along the rows becomes one that is almost so
  const bool is_lower = per_u >= 0.0F;
  const float slant = is_lower && per_u < kLevel ? kLevel : per_u;
  if (is_lower) {
    cone.lower_at[cone.lowers] = -at / slant;
    cone.lower_slope[cone.lowers++] = -per_v / slant;
  } else {
    cone.upper_at[cone.uppers] = -at / slant;
    cone.upper_slope[cone.uppers++] = -per_v / slant;
  }
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

/// The cone of the voxel grown by `margin_m`, and left that much before its faces; with a negative
/// margin the rays are sure to pass it. Slabs: a ray passes when it enters along no axis after it
/// has left along another, and each such pair is linear in the pixel.
inline Cone make_cone(const FrameView& view, const SeenVoxel& voxel, float margin_m) {
  Cone cone;
  float near_m[3];
  float far_m[3];
  float sign[3];
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
      const auto keep = [&](float of_b, float of_a) {
        keep_side(cone, of_b * view.toward[b] + of_a * view.toward[a],
                  of_b * view.right[b] + of_a * view.right[a],
                  of_b * view.down[b] + of_a * view.down[a]);
      };
      keep(sign[b] * far_m[a], -sign[a] * near_m[b]);
      if (!is_outside[a]) keep(-sign[b] * near_m[a], sign[a] * near_m[b]);
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

/// The cone of a voxel at the camera: rays cross the border to it before they leave along another
/// axis. `is_sure`: whatever the slack, and they end at least two voxels on.
inline Cone make_cone_at_camera(const FrameView& view, const SeenVoxel& voxel, bool is_sure) {
  Cone cone;
  cone.least_exit =
      is_sure ? 1.0F / (4.0F * (view.half_voxel_m + view.margin_m)) : __builtin_inff();
  const float slack = is_sure ? -view.direction_slack : view.direction_slack;
  const auto keep = [&](int b, float of_b, int a, float of_a) {
    const float room = slack * ((of_b < 0.0F ? -of_b : of_b) + (of_a < 0.0F ? -of_a : of_a));
    keep_side(cone, of_b * view.toward[b] + of_a * view.toward[a] + room,
              of_b * view.right[b] + of_a * view.right[a],
              of_b * view.down[b] + of_a * view.down[a]);
  };
  for (int b = 0; b < 3; ++b) {
    const int step = voxel.from_camera[b];
    if (step == 0) continue;
    const auto sign = static_cast<float>(step);
    const float near_m = step > 0 ? view.upper_border_m[b] : -view.lower_border_m[b];
    keep(b, sign, b, 0.0F);
    for (int a = 0; a < 3; ++a) {
      if (a == b) continue;
      const int other = voxel.from_camera[a];
      const float voxel_m = other == 0 ? 0.0F : 2.0F * view.half_voxel_m;
      if (other >= 0) keep(b, sign * (view.upper_border_m[a] + voxel_m), a, -near_m);
      if (other <= 0) keep(b, sign * (voxel_m - view.lower_border_m[a]), a, near_m);
    }
  }
  return cone;
}

enum class Proof { might_pass, sure_to_pass };

inline Cone make_cone(const FrameView& view, const SeenVoxel& voxel, Proof proof) {
  const bool is_sure = proof == Proof::sure_to_pass;
  if (is_at_camera(view, voxel)) return make_cone_at_camera(view, voxel, is_sure);
  return make_cone(view, voxel, is_sure ? -view.margin_m : view.margin_m);
}

/// The part of a cone in one row of pixels.
struct ConeRow {
  float first_u, last_u;
  float exit_at[6];
};

inline void set_exits(const Cone& cone, float v, ConeRow& row) {
  for (int i = 0; i < cone.exits; ++i) row.exit_at[i] = cone.exit_at[i] + cone.exit_v[i] * v;
}

inline ConeRow row_of(const Cone& cone, const SeenVoxel& voxel, float v) {
  ConeRow row;
  row.first_u = static_cast<float>(voxel.first_u);
  row.last_u = static_cast<float>(voxel.last_u);
  for (int i = 0; i < cone.lowers; ++i) {
    const float u = cone.lower_at[i] + cone.lower_slope[i] * v;
    if (u > row.first_u) row.first_u = u;
  }
  for (int i = 0; i < cone.uppers; ++i) {
    const float u = cone.upper_at[i] + cone.upper_slope[i] * v;
    if (u < row.last_u) row.last_u = u;
  }
  set_exits(cone, v, row);
  return row;
}

/// Lanes whose rays pass the box of the cone and end beyond it.
inline Mask passing(const Cone& cone, const ConeRow& row, Floats u, Floats inverse_depth) {
  Floats exit = all(cone.least_exit);
  for (int i = 0; i < cone.exits; ++i) {
    exit = max(exit, all(row.exit_at[i]) + all(cone.exit_u[i]) * u);
  }
  return less(inverse_depth, exit) & less_equal(all(row.first_u), u) &
         less_equal(u, all(row.last_u));
}

/// Lines of a voxel's rays in kLanes rows from v on: columns between first_u and last_u.
struct Spans {
  float first_u[kLanes], last_u[kLanes];
  std::uint32_t rows;  // bit r: row v + r has columns
};

inline Spans spans_of(const Cone& cone, const SeenVoxel& voxel, int first_v) {
  const Floats v = all(static_cast<float>(first_v)) + ramp();
  Floats first_u = all(static_cast<float>(voxel.first_u));
  Floats last_u = all(static_cast<float>(voxel.last_u));
  for (int i = 0; i < cone.lowers; ++i) {
    first_u = max(first_u, all(cone.lower_at[i]) + all(cone.lower_slope[i]) * v);
  }
  for (int i = 0; i < cone.uppers; ++i) {
    last_u = min(last_u, all(cone.upper_at[i]) + all(cone.upper_slope[i]) * v);
  }
  Spans spans;
  store(spans.first_u, first_u);
  store(spans.last_u, last_u);
  const Mask is_in = less_equal(v, all(static_cast<float>(voxel.last_v)));
  spans.rows = bits(less_equal(first_u, last_u) & is_in);
  return spans;
}

/// Whether some ray is proven to pass the voxel. If none is, asks for a walk of those that might.
inline bool is_passed(const FrameView& view, const SeenVoxel& voxel, const FrameMarks& marks) {
  const Cone might = make_cone(view, voxel, Proof::might_pass);
  Cone sure;
  bool has_sure = false;
  int doubts = 0;
  for (int v0 = voxel.first_v; v0 <= voxel.last_v; v0 += kLanes) {
    const Spans spans = spans_of(might, voxel, v0);
    for (std::uint32_t rows = spans.rows; rows != 0; rows &= rows - 1) {
      const int r = __builtin_ctz(rows);
      const int v = v0 + r;
      ConeRow row;
      row.first_u = spans.first_u[r];
      row.last_u = spans.last_u[r];
      set_exits(might, static_cast<float>(v), row);
      const float* const inverse_depth = view.inverse_depth + v * view.row_stride;
      const int last_u = static_cast<int>(row.last_u);
      for (int u0 = static_cast<int>(row.first_u); u0 <= last_u; u0 += kLanes) {
        const Floats u = all(static_cast<float>(u0)) + ramp();
        const Floats w = load(inverse_depth + u0);
        std::uint32_t lanes = bits(passing(might, row, u, w));
        if (lanes == 0) continue;
        if (!has_sure) sure = make_cone(view, voxel, Proof::sure_to_pass);
        has_sure = true;
        const ConeRow sure_row = row_of(sure, voxel, static_cast<float>(v));
        if (bits(passing(sure, sure_row, u, w)) != 0) return true;
        for (; lanes != 0; lanes &= lanes - 1) {
          marks.doubts[doubts++] = v * view.width + u0 + __builtin_ctz(lanes);
        }
      }
    }
  }
  for (int i = 0; i < doubts; ++i) marks.walk[marks.doubts[i]] = 1;
  return false;
}

}  // namespace
}  // namespace gnbv
