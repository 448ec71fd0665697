// Rays made ready to walk: plain loops that the compiler vectorises. For view_loops.cpp alone.
#pragma once

#include "planner/view/view_kernels.hpp"

namespace gnbv {
namespace {

/// floor, for |x| < 2^31.
inline std::int32_t floor_of(double x) {
  const auto truncated = static_cast<std::int32_t>(x);
  return truncated - static_cast<std::int32_t>(x < static_cast<double>(truncated));
}

struct AxisSteps {
  std::int32_t t_next;
  std::int32_t t_voxel;
  std::int32_t move;
  double t_leave;
  std::int32_t crossings;  // of borders within the ray
};

/// One axis of make_ray_steps() (ray_walk.hpp), rounded to integer times at the end.
inline AxisSteps axis_steps(const RayFanFrame& f, int axis, float direction, double length_m) {
  const auto d = static_cast<double>(direction);
  const bool up = d > 0.0;
  const bool moves = up || d < 0.0;
  const double along_m = (up ? d : -d) * length_m;
  const double border_m = up ? f.to_upper_border_m[axis] : -f.to_lower_border_m[axis];
  constexpr double kEnd = static_cast<double>(kRayEnd);
  constexpr double kNever = static_cast<double>(kNeverReached);
  const double time_per_m = kEnd / (moves ? along_m : 1.0);
  const double next = border_m * time_per_m;
  const double voxel = f.resolution_m * time_per_m;
  AxisSteps steps;
  steps.t_next = static_cast<std::int32_t>((moves && next < kNever ? next : kNever) + 0.5);
  steps.t_voxel = static_cast<std::int32_t>((moves && voxel < kNever ? voxel : kNever) + 0.5);
  steps.move = up ? f.stride[axis] : -f.stride[axis];
  const std::int32_t inside = up ? f.steps_up[axis] : f.steps_down[axis];
  steps.t_leave = static_cast<double>(steps.t_next) +
                  static_cast<double>(inside) * static_cast<double>(steps.t_voxel);
  const double rest_m = along_m - border_m;
  const auto after_first =
      static_cast<std::int32_t>((rest_m > 0.0 ? rest_m : 0.0) * f.inverse_resolution);
  steps.crossings = moves && next <= kEnd ? after_first + 1 : 0;
  return steps;
}

inline double smaller(double a, double b) { return a < b ? a : b; }
inline std::int32_t distance(std::int32_t a, std::int32_t b) { return a < b ? b - a : a - b; }

void prepare_rays(const RayFanFrame& frame, const double* const end_body_m[3],
                  const PreparedRays& rays) {
  const RayFanFrame f = frame;
  const double* const bx = end_body_m[0];
  const double* const by = end_body_m[1];
  const double* const bz = end_body_m[2];
  const PreparedRays out = rays;
#ifdef __clang__
#pragma clang loop vectorize(assume_safety)
#else
#pragma GCC ivdep
#endif
  for (std::size_t i = 0; i < out.count; ++i) {
    const auto ex = static_cast<float>(f.R[0][0] * bx[i] + f.R[0][1] * by[i] + f.t_m[0]);
    const auto ey = static_cast<float>(f.R[1][0] * bx[i] + f.R[1][1] * by[i] + f.t_m[1]);
    const auto ez = static_cast<float>(f.R[2][2] * bz[i] + f.t_m[2]);
    const float fx = ex - f.origin_m[0];
    const float fy = ey - f.origin_m[1];
    const float fz = ez - f.origin_m[2];
    // as octomap::Vector3::norm
    const float length_m = __builtin_sqrtf(fx * fx + fy * fy + fz * fz);
    const auto length64_m = static_cast<double>(length_m);
    const AxisSteps x = axis_steps(f, 0, fx / length_m, length64_m);
    const AxisSteps y = axis_steps(f, 1, fy / length_m, length64_m);
    const AxisSteps z = axis_steps(f, 2, fz / length_m, length64_m);
    // the walk ends before the voxel with the end, unless rounding leads past it
    const std::int32_t to_end =
        distance(floor_of(f.inverse_resolution * static_cast<double>(ex)), f.origin_key[0]) +
        distance(floor_of(f.inverse_resolution * static_cast<double>(ey)), f.origin_key[1]) +
        distance(floor_of(f.inverse_resolution * static_cast<double>(ez)), f.origin_key[2]);
    const std::int32_t crossings = x.crossings + y.crossings + z.crossings;
    const std::int32_t within = crossings > 1 ? crossings : 1;
    const double t_leave = smaller(smaller(x.t_leave, y.t_leave),
                                   smaller(z.t_leave, static_cast<double>(kNeverReached)));
    out.t_next[0][i] = x.t_next;
    out.t_next[1][i] = y.t_next;
    out.t_next[2][i] = z.t_next;
    out.t_voxel[0][i] = x.t_voxel;
    out.t_voxel[1][i] = y.t_voxel;
    out.t_voxel[2][i] = z.t_voxel;
    out.move[0][i] = x.move;
    out.move[1][i] = y.move;
    out.move[2][i] = z.move;
    out.t_leave[i] = static_cast<std::int32_t>(t_leave);
    out.voxels[i] = to_end < within ? to_end : within;
  }
}

}  // namespace
}  // namespace gnbv
