// Which view of space that nobody has seen is worth a look.
#include <gtest/gtest.h>

#include "planner/core/belief.hpp"
#include "planner/tour/tour_planner.hpp"

namespace gnbv {
namespace {

/// Half of it is known to be free: all with x below this.
void clear_below(double x_m, Belief& belief) {
  const GridGeometry& geometry = belief.grid.geometry();
  std::vector<VoxelIndex> free;
  for (VoxelIndex v = 0; v < geometry.voxel_count(); ++v) {
    if (geometry.center_m(geometry.key_at(v)).x() < x_m) free.push_back(v);
  }
  for (int i = 0; i < 5; ++i) belief.grid.apply({.free = free, .occupied = {}});
}

TEST(MostUnseen, LooksAtUnknownSpaceTheNearerTheBetter) {
  const CameraConfig camera;
  const PlannerModel model({}, {}, Box3(Vec3(-16, -8, 0), Vec3(16, 8, 8)), {&camera, 1}, {});
  const Vec3 at_m(-4, 0, 4);
  const std::vector<TourView> views = {{1, {at_m, kPi}}, {2, {at_m, 0.0}}, {3, {at_m, 0.0}}};
  for (const int threads : {1, 3}) {
    Scratch scratch(model, threads);
    Belief belief(model);
    clear_below(0.0, belief);
    const std::vector<double> near_m = {0.0, 5.0, 2.0};
    EXPECT_EQ(most_unseen(model, belief, views, near_m, scratch), 2U);
    const std::vector<double> same_m = {0.0, 2.0, 2.0};
    EXPECT_EQ(most_unseen(model, belief, views, same_m, scratch), 1U) << "the first of equals";
    const std::vector<TourView> away = {views[0]};
    EXPECT_EQ(most_unseen(model, belief, away, {near_m.data(), 1}, scratch), std::nullopt);
    clear_below(16.0, belief);
    EXPECT_EQ(most_unseen(model, belief, views, near_m, scratch), std::nullopt);
  }
}

}  // namespace
}  // namespace gnbv
