#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "tools/render/geometry.hpp"

namespace gnbv {
namespace {

Eigen::Vector4f pack(const Vec3& v, double w) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
          static_cast<float>(w)};
}

// Box of what casts shadows, turned by R; of a series, of all that its pictures show.
Box3 caster_box(const RenderScene& scene, const DrawLists& lists, const Eigen::Matrix3d& R) {
  Box3 box;
  if (scene.series_box_m) {
    for (const Vec3& corner_m : corners_m(*scene.series_box_m)) box.extend(R * corner_m);
    return box;
  }
  for (const std::uint32_t i : lists.casting) {
    box.extend(R * lists.vertices[i].p_world_m.cast<double>());
  }
  for (const DrawBall& ball : std::span(lists.balls).first(lists.casting_balls)) {
    const Vec3 c = R * ball.p_world_m.cast<double>();
    box.extend(Vec3(c.array() - ball.radius_m));
    box.extend(Vec3(c.array() + ball.radius_m));
  }
  for (const DrawDot& dot : lists.dots) box.extend(R * dot.p_world_m.cast<double>());
  if (box.isEmpty()) box.extend(Vec3(Vec3::Zero()));
  return box;
}

// Parallel projection along the light, from the box of what casts shadows to the unit cube.
void aim_light(const RenderScene& scene, const DrawLists& lists, const Vec3& to_light,
               FrameBlock& frame) {
  Eigen::Matrix3d R_light_world;
  R_light_world.row(2) = -to_light;
  R_light_world.row(0) = to_light.unitOrthogonal();
  R_light_world.row(1) = R_light_world.row(2).cross(R_light_world.row(0));
  const Box3 box = caster_box(scene, lists, R_light_world);
  const double side_m = 1.02 * std::max(1e-3, box.sizes().head<2>().maxCoeff());
  const double depth_m = 1.02 * std::max(1e-3, box.sizes().z());
  const Vec3 scale(1.0 / side_m, 1.0 / side_m, 1.0 / depth_m);
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = scale.asDiagonal() * R_light_world;
  m.topRightCorner<3, 1>() = Vec3::Constant(0.5) - scale.cwiseProduct(box.center());
  frame.shadow_from_world = m.cast<float>();
  frame.to_light = pack(to_light, side_m / kShadowSide_px);
  frame.camera_right.w() = static_cast<float>(side_m);
  frame.camera_up.w() = static_cast<float>(kShadowSide_px);
}

}  // namespace

FrameBlock make_frame_block(const RenderScene& scene, const RenderView& view,
                            const DrawLists& lists) {
  const Eigen::Matrix3d R = view.T_world_camera.linear();
  const Vec3 eye = view.T_world_camera.translation();
  const Vec3 to_light = view.to_light_world.normalized();
  FrameBlock frame;
  frame.eye = pack(eye, 2.0 * view.height_px);
  const double f = 1.0 / std::tan(0.5 * view.fov_y_rad);
  frame.to_fill = pack((R.col(0) - 0.3 * R.col(1) - 0.8 * R.col(2)).normalized(), f);
  frame.camera_right = pack(R.col(0), 0.0);
  frame.camera_up = pack(-R.col(1), 0.0);
  aim_light(scene, lists, to_light, frame);

  const Box3 drawn =
      lists.bounds_m.isEmpty() ? Box3(Vec3(Vec3::Zero())) : lists.bounds_m.cast<double>();
  const Box3 bounds = scene.series_box_m.value_or(drawn);
  const double radius_m = std::max(1.0, 0.5 * bounds.diagonal().norm());
  const Vec3 centre = bounds.center();
  const GroundItem ground = scene.ground.value_or(GroundItem{});
  // wide enough for the scene and for the shadows on it
  const Box3 casting = caster_box(scene, lists, Eigen::Matrix3d::Identity());
  double ground_m = radius_m;
  for (const Vec3& p : corners_m(casting)) {
    // a light near the horizon throws shadows without end
    const double t = std::max(0.0, p.z() - ground.z_m) / std::max(0.3, to_light.z());
    ground_m = std::max(ground_m, (p - t * to_light - centre).head<2>().norm());
  }
  ground_m *= 1.7;
  frame.ground = pack(Vec3(centre.x(), centre.y(), ground.z_m), ground_m);

  // the ground may begin behind the camera and end far beyond the scene
  const double reach_m =
      scene.ground ? std::hypot(std::sqrt(2.0) * ground_m, centre.z() - ground.z_m) : radius_m;
  const double depth_m = (centre - eye).dot(R.col(2));
  frame.grid = pack(Vec3(ground.minor_m, ground.major_m, depth_m - radius_m), 2.0 * radius_m);
  const double far_m = std::max(1.0, 1.01 * (depth_m + reach_m));
  const double near_m = std::max(0.99 * (depth_m - reach_m), 1e-3 * far_m);
  Eigen::Matrix4d clip_from_gl = Eigen::Matrix4d::Zero();
  clip_from_gl(0, 0) = f * view.height_px / view.width_px;
  clip_from_gl(1, 1) = -f;  // optical frame: y down
  clip_from_gl(2, 2) = (far_m + near_m) / (far_m - near_m);
  clip_from_gl(2, 3) = -2.0 * far_m * near_m / (far_m - near_m);
  clip_from_gl(3, 2) = 1.0;
  frame.lens = {static_cast<float>(view.width_px / (f * view.height_px)),
                static_cast<float>(1.0 / f), static_cast<float>(near_m), static_cast<float>(far_m)};
  const bool has_ground = scene.ground && eye.z() > scene.ground->z_m;
  // a path far around what casts shadows says nothing about its hollows; and seen from near, what
  // shades the hollows of the whole would blacken those of its parts
  const double hollow_m =
      std::min({0.035 * std::max(1.0, casting.diagonal().norm()), 0.06 * 2.0 * view.focus_m / f,
                scene.hollow_m.value_or(std::numeric_limits<double>::infinity())});
  frame.hollow = {static_cast<float>(hollow_m), has_ground ? 1.0F : 0.0F, scene.shading, 0.0F};
  frame.clip_from_world = (clip_from_gl * view.T_world_camera.inverse().matrix()).cast<float>();
  return frame;
}

}  // namespace gnbv
