// Laws of pictures of a series, as a film's images: cheaper, but the same.
#include <gtest/gtest.h>

#include <cmath>

#include "tools/render/renderer.hpp"

namespace gnbv {
namespace {

const Box3 kBox_m(Vec3(-3.0, -3.0, 0.0), Vec3(3.0, 3.0, 3.0));

/// A ghost on a ground that is seen more and more, and what flies around it.
RenderScene moment(int i) {
  RenderScene scene;
  scene.series_box_m = kBox_m;
  scene.ground = GroundItem{};
  SurfaceItem ghost;
  ghost.mesh = box_mesh(Box3(Vec3(-1.0, -1.0, 0.0), Vec3(1.0, 1.0, 1.5)));
  ghost.vertex_colours.assign(ghost.mesh.vertices_m.size(), {0.5F, 0.5F, 0.6F});
  ghost.opacity = 0.5F;
  scene.surfaces.push_back(std::move(ghost));
  DotsItem seen{.points_m = {}, .normals = {}, .colours = {{0.1F, 0.3F, 0.6F}}, .radius_m = 0.03F};
  TubeItem path{{}, {{0.8F, 0.3F, 0.1F}}, 0.03F};
  const auto at = [](double angle_rad, double radius_m, double z_m) {
    return Vec3f(
        Vec3(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), z_m).cast<float>());
  };
  for (int k = 0; k <= 10 * i; ++k) seen.points_m.push_back(at(0.3 * k, 1.1, 0.01 * (k % 140)));
  for (int k = 0; k <= i; ++k) path.points_m.push_back(at(0.4 * k, 2.5, 1.0 + 0.1 * k));
  const Vec3f here_m = path.points_m.back();
  scene.dots.push_back(std::move(seen));
  scene.tubes.push_back(std::move(path));
  scene.balls.push_back({here_m, 0.15F, {0.1F, 0.1F, 0.1F}, true});
  FrustumItem frustum;
  frustum.T_world_camera = look_at(here_m.cast<double>(), Vec3(0.0, 0.0, 0.7));
  frustum.face_opacity = 0.25F;
  scene.frusta.push_back(frustum);
  return scene;
}

RenderView view_of(double azimuth_deg, int width_px = 320, int height_px = 180) {
  std::vector<Vec3> corners_m;
  for (int i = 0; i < 8; ++i) {
    corners_m.push_back(kBox_m.corner(static_cast<Box3::CornerType>(i)));
  }
  return frame_points(corners_m, {deg_to_rad(azimuth_deg), deg_to_rad(25.0)}, width_px, height_px);
}

TEST(Series, EachPictureIsWhatAFreshRendererDraws) {
  Renderer kept;
  for (int i = 0; i < 8; ++i) {
    for (const double azimuth_deg :
         {30.0, i < 4 ? 30.0 : 200.0}) {  // the second time nothing is new
      const RenderView view = view_of(azimuth_deg);
      EXPECT_EQ(kept.render(moment(i), view).rgb, render(moment(i), view).rgb) << i;
    }
  }
  for (const int i : {7, 2, 5}) {  // things go, too
    EXPECT_EQ(kept.render(moment(i), view_of(30.0)).rgb, render(moment(i), view_of(30.0)).rgb) << i;
  }
}

TEST(Series, WhatPassesBehindTheCameraAndOtherPicturesDoNotMatter) {
  Renderer kept;
  const RenderView view = view_of(30.0);
  RenderScene behind = moment(3);
  behind.balls.push_back({(3.0 * view.T_world_camera.translation()).cast<float>(), 0.5F, {}, true});
  RenderScene alone = moment(4);
  alone.series_box_m.reset();
  for (const RenderScene& scene : {moment(3), behind, moment(4), alone, moment(5)}) {
    EXPECT_EQ(kept.render(scene, view).rgb, render(scene, view).rgb);
  }
}

/// What comes near a wall darkens it farther than where it is drawn itself.
TEST(Series, HollowsReachBeyondWhatChanged) {
  const RenderView view = view_of(30.0, 960, 540);
  RenderScene scene;
  scene.series_box_m = kBox_m;
  SurfaceItem wall;
  wall.mesh = box_mesh(Box3(Vec3(-1.5, -1.5, 0.0), Vec3(0.0, 1.5, 2.5)));
  wall.vertex_colours.assign(wall.mesh.vertices_m.size(), {0.8F, 0.8F, 0.8F});
  scene.surfaces.push_back(std::move(wall));
  Renderer kept;
  kept.render(scene, view);
  for (const float z_m : {0.6F, 1.4F, 2.2F}) {
    scene.balls.push_back({Vec3f(0.2F, 0.0F, z_m), 0.25F, {0.2F, 0.2F, 0.2F}});
    EXPECT_EQ(kept.render(scene, view).rgb, render(scene, view).rgb) << z_m;
  }
}

/// Nothing that grows moves light or haze: where it does not grow, the picture stays.
TEST(Series, LightIsTheSameThroughout) {
  const RenderView view = view_of(30.0);
  const Image first = render(moment(0), view);
  const Image last = render(moment(7), view);
  std::size_t same = 0;
  for (std::size_t i = 0; i < first.rgb.size(); ++i) same += first.rgb[i] == last.rgb[i] ? 1 : 0;
  EXPECT_GT(same, first.rgb.size() / 2);
}

}  // namespace
}  // namespace gnbv
