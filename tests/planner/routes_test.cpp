// Baselines that lay all views around the profile at once.
#include <gtest/gtest.h>

#include <cmath>

#include "planner/map/occupancy_grid.hpp"
#include "planner/route/route_planners.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

const Box3 kWorkspace(Vec3(-12, -12, 0), Vec3(12, 12, 12));

/// A box of 4 x 2 x 3 m on the ground around the origin.
OccupancyGrid box_in_the_middle() {
  OccupancyGrid grid(OccupancyConfig{}, kWorkspace);
  ScanUpdate update;
  const auto voxels = static_cast<VoxelIndex>(grid.geometry().voxel_count());
  for (VoxelIndex v = 0; v < voxels; ++v) {
    const Vec3 p_m = grid.geometry().center_m(grid.geometry().key_at(v));
    if (std::abs(p_m.x()) < 2 && std::abs(p_m.y()) < 1 && p_m.z() < 3) update.occupied.push_back(v);
  }
  grid.apply(update);
  return grid;
}

PlannerModel planner_model() {
  const CameraConfig camera;
  return {{}, {.z_min_m = 0.0}, kWorkspace, {&camera, 1}, {}};
}

const ViewPose kStart{Vec3(0, -12, 2), 0};

std::vector<ViewPose> route(decltype(&lay_hemisphere) lay, const OccupancyGrid& grid) {
  return lay({}, planner_model(), grid, kStart, 100);
}

double distance_to_box_m(const Vec3& p_m) {
  return Box3(Vec3(-2, -1, 0), Vec3(2, 1, 3)).exteriorDistance(p_m);
}

TEST(UniformHemisphere, StandsAtTheStandoffAllAroundAndLooksInwards) {
  const auto views = route(lay_hemisphere, box_in_the_middle());
  ASSERT_EQ(views.size(), 100U);
  std::array<int, 4> by_quadrant = {0, 0, 0, 0};
  for (const ViewPose& view : views) {
    EXPECT_TRUE(kWorkspace.contains(view.p_world_m));
    // voxel centres stand for voxels: within half a voxel's diagonal of the standoff
    EXPECT_NEAR(distance_to_box_m(view.p_world_m), 4.0, 0.18);
    const Vec3 forward = T_world_body(view).linear().col(0);
    EXPECT_LE(forward.dot(view.p_world_m), 0.0);
    ++by_quadrant[(view.p_world_m.x() > 0 ? 1U : 0U) + (view.p_world_m.y() > 0 ? 2U : 0U)];
  }
  for (const int count : by_quadrant) EXPECT_NEAR(count, 25, 4);
}

TEST(UniformHemisphere, EachViewIsTheNearestOfThoseLeft) {
  const auto views = route(lay_hemisphere, box_in_the_middle());
  for (std::size_t i = 1; i < views.size(); ++i) {
    const double next_m = (views[i].p_world_m - views[i - 1].p_world_m).norm();
    for (std::size_t j = i + 1; j < views.size(); ++j) {
      EXPECT_GE((views[j].p_world_m - views[i - 1].p_world_m).norm(), next_m - 1e-12);
    }
  }
}

TEST(Lawnmower, PassesEverySideInRowsThatOverlap) {
  const auto views = route(lay_lawnmower, box_in_the_middle());
  // footprints at 4 m: 4.62 x 3.31 m, less 30 %
  const double column_m = 0.7 * 8.0 * std::tan(deg_to_rad(30.0));
  const double row_m = 0.7 * 8.0 * std::tan(deg_to_rad(22.5));
  for (const Vec3& side : {Vec3(0, -5, 0), Vec3(6, 0, 0), Vec3(0, 5, 0), Vec3(-6, 0, 0)}) {
    const Vec3 outwards = side.normalized();
    int on_side = 0;
    for (const ViewPose& view : views) {
      const Vec3 forward = T_world_body(view).linear().col(0);
      if (forward.dot(outwards) > -0.999) continue;
      if (std::abs(view.p_world_m.dot(outwards) - side.norm()) > 0.2) continue;
      ++on_side;
    }
    const double width_m = 2.0 * std::abs(side.cross(Vec3::UnitZ()).norm() > 5.5 ? 5.0 : 6.0);
    EXPECT_GE(on_side, static_cast<int>(width_m / column_m) * static_cast<int>(3.0 / row_m));
  }
  // from view to view it flies a column or a row, but where one side ends and the next begins
  int jumps = 0;
  for (std::size_t i = 1; i < views.size(); ++i) {
    jumps += (views[i].p_world_m - views[i - 1].p_world_m).norm() > column_m + 1e-9 ? 1 : 0;
  }
  EXPECT_LE(jumps, 4);
}

TEST(Lawnmower, RefusesToLayMoreViewsThanAnybodyFlies) {
  const OccupancyGrid grid = box_in_the_middle();
  const auto laid = [&](const RouteConfig& config) {
    return lay_lawnmower(config, planner_model(), grid, kStart, 0).size();
  };
  EXPECT_THROW(laid({.standoff_m = 0.1, .overlap = 0.95}), BadInput);
  EXPECT_LT(laid({.standoff_m = 1.0, .overlap = 0.5}), std::size_t{kMostLaidViews});
}

TEST(Routes, AreEmptyWithoutAProfile) {
  const OccupancyGrid nothing(OccupancyConfig{}, kWorkspace);
  EXPECT_TRUE(route(lay_lawnmower, nothing).empty());
  EXPECT_TRUE(route(lay_hemisphere, nothing).empty());
}

}  // namespace
}  // namespace gnbv
