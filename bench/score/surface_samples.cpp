#include "bench/score/surface_samples.hpp"

#include <algorithm>
#include <cmath>

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

void sample_face(const TriangleMesh& mesh, std::uint32_t face, double spacing_m,
                 std::vector<SurfaceSample>& samples) {
  const OnBase t = on_longest_edge(mesh, face);
  const std::int64_t strips = parts(t.height_m, spacing_m);
  const double strip_m = t.height_m / static_cast<double>(strips);
  for (std::int64_t r = 0; r < strips; ++r) {
    const double v0_m = static_cast<double>(r) * strip_m;
    const double share = static_cast<double>(r) / static_cast<double>(strips);
    const double u0_m = share * t.foot_m;
    const double length_m = (1.0 - share) * t.base_m;
    const std::int64_t n = parts(length_m, spacing_m);
    const double step_m = length_m / static_cast<double>(n);
    for (std::int64_t c = 0; c < n; ++c) {
      const double u_m = u0_m + (static_cast<double>(c) + 0.5) * step_m;
      const double v_m = 0.5 * (v0_m + std::min(v0_m + strip_m, std::max(v0_m, t.top_m(u_m))));
      samples.push_back({(t.origin + u_m * t.u_axis + v_m * t.v_axis).cast<float>(), face});
    }
  }
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, double spacing_m) {
  GNBV_CHECK(spacing_m > 0.0, "sample spacing {} m", spacing_m);
  std::vector<SurfaceSample> samples;
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
    sample_face(mesh, face, spacing_m, samples);
  }
  return samples;
}

std::vector<SurfaceSample> sample_about(const TriangleMesh& mesh, double count) {
  if (mesh.faces.empty()) return {};
  const double spacing_m =
      std::max(std::sqrt(surface_area_m2(mesh) / count), bounds_m(mesh).diagonal().norm() / count);
  return spacing_m > 0.0 ? sample_surface(mesh, spacing_m) : std::vector<SurfaceSample>();
}

}  // namespace gnbv
