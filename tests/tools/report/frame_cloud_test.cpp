// Laws of the cloud that stands in for one that is not written yet.
#include "tools/report/frame_cloud.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sensors/camera_model.hpp"
#include "sim/core/error.hpp"
#include "sim/core/image.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/report/thinning.hpp"

namespace gnbv {
namespace {

/// A wall at x = 4 m, seen from the origin by view 0 and, in front of another one at 3 m in the
/// left half of the picture, by view 2; view 1 has no frame.
TEST(FrameCloud, HoldsWhatDepthImagesShowAboveTheFloorOnceALeafFromItsFirstView) {
  const TempFolder temp;
  FrameRecord frames;
  frames.cameras = {{.name = "c",
                     .width_px = 64,
                     .height_px = 48,
                     .fx_px = 32.0,
                     .fy_px = 32.0,
                     .cx_px = 32.0,
                     .cy_px = 24.0}};
  for (const int view : {0, 2}) {
    GreyImage16 depth{64, 48, std::vector<std::uint16_t>(64 * 48, 4000)};
    for (std::size_t i = 0; i < depth.values.size(); ++i) {
      if (view == 2 && i % 64 < 32) depth.values[i] = 3000;
    }
    depth.values[0] = 0;
    frames.frames.push_back({.iteration = view,
                             .colour = temp.path() / fmt::format("{}.png", view),
                             .depth = temp.path() / fmt::format("{}.depth.png", view)});
    write_png(Image{64, 48, std::vector<std::uint8_t>(3 * 64 * 48)}, frames.frames.back().colour);
    write_png(depth, frames.frames.back().depth);
    frames.frames.back().T_world_camera.linear() = R_body_optical();
  }
  RunRecord record;
  for (int view = 0; view < 3; ++view) record.views.push_back({.iteration = view});
  record.scenario.planner.floor_z_m = -0.5;
  record.scenario.planner.cloud.leaf_m = 0.25;
  const RunCloud cloud = cloud_of_frames(record, frames, 1);
  ASSERT_EQ(cloud.view_points.size(), 3U);
  EXPECT_EQ(cloud.profile_points, 0U);
  EXPECT_GT(cloud.view_points[0], 300U);
  EXPECT_EQ(cloud.view_points[1], cloud.view_points[0]);
  EXPECT_GT(cloud.view_points[2], cloud.view_points[1]);
  EXPECT_EQ(cloud.view_points[2], cloud.points_world_m.size());
  for (std::size_t i = 0; i < cloud.points_world_m.size(); ++i) {
    const Vec3f& p_m = cloud.points_world_m[i];
    EXPECT_NEAR(p_m.x(), i < cloud.view_points[1] ? 4.0 : 3.0, 1e-5);
    EXPECT_GE(p_m.z(), -0.5F);
    EXPECT_LE(p_m.z(), 3.0F);
    EXPECT_GE(p_m.y(), i < cloud.view_points[1] ? -4.0F : 0.0F) << "the left half is at +y";
  }
  EXPECT_EQ(first_points(cloud.points_world_m, 0.25).size(), cloud.points_world_m.size());
  const RunCloud again = cloud_of_frames(record, frames, 3);
  EXPECT_EQ(again.points_world_m, cloud.points_world_m);
  EXPECT_EQ(again.view_points, cloud.view_points);
  write_png(Image{8, 8, std::vector<std::uint8_t>(192)}, frames.frames[1].colour);
  EXPECT_THROW(cloud_of_frames(record, frames, 2), BadInput);
}

}  // namespace
}  // namespace gnbv
