#include "sim/mesh/mesh_lint.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>
#include <set>

namespace gnbv {
namespace {

using Point = std::array<float, 3>;
using Triangle = std::array<Point, 3>;

Triangle triangle_of(const TriangleMesh& mesh, std::size_t face) {
  Triangle out;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3f& p = mesh.vertices_m[mesh.faces[face][k]];
    out[k] = {p.x() + 0.0F, p.y() + 0.0F, p.z() + 0.0F};
  }
  std::rotate(out.begin(), std::min_element(out.begin(), out.end()), out.end());
  return out;
}

Triangle turned(Triangle t) {
  std::swap(t[1], t[2]);
  return t;
}

/// Faces between 12 vertices on 6 places of two rows, so that every coincidence happens often.
TriangleMesh lattice_soup(unsigned seed, std::size_t faces) {
  std::mt19937 generator(seed);
  TriangleMesh mesh;
  for (int i = 0; i < 12; ++i) {
    const int place = i % 6;
    mesh.vertices_m.emplace_back(place % 3, place / 3, 0);
  }
  mesh.vertices_m[6] = -Vec3f::Zero();  // equal to vertex 0, not the same bits
  for (std::size_t i = 0; i < faces; ++i) {
    auto& face = mesh.faces.emplace_back();
    for (auto& v : face) v = static_cast<std::uint32_t>(generator() % 12);
  }
  return mesh;
}

/// Every figure from its definition, pair by pair.
MeshLint brute(const TriangleMesh& mesh) {
  MeshLint out;
  std::vector<std::pair<Triangle, double>> sound;
  std::set<std::uint32_t> used;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    for (const auto v : mesh.faces[i]) used.insert(v);
    const Triangle t = triangle_of(mesh, i);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      ++out.repeated_corners;
      continue;
    }
    if (is_flat(mesh, i)) {
      ++out.flat_faces;
      continue;
    }
    sound.emplace_back(t, face_area_m2(mesh, i));
  }
  out.unreferenced_vertices = mesh.vertices_m.size() - used.size();
  std::set<Triangle> sheets;
  for (std::size_t i = 0; i < sound.size(); ++i) {
    const auto& [t, area] = sound[i];
    ++out.sound.count;
    out.sound.area_m2 += area;
    bool has_twin = false;
    bool has_earlier = false;
    for (std::size_t j = 0; j < sound.size(); ++j) {
      has_twin = has_twin || sound[j].first == turned(t);
      has_earlier = has_earlier || (j < i && sound[j].first == t);
    }
    out.two_sided.count += has_twin;
    out.two_sided.area_m2 += has_twin ? area : 0.0;
    out.duplicate.count += has_earlier;
    out.duplicate.area_m2 += has_earlier ? area : 0.0;
    sheets.insert(std::min(t, turned(t)));
  }
  std::map<std::set<Point>, int> edges;
  for (const Triangle& t : sheets) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  out.edges = edges.size();
  for (const auto& [edge, count] : edges) {
    out.open_edges += count == 1;
    out.crowded_edges += count > 2;
  }
  return out;
}

TEST(MeshLint, EveryFigureFollowsFromItsDefinition) {
  MeshLint seen;  // that the soups hold all there is to find
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const TriangleMesh mesh = lattice_soup(seed, 1 + seed % 30);
    const MeshLint found = lint_mesh(mesh);
    const MeshLint expected = brute(mesh);
    const auto counts = [](const MeshLint& l) {
      return std::array{l.repeated_corners,
                        l.flat_faces,
                        l.unreferenced_vertices,
                        l.sound.count,
                        l.duplicate.count,
                        l.two_sided.count,
                        l.edges,
                        l.open_edges,
                        l.crowded_edges};
    };
    EXPECT_EQ(counts(found), counts(expected)) << seed;
    // sums of the same numbers in another order
    EXPECT_NEAR(found.sound.area_m2, expected.sound.area_m2, 1e-12) << seed;
    EXPECT_NEAR(found.duplicate.area_m2, expected.duplicate.area_m2, 1e-12) << seed;
    EXPECT_NEAR(found.two_sided.area_m2, expected.two_sided.area_m2, 1e-12) << seed;
    seen.flat_faces += expected.flat_faces;
    seen.duplicate.count += expected.duplicate.count;
    seen.two_sided.count += expected.two_sided.count;
    seen.open_edges += expected.open_edges;
    seen.crowded_edges += expected.crowded_edges;
  }
  for (const std::size_t count : {seen.flat_faces, seen.duplicate.count, seen.two_sided.count,
                                  seen.open_edges, seen.crowded_edges}) {
    EXPECT_GT(count, 50U);
  }
}

TEST(MeshLint, WhatIsNotFiniteIsCountedAndLeftOutOfAllElse) {
  TriangleMesh mesh;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}, {5, 5, INFINITY}, {9, 9, 9}};
  mesh.faces = {{0, 1, 2}, {0, 1, 3}, {3, 3, 4}, {2, 1, 0}};
  const MeshLint lint = lint_mesh(mesh);
  EXPECT_EQ(lint.not_finite_vertices, 2U);
  EXPECT_EQ(lint.not_finite_faces, 2U);
  EXPECT_EQ(lint.repeated_corners, 0U);
  EXPECT_EQ(lint.unreferenced_vertices, 1U);
  EXPECT_EQ(lint.sound.count, 2U);
  EXPECT_EQ(lint.two_sided.count, 2U);
  EXPECT_EQ(lint.edges, 3U);
  EXPECT_TRUE(lint.box_m.isApprox(Box3(Vec3(0, 0, 0), Vec3(1, 1, 0))));  // not vertex 5
  EXPECT_EQ(lint_mesh({}).sound.count, 0U);
  EXPECT_TRUE(lint_mesh({}).box_m.isEmpty());
  for (const auto& [z_m, area_m2] : {std::pair(-0.5, 0.0), std::pair(0.0, 0.0),  // on the plane
                                     std::pair(0.5, 0.5)}) {
    EXPECT_EQ(area_below_m2(mesh, 0, z_m), area_m2);
  }
}

TEST(MeshLint, AreaBelowAPlaneIsThatOfTheSmallTrianglesBelowIt) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<float> coordinate(-1.0F, 1.0F);
  for (int round = 0; round < 50; ++round) {
    TriangleMesh mesh;
    mesh.faces = {{0, 1, 2}};
    for (int i = 0; i < 3; ++i) {
      const float x = coordinate(generator);
      const float y = coordinate(generator);
      mesh.vertices_m.emplace_back(x, y, coordinate(generator));
    }
    const double z_m = static_cast<double>(coordinate(generator));
    const Vec3 a = mesh.vertices_m[0].cast<double>();
    const Vec3 ab = mesh.vertices_m[1].cast<double>() - a;
    const Vec3 ac = mesh.vertices_m[2].cast<double>() - a;
    constexpr int kParts = 400;  // a side
    int below = 0;
    for (int i = 0; i < kParts; ++i) {
      for (int j = 0; i + j < kParts; ++j) {
        for (const double third : {1.0 / 3.0, 2.0 / 3.0}) {  // upright and upside-down ones
          if (third > 0.5 && i + j == kParts - 1) continue;
          below += a.z() + ((i + third) * ab.z() + (j + third) * ac.z()) / kParts < z_m;
        }
      }
    }
    const double share = below / static_cast<double>(kParts * kParts);
    const double area = face_area_m2(mesh, 0);
    // the plane cuts at most two small triangles of each of the rows along one side
    EXPECT_NEAR(area_below_m2(mesh, 0, z_m), share * area, 2.0 / kParts * area) << round;
    TriangleMesh mirrored = mesh;
    for (Vec3f& v : mirrored.vertices_m) v.z() = -v.z();
    EXPECT_NEAR(area_below_m2(mesh, 0, z_m) + area_below_m2(mirrored, 0, -z_m), area, 1e-12);
  }
}

}  // namespace
}  // namespace gnbv
