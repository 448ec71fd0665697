#include "planner/tour/surface_cells.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <stdexcept>

#include "planner/tour/gains.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"
#include "tests/planner/map/drawn_map.hpp"
#include "tests/support/fault.hpp"

namespace gnbv {
namespace {

const Box3 kBox(Vec3(-2, -2, 0), Vec3(2, 2, 2));

OccupancyGrid unknown_grid() { return {OccupancyConfig{}, kBox}; }

/// Points of a square with a side of 2 m about (0, 0, 1), `step_m` apart, on a plane.
std::vector<Vec3f> square(const Vec3& normal, double step_m) {
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  std::vector<Vec3f> points;
  for (double a = -1.0; a <= 1.0; a += step_m) {
    for (double b = -1.0; b <= 1.0; b += step_m) {
      points.push_back((Vec3(0.01, 0.02, 1.03) + a * u + b * v).cast<float>());
    }
  }
  return points;
}

std::size_t expected_voxels(const SurfaceCells& cells) {
  std::size_t sum = 0;
  for (const SurfaceCell& cell : cells.cells()) {
    sum += static_cast<std::size_t>(std::popcount(cell.expected));
  }
  return sum;
}

TEST(SurfaceCells, APlaneIsExpectedWhereItsPointsAreAndScannedThinlyWhole) {
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(1, 2, 3), Vec3(-1, 1, 0.2)}) {
    SurfaceCells cells(kBox, 0.05), thin(kBox, 0.05);
    cells.add(square(normal.normalized(), 0.01), unknown_grid(), 1);
    thin.add(square(normal.normalized(), 0.15), unknown_grid(), 1);
    const auto expected = static_cast<double>(expected_voxels(cells));
    EXPECT_NEAR(static_cast<double>(expected_voxels(thin)), expected, 0.15 * expected);
    std::size_t covered = 0, missing = 0;
    for (const SurfaceCell& cell : cells.cells()) {
      if (cell.is_extrapolated()) continue;
      covered += static_cast<std::size_t>(std::popcount(cell.expected & cell.covered));
      missing += static_cast<std::size_t>(std::popcount(cell.expected & ~cell.covered));
      if (cell.has_plane()) {
        EXPECT_GT(std::fabs(cell.normal.dot(normal.normalized().cast<float>())), 0.99F);
      }
    }
    EXPECT_GT(covered, 1000U);
    EXPECT_LT(missing, covered / 4) << "the square's edges cut cells";
  }
}

TEST(SurfaceCells, KnownFreeSpaceIsNotExtrapolatedInto) {
  OccupancyGrid grid = unknown_grid();
  SurfaceCells anywhere(kBox, 0.05);
  anywhere.add(square(Vec3::UnitZ(), 0.05), grid, 1);
  clear(grid, voxels_where(
                  grid, [](const Vec3& p_m) { return p_m.head<2>().cwiseAbs().maxCoeff() > 1.0; }));
  SurfaceCells within(kBox, 0.05);
  within.add(square(Vec3::UnitZ(), 0.05), grid, 1);
  EXPECT_LT(expected_voxels(within), expected_voxels(anywhere));
  anywhere.follow_map(grid);
  EXPECT_EQ(expected_voxels(anywhere), expected_voxels(within)) << "what is found free later goes";
}

TEST(SurfaceCells, PointsMayComeInAnyBatchesAndThreads) {
  const std::vector<Vec3f> points = square(Vec3(1, 2, 3).normalized(), 0.03);
  SurfaceCells at_once(kBox, 0.05), bit_by_bit(kBox, 0.05);
  at_once.add(points, unknown_grid(), 1);
  for (std::size_t i = 0; i < points.size(); i += 500) {
    bit_by_bit.add(std::span(points).subspan(i, std::min<std::size_t>(500, points.size() - i)),
                   unknown_grid(), 3);
  }
  std::size_t alike = 0;
  for (const SurfaceCell& a : at_once.cells()) {
    for (const SurfaceCell& b : bit_by_bit.cells()) {
      if (a.key != b.key) continue;
      EXPECT_EQ(a.covered, b.covered);
      EXPECT_EQ(a.expected, b.expected);
      ++alike;
    }
  }
  EXPECT_EQ(alike, at_once.cells().size());
}

TEST(SurfaceCells, WhatAStopLeftIsFittedTheNextTime) {
  const std::vector<Vec3f> points = square(Vec3::UnitZ(), 0.03);
  SurfaceCells whole(kBox, 0.05), stopped(kBox, 0.05);
  whole.add(points, unknown_grid(), 1);
  int asked = 0;
  const HeedStop stop = [&] {
    if (++asked == 2) throw std::runtime_error("stop");
  };
  EXPECT_THROW(stopped.add(points, unknown_grid(), 1, stop), std::runtime_error);
  EXPECT_LT(expected_voxels(stopped), expected_voxels(whole));
  stopped.add({}, unknown_grid(), 1);
  EXPECT_EQ(expected_voxels(stopped), expected_voxels(whole));
}

/// Points on the surface of a square bar of 2 m about (0, 0, 1), `width_m` wide.
std::vector<Vec3f> bar(const Vec3& axis, double width_m, double step_m) {
  const Vec3 u = axis.unitOrthogonal();
  const Vec3 v = axis.cross(u);
  std::vector<Vec3f> points;
  for (double a = -1.0; a <= 1.0; a += step_m) {
    for (int side = 0; side < 4; ++side) {
      const double off_u_m = (side % 2 == 0 ? 0.5 : -0.5) * width_m;
      const double off_v_m = (side / 2 == 0 ? 0.5 : -0.5) * width_m;
      points.push_back(
          (Vec3(0.01, 0.02, 1.03) + a * axis + off_u_m * u + off_v_m * v).cast<float>());
    }
  }
  return points;
}

float missing_voxels(const SurfaceCells& cells, const OccupancyGrid& grid) {
  float sum = 0.0F;
  for (const Patch& patch : find_patches(cells, grid, 1)) sum += patch.missing;
  return sum;
}

TEST(SurfaceCells, AThinBarLacksPointsUntilItIsScanned) {
  const OccupancyGrid grid = free_grid(kBox);
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(1, 2, 0.5)}) {
    for (const double width_m : {0.02, 0.04}) {
      SurfaceCells cells(kBox, 0.05);
      cells.add(bar(axis.normalized(), width_m, 0.2), grid, 1);
      const float before = missing_voxels(cells, grid);
      EXPECT_GT(before, 15.0F) << width_m;  // of 40 along it, two sides
      cells.add(bar(axis.normalized(), width_m, 0.01), grid, 1);
      EXPECT_LT(missing_voxels(cells, grid), 0.35F * before) << width_m;
    }
  }
}

TEST(SurfaceCells, ADetailThatIsTooFineIsRefusedByItsName) {
  const Box3 large_m(Vec3(0, 0, 0), Vec3(100, 100, 40));
  EXPECT_TRUE(test::says(test::fault_of([&] { SurfaceCells(large_m, 0.005); }),
                         {"planner.tour.detail_m: 0.005"}));
}

TEST(Patches, ASurfaceHasTheSidesThatSpaceIsFreeBefore) {
  OccupancyGrid grid = unknown_grid();
  clear(grid, voxels_where(grid, [](const Vec3& p_m) { return p_m.z() > 1.2; }));
  SurfaceCells cells(kBox, 0.05);
  cells.add(square(Vec3::UnitZ(), 0.15), grid, 1);
  int sides = 0;
  for (const Patch& patch : find_patches(cells, grid, 2)) {
    if (patch.missing == 0.0F) continue;
    ++sides;
    EXPECT_GT(patch.normal.z(), 0.9F);
    EXPECT_TRUE(patch.source == PatchSource::sampled || patch.source == PatchSource::extrapolated);
  }
  EXPECT_GT(sides, 50);
  // observations of either side count for both
  for (std::uint32_t cell = 0; cell < cells.cells().size(); ++cell) {
    for (const int side : {0, 1, 1}) cells.count_observation(cell, static_cast<std::uint8_t>(side));
  }
  for (const Patch& patch : find_patches(cells, grid, 1)) {
    EXPECT_TRUE(patch.missing == 0.0F || patch.observations == 3);
  }
}

TEST(Patches, KnowHowDenselyTheirCellWasScanned) {
  EXPECT_EQ(point_bin(0.0), 0);
  EXPECT_EQ(point_bin(0.25), 1);
  EXPECT_EQ(point_bin(1.99), 2);
  EXPECT_EQ(point_bin(4.0), kPointBins - 1);
  EXPECT_EQ(point_bin(1e9), kPointBins - 1);
  const OccupancyGrid grid = unknown_grid();
  const auto most_points = [&](double step_m) {
    SurfaceCells cells(kBox, 0.05);
    cells.add(square(Vec3::UnitZ(), step_m), grid, 1);
    std::uint8_t most = 0;
    for (const Patch& patch : find_patches(cells, grid, 1)) most = std::max(most, patch.points);
    return most;
  };
  EXPECT_EQ(most_points(0.01), kPointBins - 1);  // 400 points in a cell of 16 voxels
  EXPECT_EQ(most_points(0.15), point_bin(4.0 / 16.0));
}

}  // namespace
}  // namespace gnbv
