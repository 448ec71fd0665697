// triangulated() against the shoelace formula and the crossing-number test in the polygon's plane.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <random>

#include "sim/mesh/hole_bridges.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

using Vec2 = Eigen::Vector2d;
using Outline = std::vector<Vec2>;

double shoelace(const Outline& p) {
  double twice = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2& q = p[(i + 1) % p.size()];
    twice += p[i].x() * q.y() - p[i].y() * q.x();
  }
  return 0.5 * twice;
}

/// Whether a ray to the right leaves the outline an odd number of times.
bool is_inside(const Outline& outline, const Vec2& p) {
  bool is_in = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % outline.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) is_in = !is_in;
  }
  return is_in;
}

PolygonMesh polygon(const std::vector<Vec3>& corners) {
  PolygonMesh mesh;
  mesh.vertices = corners;
  for (std::uint32_t i = 0; i < corners.size(); ++i) mesh.corners.push_back(i);
  mesh.face_ends = {static_cast<std::uint32_t>(corners.size())};
  return mesh;
}

/// Somewhere in space, as far away from the origin as it is large.
std::vector<Vec3> laid(const Outline& outline, const Eigen::Quaterniond& R) {
  std::vector<Vec3> out;
  for (const Vec2& p : outline) out.push_back(R * Vec3(p.x() + 3.0, p.y() - 2.0, 5.0));
  return out;
}

Vec3 area_vector(const std::vector<Vec3>& corners) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [a, b, c] : triangulated(polygon(corners)).faces) {
    sum += 0.5 * (corners[b] - corners[a]).cross(corners[c] - corners[a]);
  }
  return sum;
}

void expect_cut_exactly(const Outline& outline, const Eigen::Quaterniond& R) {
  std::vector<Vec3> corners = laid(outline, R);
  const TriangleMesh mesh = triangulated(polygon(corners));
  ASSERT_EQ(mesh.faces.size(), outline.size() - 2);
  double area = 0.0;
  for (const auto& [i, j, k] : mesh.faces) {
    const Vec2 &a = outline[i], &b = outline[j], &c = outline[k];
    const double own = shoelace({a, b, c});
    EXPECT_GE(own, -1e-12) << i << ' ' << j << ' ' << k << " is turned over";
    area += std::abs(own);
    if (own < 1e-9) continue;  // has no inside to speak of
    for (const Vec2& at :
         {Vec2(1.0 / 3, 1.0 / 3), Vec2(0.01, 0.01), Vec2(0.98, 0.01), Vec2(0.01, 0.98),
          Vec2(0.49, 0.49), Vec2(0.02, 0.49), Vec2(0.49, 0.02)}) {
      const Vec2 p = a + at.x() * (b - a) + at.y() * (c - a);
      EXPECT_TRUE(is_inside(outline, p)) << i << ' ' << j << ' ' << k;
    }
  }
  EXPECT_NEAR(area, shoelace(outline), 1e-9 * shoelace(outline));  // sums of doubles
  const Vec3 front = area_vector(corners);
  std::ranges::reverse(corners);  // the other sense gives the other side
  EXPECT_LT((front + area_vector(corners)).norm(), 1e-9 * area);
}

/// Around the origin, with a distance of its own in each direction.
Outline star(std::mt19937& random, int corners) {
  std::uniform_real_distribution<double> distance(0.1, 4.0);
  Outline out;
  for (int i = 0; i < corners; ++i) {
    const double at_rad = 2.0 * kPi * i / corners;
    out.push_back(distance(random) * Vec2(std::cos(at_rad), std::sin(at_rad)));
  }
  return out;
}

/// With a star-shaped hole, to which it goes and comes back on the same way.
Outline ring(std::mt19937& random, int corners) {
  Outline out = star(random, corners);
  for (Vec2& p : out) p *= 1.0 + 5.0 / p.norm();  // all hole corners are nearer
  out.push_back(out[0]);
  Outline hole = star(random, corners);
  std::reverse(hole.begin() + 1, hole.end());
  hole.push_back(hole[0]);
  out.insert(out.end(), hole.begin(), hole.end());
  return out;
}

Outline comb(int teeth) {
  Outline out = {{0, -1}, {2.0 * teeth, -1}};
  for (int i = teeth; i-- > 0;) {
    out.insert(out.end(), {{2.0 * i + 1, 3}, {2.0 * i + 1, 0}, {2.0 * i, 0}});
  }
  return out;
}

Outline spiral(int corners) {
  Outline out;
  for (const double width : {0.3, 0.0}) {
    for (int k = 0; k < corners; ++k) {
      const double at_rad = 0.4 * (width > 0.0 ? k : corners - 1 - k);
      out.push_back((0.5 + width + 0.1 * at_rad) * Vec2(std::cos(at_rad), std::sin(at_rad)));
    }
  }
  return out;
}

Outline of(std::initializer_list<double> coordinates) {
  Outline out;
  for (auto x = coordinates.begin(); x != coordinates.end(); x += 2) out.emplace_back(x[0], x[1]);
  return out;
}

/// A square with a square hole, to which it goes and comes back on the same way.
const Outline kFrame = of({0, 0, 4, 0, 4, 4, 0, 4, 0, 0, 1, 1, 1, 3, 3, 3, 3, 1, 1, 1});

/// Polygons that touch themselves.
const std::vector<Outline> kTouching = {
    // a notch down to the opposite corner
    of({0, 0, 4, 0, 4, 3, 0, 0, 3, 4, 0, 4}),
    // a notch down to the opposite edge, and the same beside a hole
    of({0, 0, 8, 0, 8, 8, 5, 8, 4, 0, 3, 8, 0, 8}),
    of({0, 0, 8, 0, 8, 8, 5, 8, 4, 0, 3, 8, 0, 8, 0, 0, 1, 2, 1, 4, 2, 4, 2, 2, 1, 2}),
    // two holes on one bridge
    of({0, 0, 9, 0, 9, 3, 0, 3, 0, 0, 1, 1, 1, 2, 3, 2,
        5, 1, 5, 2, 7, 2, 7, 1, 5, 1, 3, 2, 3, 1, 1, 1}),
    // holes that touch the outside, found at random: no other ways to cut them were as right
    of({-2, 0,    -0.5, 0.75, 0.5, 0.75, 0.5, 0,   0.5, -0.75, -1, -1.75, -2, -3.5,
        2,  -3.5, 4,    0,    2,   3.5,  -2,  3.5, -2,  0,     -2, -3.5,  -1, -1.75}),
    of({-2, 0, -1.5,  -2.5, 1.5, -2.5, 2, 0, 1.5,  2.5,  -1.5,  2.5,  -2, 0,
        -2, 0, -0.25, 0.5,  0.5, 0.75, 2, 0, 0.25, -0.5, -0.25, -0.5, -2, 0})};

std::vector<Outline> simple_outlines() {
  std::mt19937 random(11);
  std::vector<Outline> out = {
      {{0, 0}, {2, 1}, {4, 0}, {2, 4}}, kFrame, comb(1), comb(9), spiral(40)};
  for (int corners = 4; corners < 60; ++corners) {
    out.push_back(star(random, corners));
    out.push_back(ring(random, corners));
  }
  return out;
}

TEST(Triangulated, SimplePolygonsAreCoveredOnceAndNothingElse) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const Outline& outline : simple_outlines()) {
    ASSERT_GT(shoelace(outline), 0.0);
    const Eigen::Quaterniond R(normal(random), normal(random), normal(random), normal(random));
    expect_cut_exactly(outline, R.normalized());
    expect_cut_exactly(outline, Eigen::Quaterniond::Identity());
    Outline turned = outline;  // from any other corner
    std::rotate(turned.begin(), turned.begin() + 2, turned.end());
    expect_cut_exactly(turned, R.normalized());
  }
}

TEST(Triangulated, PolygonsThatTouchThemselvesAreCoveredFromEveryCorner) {
  std::vector<Outline> outlines = kTouching;
  outlines.push_back(kFrame);
  for (Outline& outline : outlines) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      std::rotate(outline.begin(), outline.begin() + 1, outline.end());
      expect_cut_exactly(outline, Eigen::Quaterniond::Identity());
    }
  }
}

TEST(Triangulated, HolesAreLeftOutHoweverManyThereAre) {
  std::mt19937 random(3);
  for (const int side : {1, 2, 5, 16}) {
    for (const bool are_random : {false, true}) {
      std::vector<Vec3> points;
      const auto ring_of = [&](const Outline& outline) {
        HoleBridges::Ring ring;
        for (const Vec2& p : outline) {
          ring.push_back(static_cast<std::uint32_t>(points.size()));
          points.emplace_back(p.x(), p.y(), 0.0);
        }
        return ring;
      };
      const double width = 10.0 * side;
      const HoleBridges::Ring outer = ring_of({{0, 0}, {width, 0}, {width, width}, {0, width}});
      std::vector<HoleBridges::Ring> holes;
      for (int i = 0; i < side * side; ++i) {
        const double x = 10 * (i % side) + 5.0, y = 10 * (i / side) + 5.0;
        Outline hole = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}};  // in rows: bridges lie on one line
        if (are_random) hole = star(random, 7);
        for (Vec2& p : hole) p += Vec2(x, y);
        holes.push_back(ring_of(hole));
      }
      Outline joined;
      for (const std::uint32_t i : HoleBridges(points, outer).joined(outer, holes)) {
        joined.emplace_back(points[i].x(), points[i].y());
      }
      expect_cut_exactly(joined, Eigen::Quaterniond::Identity());
    }
  }
}

TEST(Triangulated, AConvexPolygonIsAFanAroundItsFirstCorner) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 12; ++i) corners.emplace_back(0.0, std::cos(0.5 * i), std::sin(0.5 * i));
  const TriangleMesh mesh = triangulated(polygon(corners));
  ASSERT_EQ(mesh.faces.size(), 10U);
  for (std::uint32_t i = 0; i < 10; ++i) {
    EXPECT_EQ(mesh.faces[i], (std::array<std::uint32_t, 3>{0, i + 1, i + 2}));
  }
}

TEST(Triangulated, CornersWithinStraightEdgesLeaveNoTriangleWithoutArea) {
  std::vector<Vec3> corners;  // a square, four such corners on each edge
  for (int edge = 0; edge < 4; ++edge) {
    const Eigen::AngleAxisd turn(0.5 * kPi * edge, Vec3::UnitZ());
    for (int i = 0; i < 5; ++i) corners.push_back(turn * Vec3(0.1 * i - 0.25, -0.25, 1.0));
  }
  const TriangleMesh mesh = triangulated(polygon(corners));
  ASSERT_EQ(mesh.faces.size(), 18U);
  for (const auto& [a, b, c] : mesh.faces) {
    EXPECT_GT((corners[b] - corners[a]).cross(corners[c] - corners[a]).z(), 1e-3);
  }
}

TEST(Triangulated, WhatIsNoSimplePolygonGivesAsManyTrianglesOfItsCorners) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Vec3> tangle;
  for (int i = 0; i < 3000; ++i)
    tangle.emplace_back(normal(random), normal(random), normal(random));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<Vec3>> polygons = {
      {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},                      // crosses itself
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 0, 0}},           // on a line
      {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}},                      // a point
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}},                      // a corner twice
      {{0, 0, 0}, {kNan, 0, 0}, {1, 1, 0}, {0, kNan, 0}, {0, 0, 1}},     // nowhere
      {{0, 0, 0}, {1e300, 0, 0}, {1e300, 1e300, 0}, {0, 1e300, 1e300}},  // beyond products
      tangle};
  for (const std::vector<Vec3>& corners : polygons) {
    const TriangleMesh mesh = triangulated(polygon(corners));
    EXPECT_EQ(mesh.faces.size(), corners.size() - 2);
    for (const auto& face : mesh.faces) {
      for (const std::uint32_t v : face) EXPECT_LT(v, corners.size());
    }
    EXPECT_EQ(mesh.faces, triangulated(polygon(corners)).faces);
  }
}

TEST(Triangulated, TrianglesAndUnusedVerticesStayWhatTheyAre) {
  PolygonMesh polygons;
  polygons.vertices = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0.1, 0, 0}};
  polygons.corners = {1, 2, 3, 3, 2, 1, 1, 1, 2, 1, 5, 2};  // the last two have no area
  polygons.face_ends = {3, 6, 9, 12};
  polygons.materials = {{.name = "a"}, {.name = "b"}};
  polygons.face_material = {1, 0, 0, 1};
  const TriangleMesh mesh = triangulated(polygons);
  EXPECT_EQ(mesh.faces, (std::vector<std::array<std::uint32_t, 3>>{
                            {1, 2, 3}, {3, 2, 1}, {1, 1, 2}, {1, 5, 2}}));
  EXPECT_EQ(mesh.face_material, polygons.face_material);
  ASSERT_EQ(mesh.vertices_m.size(), 6U);
  EXPECT_EQ(mesh.vertices_m[5], Vec3f(0.1F, 0, 0));
  EXPECT_EQ(mesh.materials[1].name, "b");
}

}  // namespace
}  // namespace gnbv
