// What the planner remembers.
#include "planner/core/history.hpp"

#include <gtest/gtest.h>

#include "planner/core/belief.hpp"
#include "planner/core/model.hpp"

namespace gnbv {
namespace {

TEST(RememberEntropy, StartsWithTheFirstDepthReturn) {
  const CameraModel camera = make_camera_model({});
  const PlannerModel model({}, {}, Box3(Vec3(-8, -8, 0), Vec3(8, 8, 8)), {&camera, 1}, {});
  Belief belief(model);
  History history;
  remember_entropy(belief, 10.0, history);
  EXPECT_TRUE(history.entropies_nat.empty());
  belief.has_depth_return = true;
  remember_entropy(belief, 9.0, history);
  remember_entropy(belief, 8.0, history);
  const double now_nat = belief.grid.total_entropy_nat();
  EXPECT_EQ(history.entropies_nat, (std::vector<double>{9.0, now_nat, now_nat}));
}

}  // namespace
}  // namespace gnbv
