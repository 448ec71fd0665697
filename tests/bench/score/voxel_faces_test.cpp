// Which voxels a point covers, and that coverage does not hang on the last bit of a coordinate.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/score/coverage_curve.hpp"
#include "sim/core/rng.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

double random(std::uint64_t which, std::uint64_t index) {
  return uniform01({17, Stream::bench, which, index});
}

/// On and beside the faces of voxels, and anywhere.
std::vector<Vec3f> points_near_faces(std::size_t count) {
  constexpr std::array kBeside_m = {0.0, 1e-5, 1e-4, 1.2e-4, 1.48e-4, 1.52e-4, 1e-3, 0.02};
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 p_m;
    for (int axis = 0; axis < 3; ++axis) {
      const auto which = static_cast<std::uint64_t>(2 * axis);
      const double beside_m = kBeside_m[static_cast<std::size_t>(8.0 * random(which, i))];
      const double x_m = 2.0 * random(which + 1, i) - 1.0;
      p_m[axis] = std::round(20.0 * x_m) / 20.0 + (x_m < 0.2 ? beside_m : -beside_m);
    }
    points.push_back(p_m.cast<float>());
  }
  return points;
}

/// Whether the point lies in the voxel or within 0.15 mm of it along each axis.
bool covers(const Vec3f& p_m, std::uint64_t voxel, double size_m) {
  const Vec3 from_centre_m = p_m.cast<double>() - voxel_centre_m(voxel, size_m);
  return from_centre_m.cwiseAbs().maxCoeff() < 0.5 * size_m + 0.00015;
}

TEST(CoveredVoxels, AreThoseWithinItsReach) {
  std::array<std::size_t, 9> of_count{};
  for (const Vec3f& p_m : points_near_faces(5000)) {
    for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
      const double size_m = kCoverageSizes_m[size];
      const auto own = index_of(voxel_code(p_m, size_m));
      const CoveredVoxels covered = covered_by(p_m, size);
      std::size_t brute = 0;
      for (std::int64_t i = 0; i < 27; ++i) {
        const std::uint64_t voxel =
            code_of({own[0] + i % 3 - 1, own[1] + i / 3 % 3 - 1, own[2] + i / 9 - 1});
        const bool is_covered = std::count(covered.begin(), covered.end(), voxel) == 1;
        ASSERT_EQ(is_covered, covers(p_m, voxel, size_m)) << p_m.transpose() << " " << size_m;
        brute += is_covered ? 1 : 0;
      }
      ASSERT_EQ(brute, covered.count);
      ++of_count[brute];
    }
  }
  for (const std::size_t count : {1U, 2U, 4U, 8U}) EXPECT_GT(of_count[count], 100U);
}

TEST(CoveredVoxels, OfCoarseSizesHoldThoseOfFineOnes) {
  const std::vector<Vec3f> points = points_near_faces(5000);
  for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
    EXPECT_EQ(covered_voxels(points, size),
              coarser(covered_voxels(points, 0), kCoverageFactors[size]));
  }
}

/// A cube with a block on it, walls at round coordinates on both sides of the origin; and a point
/// every 8 mm of it, all of them up to `off_m` before their walls, or behind them.
struct Structure {
  World world;
  std::vector<Vec3> cloud_m;

  void add(const Vec3& min_m, double edge_m, double off_m) {
    test::add_box(world.structure, min_m, Vec3::Constant(edge_m));
    const int steps = static_cast<int>(std::lround(edge_m / 0.008));
    for (int i = 0; i < 6 * (steps + 1) * (steps + 1); ++i) {
      const int wall = i % 6;
      Vec3 p_m;
      p_m[wall % 3] = wall < 3 ? 0.0 : edge_m;
      p_m[(wall + 1) % 3] = edge_m * (i / 6 % (steps + 1)) / steps;
      p_m[(wall + 2) % 3] = edge_m * (i / 6 / (steps + 1)) / steps;
      const double share = 0.5 + 0.5 * random(9, static_cast<std::uint64_t>(i));
      p_m[wall % 3] += (wall < 3 ? -off_m : off_m) * share;
      cloud_m.push_back(min_m + p_m);
    }
  }

  std::array<double, 3> coverage_at(const Vec3& offset_m, std::size_t area_samples) const {
    World moved = world;
    for (Vec3f& v : moved.structure.vertices_m) v = (v.cast<double>() + offset_m).cast<float>();
    std::vector<Vec3f> cloud;
    for (const Vec3& p_m : cloud_m) cloud.push_back((p_m + offset_m).cast<float>());
    const ReferenceConfig config{
        .fewest_samples = 0, .directions = 64, .area_samples = area_samples};
    const SurfaceReference reference = make_surface_reference(moved, RayScene(moved), config, 2);
    return coverage_at_all_sizes(reference.counted, cloud);
  }
};

TEST(Coverage, DoesNotChangeWhereMeshAndCloudMoveTogether) {
  const std::array<Vec3, 6> ways = {Vec3(1, 0, 0), Vec3(0, 1, 0),   Vec3(0, 0, 1),
                                    Vec3(1, 1, 0), Vec3(-1, 1, -1), Vec3(1, 1, 1)};
  for (const double off_m : {1e-5, -1e-4, 1.2e-4}) {
    Structure structure;
    structure.add(Vec3(-0.4, -0.3, 0.5), 0.8, off_m);
    structure.add(Vec3(-0.1, -0.05, 1.3), 0.25, off_m);
    for (const std::size_t area_samples : {0U, 20000U}) {
      for (std::size_t i = 0; i <= 48; ++i) {  // 0 to 50 mm, at round ones and others
        const double by_m = i % 8 == 0 ? 0.05 * random(7, i) : 0.001 * static_cast<double>(i);
        const Vec3 offset_m = (i == 0 ? 0.0 : i == 48 ? 0.05 : by_m) * ways[i % ways.size()];
        const std::array<double, 3> shares = structure.coverage_at(offset_m, area_samples);
        for (const double share : shares) {
          EXPECT_GE(share, 0.995) << off_m << " at " << offset_m.transpose();
        }
      }
    }
  }
}

/// Of a counted voxel: by a loop over all of the points.
TEST(AccurateCoverage, IsOfVoxelsWithAPointNearTheSurface) {
  World world;
  test::add_box(world.structure, Vec3(-1, -1, 0.5), Vec3(2, 2, 2));
  const SurfaceReference reference = make_surface_reference(world, RayScene(world), {}, 2);
  std::vector<Vec3f> cloud;
  std::vector<double> distances_m;
  for (const Vec3f& p_m : points_near_faces(4000)) {
    cloud.push_back(p_m + Vec3f(0, 0, 1.5F));
    distances_m.push_back(0.15 * std::pow(random(8, cloud.size()), 3.0));
  }
  const std::vector<std::size_t> prefixes = {0, 300, 4000};
  const auto shares = coverage_of_prefixes(reference, cloud, prefixes, 2, distances_m);
  for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
    const double size_m = kCoverageSizes_m[size];
    for (std::size_t k = 0; k < prefixes.size(); ++k) {
      double covered = 0.0, accurate = 0.0;
      for (const std::uint64_t voxel : reference.counted[size]) {
        bool is_covered = false, is_accurate = false;
        for (std::size_t i = 0; i < prefixes[k]; ++i) {
          if (!covers(cloud[i], voxel, size_m)) continue;
          is_covered = true;
          is_accurate = is_accurate || distances_m[i] <= 0.2 * size_m;
        }
        covered += is_covered ? 1.0 : 0.0;
        accurate += is_accurate ? 1.0 : 0.0;
      }
      const auto all = static_cast<double>(reference.counted[size].size());
      EXPECT_EQ(shares[k].counted[size], covered / all) << size << " " << k;
      EXPECT_EQ(shares[k].accurate[size], accurate / all) << size << " " << k;
    }
    EXPECT_GT(shares[2].counted[size], shares[2].accurate[size]);
  }
}

}  // namespace
}  // namespace gnbv
