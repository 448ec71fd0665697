#include "bench/score/surface_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

// Triangles of all shapes: slivers, specks, right-angled, and without area.
TriangleMesh triangles() {
  TriangleMesh mesh;
  const auto add = [&](const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    mesh.vertices_m.insert(mesh.vertices_m.end(), {a, b, c});
    mesh.faces.push_back({first, first + 1, first + 2});
  };
  add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add({0, 0, 0}, {2, 0.01F, 0}, {1, 0.01F, 0});
  add({-1, 2, 3}, {-1.001F, 2, 3}, {-1, 2.001F, 3});
  add({0, 0, 1}, {0, 0, 1}, {0, 0, 1});
  add({0, 0, 0}, {1, 1, 1}, {0.5F, 0.5F, 0.5F});
  for (std::uint64_t i = 0; i < 20; ++i) {
    std::array<Vec3f, 3> p;
    for (std::uint64_t k = 0; k < 9; ++k) {
      p[k / 3][static_cast<Eigen::Index>(k % 3)] =
          static_cast<float>(2.0 * uniform01({1, Stream::bench, i, k}) - 1.0);
    }
    add(p[0], p[1], p[2]);
  }
  return mesh;
}

std::array<Vec3, 3> corners(const TriangleMesh& mesh, std::uint32_t face) {
  std::array<Vec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = mesh.vertices_m[mesh.faces[face][i]].cast<double>();
  return p;
}

TEST(SurfaceSamples, EveryFaceHasOne) {
  const TriangleMesh mesh = triangles();
  for (const double spacing_m : {0.01, 0.3, 50.0}) {
    std::vector<int> count(mesh.faces.size(), 0);
    for (const SurfaceSample& s : sample_surface(mesh, spacing_m)) ++count[s.face];
    for (const int n : count) EXPECT_GE(n, 1);
  }
}

TEST(SurfaceSamples, LieOnTheirFace) {
  const TriangleMesh mesh = triangles();
  for (const SurfaceSample& s : sample_surface(mesh, 0.03)) {
    const auto [a, b, c] = corners(mesh, s.face);
    const Vec3 p = s.p_world_m.cast<double>();
    // the three parts of a triangle are as large as the whole for points on it, larger for others;
    // 1e-6 m2 is float's rounding at 3 m times edges of 3 m
    const double parts_m2 = 0.5 * ((a - p).cross(b - p).norm() + (b - p).cross(c - p).norm() +
                                   (c - p).cross(a - p).norm());
    EXPECT_NEAR(parts_m2, 0.5 * (b - a).cross(c - a).norm(), 3e-6);
  }
}

TEST(SurfaceSamples, NoPointOfAFaceIsFartherThanTheSpacingAllows) {
  const TriangleMesh mesh = triangles();
  const double spacing_m = 0.1;
  const std::vector<SurfaceSample> samples = sample_surface(mesh, spacing_m);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [a, b, c] = corners(mesh, f);
    for (std::uint64_t i = 0; i < 200; ++i) {
      double u = uniform01({2, Stream::bench, f, 2 * i});
      double v = uniform01({2, Stream::bench, f, 2 * i + 1});
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const Vec3 p = a + u * (b - a) + v * (c - a);
      double nearest_m = std::numeric_limits<double>::infinity();
      for (const SurfaceSample& s : samples) {
        if (s.face == f) nearest_m = std::min(nearest_m, (s.p_world_m.cast<double>() - p).norm());
      }
      EXPECT_LE(nearest_m, 1.2 * spacing_m) << "face " << f;
    }
  }
}

TEST(SurfaceSamples, AreAsManyAsTheAreaAsks) {
  TriangleMesh square;
  square.vertices_m = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  square.faces = {{0, 1, 2}, {0, 2, 3}};
  // 4 m2 at 0.02 m; the strips' ends round up by less than one cell of about 70 at most, twice
  const double expected = 4.0 / (0.02 * 0.02);
  const auto count = static_cast<double>(sample_surface(square, 0.02).size());
  EXPECT_GE(count, expected);
  EXPECT_LE(count, 1.05 * expected);
}

}  // namespace
}  // namespace gnbv
