// Rays side by side, a ray a lane, and their way from voxel to voxel. For view_loops.cpp alone.
//
// A ray has integer times, 0 at the camera and kRayEnd at its end. Along one axis it comes
// along = |d| length metres far, so a metre along the axis takes the time kRayEnd / along. The
// distance to the first border times this is when the ray crosses that border (t_next); a voxel
// times this is how long it takes from border to border (t_voxel). A ray leaves its voxel at the
// least t_next of the three axes, through the border of that axis. Its walk ends when it leaves the
// grid (t_leave), or has visited the voxels within its range.
#pragma once

#include "planner/view/view_kernels.hpp"
#include "sim/core/lanes.hpp"

namespace gnbv {
namespace {

struct AxisSteps {
  Ints t_next, t_voxel, move;
  Doubles t_leave;
  Ints crossings;  // of borders within the ray
};

/// One axis of make_ray_steps() (ray_walk.hpp), rounded to integer times at the end.
inline AxisSteps axis_steps(const RayFanFrame& f, int axis, Floats direction, Doubles length_m) {
  const Doubles zero = all(0.0);
  const Doubles end = all(static_cast<double>(kRayEnd));
  const Doubles never = all(static_cast<double>(kNeverReached));
  const Doubles d = widen(direction);
  const Doubles along_m = magnitude(d) * length_m;
  const auto if_moves = [&](Doubles yes, Doubles no) {
    return select_less(zero, magnitude(d), yes, no);
  };
  const auto by_sign = [&](double up, double down) {
    return select_less(zero, d, all(up), all(down));
  };
  const Doubles border_m = by_sign(f.to_upper_border_m[axis], -f.to_lower_border_m[axis]);
  const Doubles time_per_m = end / if_moves(along_m, all(1.0));
  const Doubles next = if_moves(border_m * time_per_m, never);
  const Doubles voxel = if_moves(all(f.resolution_m) * time_per_m, never);
  AxisSteps steps;
  steps.t_next = truncated(min(next, never) + all(0.5));
  steps.t_voxel = truncated(min(voxel, never) + all(0.5));
  steps.move = select(less(all(0.0F), direction), all(f.stride[axis]), all(-f.stride[axis]));
  const Doubles inside = by_sign(f.steps_up[axis], f.steps_down[axis]);
  steps.t_leave = widen(steps.t_next) + inside * widen(steps.t_voxel);
  const Ints after_first = truncated(max(along_m - border_m, zero) * all(f.inverse_resolution));
  const Ints reaches_one = truncated(select_less(end, next, zero, all(1.0)));
  steps.crossings = (after_first + all(1)) * reaches_one;
  return steps;
}

/// Where the rays of a bundle are. `moving` rays are inside the grid and their range; `seeing` rays
/// have met nothing occupied either. Rays that no longer see move on, so that a step need not wait
/// for what the map says of the step before.
struct Bundle {
  Ints t_next[3];    // when the ray crosses the next border of each axis
  Ints t_voxel[3];   // and how long it takes from there to the one after
  Ints move[3];      // change of VoxelIndex
  Ints t_leave;      // when it leaves the grid
  Ints voxels_left;  // to visit before its range ends, the one at hand included
  Ints voxel;
  Mask moving;
  Mask seeing;
};

inline Bundle make_bundle(const RayFanFrame& f, const RayEnds& ends, std::size_t first) {
  const Doubles x = load(ends.at_body_m[0] + first);
  const Doubles y = load(ends.at_body_m[1] + first);
  const Doubles z = load(ends.at_body_m[2] + first);
  const Floats end_m[3] = {narrow(all(f.R[0][0]) * x + all(f.R[0][1]) * y + all(f.t_m[0])),
                           narrow(all(f.R[1][0]) * x + all(f.R[1][1]) * y + all(f.t_m[1])),
                           narrow(all(f.R[2][2]) * z + all(f.t_m[2]))};
  Floats along_m[3];
  for (int a = 0; a < 3; ++a) along_m[a] = end_m[a] - all(f.origin_m[a]);
  // as octomap::Vector3::norm
  const Floats length_m =
      hn::Sqrt(along_m[0] * along_m[0] + along_m[1] * along_m[1] + along_m[2] * along_m[2]);
  Bundle b;
  Doubles t_leave = all(static_cast<double>(kNeverReached));
  Ints crossings = all(0);
  Ints to_end = all(0);
  for (int a = 0; a < 3; ++a) {
    const AxisSteps steps = axis_steps(f, a, along_m[a] / length_m, widen(length_m));
    b.t_next[a] = steps.t_next;
    b.t_voxel[a] = steps.t_voxel;
    b.move[a] = steps.move;
    t_leave = min(t_leave, steps.t_leave);
    crossings = crossings + steps.crossings;
    const Ints end_key = floored(all(f.inverse_resolution) * widen(end_m[a]));
    to_end = to_end + hn::Abs(end_key - all(f.origin_key[a]));
  }
  b.t_leave = truncated(t_leave);
  // the walk ends before the voxel with the end, unless rounding leads past it
  b.voxels_left = hn::Min(to_end, hn::Max(crossings, all(1)));
  b.voxel = all(f.origin_voxel);
  const Ints left = all(static_cast<std::int32_t>(ends.count - first));
  b.moving = less(int_ramp(), left) & less(all(0), b.voxels_left);
  b.seeing = b.moving;
  return b;
}

/// When the rays leave their voxels.
inline Ints exit_time(const Bundle& b) {
  return hn::Min(b.t_next[0], hn::Min(b.t_next[1], b.t_next[2]));
}

/// Takes every moving ray into its next voxel. Of axes with equal times the last goes first, as in
/// walk_ray().
inline void take_step(Bundle& b, Ints t_exit) {
  b.voxels_left = b.voxels_left - all(1);
  b.moving = b.moving & less(all(0), b.voxels_left) & less(t_exit, b.t_leave);
  const Mask z = b.moving & equal(b.t_next[2], t_exit);
  const Mask not_z = without(b.moving, z);
  const Mask y = not_z & equal(b.t_next[1], t_exit);
  const Mask x = without(not_z, y);
  b.t_next[0] = add_where(x, b.t_next[0], b.t_voxel[0]);
  b.t_next[1] = add_where(y, b.t_next[1], b.t_voxel[1]);
  b.t_next[2] = add_where(z, b.t_next[2], b.t_voxel[2]);
  b.voxel = add_where(x, b.voxel, b.move[0]);
  b.voxel = add_where(y, b.voxel, b.move[1]);
  b.voxel = add_where(z, b.voxel, b.move[2]);
}

}  // namespace
}  // namespace gnbv
