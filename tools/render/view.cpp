#include "tools/render/view.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

Isometry camera_pose(const Vec3& eye_world_m, const Vec3& forward) {
  // seen plumb, "up" is north
  const Vec3 up = std::abs(forward.z()) > 0.999999 ? Vec3::UnitY() : Vec3::UnitZ();
  const Vec3 right = forward.cross(up).normalized();
  Isometry T = Isometry::Identity();
  T.linear().col(0) = right;
  T.linear().col(1) = forward.cross(right);
  T.linear().col(2) = forward;
  T.translation() = eye_world_m;
  return T;
}

Vec3 from_angles(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

}  // namespace

Isometry look_at(const Vec3& eye_world_m, const Vec3& target_world_m) {
  return camera_pose(eye_world_m, (target_world_m - eye_world_m).normalized());
}

Vec3 key_light(const Isometry& T_world_camera) {
  const Vec3 right = T_world_camera.linear().col(0);  // level, even of a plumb view
  const double behind_rad = std::atan2(right.y(), right.x()) - 0.5 * kPi;
  return from_angles(behind_rad - deg_to_rad(50.0), deg_to_rad(52.0));
}

RenderView frame_points(std::span<const Vec3> points_world_m, const ViewAngles& angles,
                        int width_px, int height_px, const FrameMargins& margins,
                        double fov_y_rad) {
  if (points_world_m.empty()) throw BadInput("nothing to draw: the scene holds no point");
  if (width_px < 1 || height_px < 1) {
    throw BadInput(
        fmt::format("picture size {} x {} px: both must be at least 1", width_px, height_px));
  }
  // half-angle tangents of the four sides
  const double ty = std::tan(0.5 * fov_y_rad);
  const double tx = ty * width_px / height_px;
  const double left = tx * (1.0 - 2.0 * margins.left);
  const double right = tx * (1.0 - 2.0 * margins.right);
  const double top = ty * (1.0 - 2.0 * margins.top);
  const double bottom = ty * (1.0 - 2.0 * margins.bottom);
  if (left + right <= 0.0 || top + bottom <= 0.0) {
    throw BadInput("the margins leave nothing of the picture");
  }
  const Vec3 to_camera = from_angles(angles.azimuth_rad, angles.elevation_rad);
  RenderView view;
  view.width_px = width_px;
  view.height_px = height_px;
  view.fov_y_rad = fov_y_rad;
  view.T_world_camera = camera_pose(Vec3::Zero(), -to_camera);
  view.to_light_world = key_light(view.T_world_camera);

  // In the turned frame, (x, y, z) is left of the right side while x - ex <= right (z - ez), and so
  // on: linear in the eye (ex, ey, ez), so that one extreme a side decides.
  constexpr double kInf = std::numeric_limits<double>::infinity();
  std::array<double, 4> least = {kInf, kInf, kInf, kInf};
  double z_min = kInf;
  double z_max = -kInf;
  for (const Vec3& p_world : points_world_m) {
    const Vec3 p = view.T_world_camera.linear().transpose() * p_world;
    least[0] = std::min(least[0], right * p.z() - p.x());
    least[1] = std::min(least[1], left * p.z() + p.x());
    least[2] = std::min(least[2], bottom * p.z() - p.y());
    least[3] = std::min(least[3], top * p.z() + p.y());
    z_min = std::min(z_min, p.z());
    z_max = std::max(z_max, p.z());
  }
  // a single point would put the eye into it
  const double ez = std::min({(least[0] + least[1]) / (left + right),
                              (least[2] + least[3]) / (top + bottom), z_min - 0.1});
  // the middle of what the two sides allow
  const double ex = 0.5 * (right * ez - least[0] + least[1] - left * ez);
  const double ey = 0.5 * (bottom * ez - least[2] + least[3] - top * ez);
  view.T_world_camera.translation() = view.T_world_camera.linear() * Vec3(ex, ey, ez);
  view.focus_m = 0.5 * (z_min + z_max) - ez;
  return view;
}

RenderView frame_box(const Box3& box_world_m, const ViewAngles& angles, int width_px, int height_px,
                     const FrameMargins& margins, double fov_y_rad) {
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    corners[i] = box_world_m.corner(static_cast<Box3::CornerType>(i));
  }
  const std::size_t count = box_world_m.isEmpty() ? 0 : 8;
  return frame_points(std::span(corners).first(count), angles, width_px, height_px, margins,
                      fov_y_rad);
}

std::optional<Vec3> project(const RenderView& view, const Vec3& p_world_m) {
  const Vec3 p = view.T_world_camera.inverse() * p_world_m;
  if (p.z() <= 0.0) return std::nullopt;
  const double f_px = 0.5 * view.height_px / std::tan(0.5 * view.fov_y_rad);
  return Vec3(0.5 * view.width_px + f_px * p.x() / p.z(),
              0.5 * view.height_px + f_px * p.y() / p.z(), p.z());
}

bool is_within(const RenderView& view, const Vec3& p_world_m) {
  const std::optional<Vec3> px = project(view, p_world_m);
  return px && px->x() >= 0.0 && px->y() >= 0.0 && px->x() <= view.width_px &&
         px->y() <= view.height_px;
}

}  // namespace gnbv
