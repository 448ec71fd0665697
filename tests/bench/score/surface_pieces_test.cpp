#include "bench/score/surface_pieces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/score/voxel_set.hpp"
#include "sim/core/rng.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

/// Triangles of all shapes, from a millimetre to metres, some along the voxels' planes.
TriangleMesh triangles() {
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
  const TriangleMesh mesh = triangles();
  std::vector<double> sums_m2(mesh.faces.size(), 0.0);
  for_all_pieces(mesh, -10.0,
                 [&](const SurfacePiece& piece) { sums_m2[piece.face] += piece.area_m2; });
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto corner = [&](std::size_t k) {
      return mesh.vertices_m[mesh.faces[f][k]].cast<double>();
    };
    const double area_m2 =
        0.5 * Vec3(corner(1) - corner(0)).cross(Vec3(corner(2) - corner(0))).norm();
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
  for_all_pieces(triangles(), -10.0, [](const SurfacePiece& piece) {
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

}  // namespace
}  // namespace gnbv
