// Laws of what the figures draw by themselves: the grid grows by its scale and stays in the
// picture.
#include <gtest/gtest.h>

#include <algorithm>

#include "tools/render/grid_samples.hpp"

namespace gnbv {
namespace {

double farthest_m(const RenderScene& scene, const Vec3& from_m) {
  double farthest = 0.0;
  for (const BallItem& ball : scene.balls) {
    farthest = std::max(farthest, (ball.centre_m.cast<double>() - from_m).norm());
  }
  return farthest;
}

TEST(GridSamples, GrowByTheScaleAndStayInThePicture) {
  const AgvsConfig config{.step_m = 1.2};
  const ViewPose from{Vec3(3.0, -2.0, 5.0), 0.7};
  const RenderView camera = view_of_grid_samples(config, from, 2.25, ViewAngles{}, 960, 600);
  for (const double scale : {1.0, 1.5, 2.25}) {
    RenderScene scene;
    add_grid_samples(config, from, scale, 0.01, scene);
    // a corner of the cube
    EXPECT_NEAR(farthest_m(scene, from.p_world_m), 1.2 * scale * std::sqrt(3.0), 1e-5);
    for (const BallItem& ball : scene.balls) {
      const auto at_px = project(camera, ball.centre_m.cast<double>());
      ASSERT_TRUE(at_px);
      EXPECT_TRUE(at_px->x() > 0.0 && at_px->x() < 960.0 && at_px->y() > 0.0 && at_px->y() < 600.0);
    }
  }
}

}  // namespace
}  // namespace gnbv
