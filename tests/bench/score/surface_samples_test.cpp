#include "bench/score/surface_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "bench/score/point_tree.hpp"
#include "bench/score/surface_pieces.hpp"
#include "bench/score/voxel_set.hpp"
#include "sim/core/rng.hpp"
#include "tests/bench/shapes.hpp"

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

TEST(SurfaceSamples, LieOnTheirFace) {
  const TriangleMesh mesh = triangles();
  for (const SurfaceSample& s : sample_surface(mesh, 0.03)) {
    const auto [a, b, c] = face_corners_m(mesh, s.face);
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
    const auto [a, b, c] = face_corners_m(mesh, f);
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

/// Triangles of all shapes, from a millimetre to metres, some along the voxels' planes.
TriangleMesh corner_soup() {
  TriangleMesh mesh;
  test::add_sheet(mesh, Vec3(1.0, -1.0, 0.5), Vec3(0, 2.0, 0), Vec3(0, 0, 1.5));  // x = 1 exactly
  test::add_sheet(mesh, Vec3(-0.3, -0.3, 0.05), Vec3(0.6, 0, 0), Vec3(0, 0.6, 0));
  for (std::uint64_t i = 0; i < 40; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    const double size_m = std::pow(10.0, -3.0 + 3.5 * uniform01({5, Stream::bench, i, 9}));
    for (std::uint64_t k = 0; k < 3; ++k) {
      const auto u = [&](std::uint64_t axis) {
        return uniform01({5, Stream::bench, i, 3 * k + axis}) - 0.5;
      };
      mesh.vertices_m.push_back(
          (Vec3(0.4, -0.7, 1.1) + size_m * Vec3(u(0), u(1), u(2))).cast<float>());
    }
    mesh.faces.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

template <typename Use>
void for_all_pieces(const TriangleMesh& mesh, double floor_z_m, const Use& use) {
  const Slabs slabs = make_slabs(mesh, floor_z_m);
  for (std::size_t slab = 0; slab < slabs.faces.size(); ++slab) {
    for (const std::uint32_t face : slabs.faces[slab]) {
      for_each_piece(mesh, face, slabs.slab(slab), floor_z_m, use);
    }
  }
}

TEST(SurfacePieces, OfAFaceHaveItsArea) {
  const TriangleMesh mesh = corner_soup();
  std::vector<double> sums_m2(mesh.faces.size(), 0.0);
  for_all_pieces(mesh, -10.0,
                 [&](const SurfacePiece& piece) { sums_m2[piece.face] += piece.area_m2; });
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const double area_m2 = face_area_m2(mesh, f);
    EXPECT_NEAR(sums_m2[f], area_m2, 1e-9 * area_m2 + 1e-15) << f;
  }
}

TEST(SurfacePieces, EndAtTheFloor) {
  TriangleMesh wall;
  test::add_sheet(wall, Vec3(0.01, 0.0, 0.0), Vec3(1, 0, 0), Vec3(0, 0, 1));
  double area_m2 = 0.0;
  for_all_pieces(wall, 0.32, [&](const SurfacePiece& piece) {
    area_m2 += piece.area_m2;
    for (const Vec3& p : piece.corners_world_m) EXPECT_GE(p.z(), 0.32);
  });
  EXPECT_NEAR(area_m2, 0.68, 1e-7);
}

TEST(SurfacePieces, AndTheirPointsLieInTheirVoxel) {
  for_all_pieces(corner_soup(), -10.0, [](const SurfacePiece& piece) {
    const Vec3 centre_m = voxel_centre_m(piece.voxel, kCoverageSizes_m[0]);
    for (const Vec3& p : piece.corners_world_m) {
      EXPECT_LE((p - centre_m).cwiseAbs().maxCoeff(), 0.025 + 1e-12);
    }
    for (std::size_t k = 0; k < points_on(piece, 0.01); ++k) {
      ASSERT_EQ(voxel_code(point_on(piece, k), kCoverageSizes_m[0]), piece.voxel);
    }
  });
}

TEST(SurfacePieces, PointsSpreadEvenlyOverThem) {
  // a square voxel's face: of any of its quarters, a quarter of the points
  TriangleMesh sheet;
  test::add_sheet(sheet, Vec3(0, 0, 1.02), Vec3(0.05, 0, 0), Vec3(0, 0.05, 0));
  std::array<int, 4> quarters{};
  int all = 0;
  for_all_pieces(sheet, 0.0, [&](const SurfacePiece& piece) {
    for (std::size_t k = 0; k < points_on(piece, 0.001); ++k) {
      const Vec3f p = point_on(piece, k);
      ++quarters[(p.x() < 0.025F ? 0U : 1U) + (p.y() < 0.025F ? 0U : 2U)];
      ++all;
    }
  });
  EXPECT_NEAR(all, 2500, 10);  // rounded a piece
  for (const int count : quarters) EXPECT_NEAR(count, 0.25 * all, 0.01 * all);
}

TEST(DrawnByArea, AreAsManyOnEachPartAsItsAreaAboveTheFloorAsks) {
  // a cube of a metre, half of it below the floor: lid and half walls are 3 m2; and 3 m2 of strips
  TriangleMesh mesh;
  test::add_box(mesh, Vec3(0, 0, -0.2), Vec3(1, 1, 1));
  for (int strip = 0; strip < 100; ++strip) {
    test::add_sheet(mesh, Vec3(2.0, 0.01 * strip, 1.0), Vec3(3, 0, 0), Vec3(0, 0.01, 0));
  }
  constexpr std::size_t kCount = 60000;
  const std::vector<Vec3f> drawn = drawn_by_area(mesh, 0.3, kCount);
  ASSERT_EQ(drawn.size(), kCount);
  std::array<int, 7> on{};  // lid, four walls, strips up to the middle, the others
  for (const Vec3f& p : drawn) {
    ASSERT_GE(p.z(), 0.3F);
    const bool is_strip = p.x() >= 2.0F;
    const std::array<bool, 7> is_on = {p.z() == 0.8F,
                                       p.x() == 0.0F,
                                       p.x() == 1.0F,
                                       p.y() == 0.0F && !is_strip,
                                       p.y() == 1.0F && !is_strip,
                                       is_strip && p.x() < 3.5F && p.z() == 1.0F,
                                       is_strip && p.x() >= 3.5F && p.z() == 1.0F};
    const auto which = std::ranges::find(is_on, true) - is_on.begin();
    ASSERT_LT(which, 7) << p.transpose();
    ++on[static_cast<std::size_t>(which)];
  }
  const std::array<double, 7> area_m2 = {1.0, 0.5, 0.5, 0.5, 0.5, 1.5, 1.5};
  for (std::size_t i = 0; i < on.size(); ++i) {
    const double share = area_m2[i] / 6.0;  // and four deviations of the binomial law
    EXPECT_NEAR(on[i], kCount * share, 4.0 * std::sqrt(kCount * share * (1.0 - share))) << i;
  }
}

TEST(DrawnByArea, ToFewerAreTheFirstAndThereAreNoneWithoutArea) {
  const TriangleMesh mesh = corner_soup();
  const std::vector<Vec3f> many = drawn_by_area(mesh, 0.3, 500);
  const std::vector<Vec3f> few = drawn_by_area(mesh, 0.3, 50);
  EXPECT_TRUE(std::ranges::equal(few, std::span(many).first(50)));
  EXPECT_TRUE(drawn_by_area(mesh, 9.0, 50).empty());
  EXPECT_TRUE(drawn_by_area({}, 0.3, 50).empty());
}

TEST(PointTree, WithABoundItFindsWhatLiesNearerAndNothingElse) {
  const std::vector<Vec3f> points = {Vec3f(1, 0, 0), Vec3f(0, 2, 0), Vec3f(0, 0, 3)};
  const PointTree tree(points);
  std::array<Neighbour, 3> found{};
  const auto count_below = [&](float below_m) {
    return tree.nearest(Vec3f::Zero(), found, below_m).size();
  };
  EXPECT_EQ(count_below(0.5F), 0U);
  EXPECT_EQ(count_below(1.0F), 0U) << "nearer, not as near";
  EXPECT_EQ(count_below(2.5F), 2U);
  EXPECT_EQ(found[1].point, 1U);
  EXPECT_EQ(count_below(100.0F), 3U);
  EXPECT_EQ(tree.nearest({0, 2.1F, 0})->point, 1U);
  EXPECT_FALSE(PointTree({}).nearest(Vec3f::Zero()));
}

TEST(PointTree, FindsWhatASearchOfAllFindsAndOfPointsEquallyFarTheFirstOnes) {
  std::vector<Vec3f> grid;
  for (int i = 0; i < 1000; ++i) {  // the lower index is not always the one the tree meets first
    const int j = (i * 387) % 1000;
    grid.emplace_back(j % 10, j / 10 % 10, j / 100);
  }
  const PointTree tree(grid);
  for (std::uint32_t i = 0; i < grid.size(); i += 7) {
    const Vec3f query = grid[i] + Vec3f(i % 2 == 0 ? 0.0F : 0.5F, 0.0F, 0.0F);
    std::array<Neighbour, 9> found{};
    ASSERT_EQ(tree.nearest(query, found).size(), found.size());
    std::vector<std::pair<float, std::uint32_t>> all;
    for (std::uint32_t k = 0; k < grid.size(); ++k) {
      all.emplace_back((grid[k] - query).squaredNorm(), k);
    }
    std::sort(all.begin(), all.end());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].point, all[k].second) << i;
  }
}

TEST(SampleAbout, HasAboutSoManyOfASquareAndAtMostTwiceOfASliverHoweverLong) {
  TriangleMesh square;
  square.vertices_m = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  square.faces = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_NEAR(static_cast<double>(sample_about(square, 2000.0).size()), 2000.0, 200.0);
  for (const float length_m : {1e3F, 1e9F, 1e30F}) {
    TriangleMesh sliver;
    sliver.vertices_m = {{0, 0, 0}, {length_m, 0, 0}, {0, 1, 0}};
    sliver.faces = {{0, 1, 2}};
    const std::size_t count = sample_about(sliver, 2000.0).size();
    EXPECT_GE(count, 1000U) << length_m;
    EXPECT_LE(count, 4000U) << length_m;
  }
  EXPECT_TRUE(sample_about({}, 2000.0).empty());
}

}  // namespace
}  // namespace gnbv
