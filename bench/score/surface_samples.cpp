#include "bench/score/surface_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

// A triangle on its longest edge: u along it, v above it, the apex at (foot, height).
struct OnBase {
  Vec3 origin, u_axis, v_axis;  // unit axes; zero where the triangle has no extent
  double base_m = 0.0, foot_m = 0.0, height_m = 0.0;

  // Height of the triangle over u.
  double top_m(double u_m) const {
    const double left = foot_m > 0.0 ? u_m / foot_m : 1.0;
    const double right = foot_m < base_m ? (base_m - u_m) / (base_m - foot_m) : 1.0;
    return height_m * std::clamp(std::min(left, right), 0.0, 1.0);
  }
};

OnBase on_longest_edge(const TriangleMesh& mesh, std::uint32_t face) {
  std::array<Vec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = mesh.vertices_m[mesh.faces[face][i]].cast<double>();
  std::size_t first = 0;
  double longest_m2 = -1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length_m2 = (p[(i + 1) % 3] - p[i]).squaredNorm();
    if (length_m2 > longest_m2) {
      longest_m2 = length_m2;
      first = i;
    }
  }
  const Vec3 base = p[(first + 1) % 3] - p[first];
  const Vec3 side = p[(first + 2) % 3] - p[first];
  OnBase t{p[first], Vec3::Zero(), Vec3::Zero(), base.norm(), 0.0, 0.0};
  if (t.base_m == 0.0) return t;
  t.u_axis = base / t.base_m;
  t.foot_m = std::clamp(side.dot(t.u_axis), 0.0, t.base_m);
  const Vec3 up = side - side.dot(t.u_axis) * t.u_axis;
  t.height_m = up.norm();
  if (t.height_m > 0.0) t.v_axis = up / t.height_m;
  return t;
}

std::int64_t parts(double length_m, double spacing_m) {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(length_m / spacing_m)));
}

struct Range {
  std::int64_t first = 0, last = 0;  // half open
};

// The cells of a strip that may lie in the x range, which is widened by `margin_m`: a superset.
Range cells_near(double x_start_m, double x_step_m, std::int64_t n, double x_min_m, double x_max_m,
                 double margin_m) {
  const double lo_m = x_min_m - margin_m - x_start_m;
  const double hi_m = x_max_m + margin_m - x_start_m;
  const double x_end_m = x_step_m * static_cast<double>(n);
  if (std::max(0.0, x_end_m) < lo_m || std::min(0.0, x_end_m) > hi_m) return {};
  if (std::min(0.0, x_end_m) >= lo_m && std::max(0.0, x_end_m) <= hi_m) return {0, n};
  const double c0 = lo_m / x_step_m;
  const double c1 = hi_m / x_step_m;
  const double limit = static_cast<double>(n);
  return {static_cast<std::int64_t>(std::clamp(std::floor(std::min(c0, c1)), 0.0, limit)),
          static_cast<std::int64_t>(std::clamp(std::ceil(std::max(c0, c1)), 0.0, limit))};
}

}  // namespace

void sample_face(const TriangleMesh& mesh, std::uint32_t face, double spacing_m, double x_min_m,
                 double x_max_m, std::vector<SurfaceSample>& samples) {
  GNBV_CHECK(spacing_m > 0.0, "sample spacing {} m", spacing_m);
  const OnBase t = on_longest_edge(mesh, face);
  const std::int64_t strips = parts(t.height_m, spacing_m);
  const double strip_m = t.height_m / static_cast<double>(strips);
  // a sample lies up to a strip above the strip's lower side, and is rounded to float
  const double margin_m = strip_m + 0.01;
  for (std::int64_t r = 0; r < strips; ++r) {
    const double v0_m = static_cast<double>(r) * strip_m;
    const double share = static_cast<double>(r) / static_cast<double>(strips);
    const double u0_m = share * t.foot_m;
    const double length_m = (1.0 - share) * t.base_m;
    const std::int64_t n = parts(length_m, spacing_m);
    const double step_m = length_m / static_cast<double>(n);
    const Vec3 start = t.origin + u0_m * t.u_axis + v0_m * t.v_axis;
    const Range cells = cells_near(start.x(), step_m * t.u_axis.x(), n, x_min_m, x_max_m, margin_m);
    for (std::int64_t c = cells.first; c < cells.last; ++c) {
      const double u_m = u0_m + (static_cast<double>(c) + 0.5) * step_m;
      const double v_m = 0.5 * (v0_m + std::min(v0_m + strip_m, std::max(v0_m, t.top_m(u_m))));
      const Vec3f p = (t.origin + u_m * t.u_axis + v_m * t.v_axis).cast<float>();
      const double x_m = static_cast<double>(p.x());
      if (x_m >= x_min_m && x_m < x_max_m) samples.push_back({p, face});
    }
  }
}

std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, double spacing_m) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<SurfaceSample> samples;
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
    sample_face(mesh, face, spacing_m, -kInfinity, kInfinity, samples);
  }
  return samples;
}

}  // namespace gnbv
