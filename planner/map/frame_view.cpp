#include "planner/map/frame_view.hpp"

#include <algorithm>
#include <cmath>

#include "planner/map/ray_walk.hpp"

namespace gnbv {
namespace {

/// Where the first and the last pixel of a row (axis 0) or column (axis 1) look, at z = 1.
std::array<double, 2> ends_of(const CameraModel& camera, int axis) {
  const double focal_px = axis == 0 ? camera.fx_px : camera.fy_px;
  const double center_px = axis == 0 ? camera.cx_px : camera.cy_px;
  const int size_px = axis == 0 ? camera.config.width_px : camera.config.height_px;
  return {(0.5 - center_px) / focal_px, (size_px - 0.5 - center_px) / focal_px};
}

/// Rays and planes are rounded to float32 here and in OctoMap, by a few units in the last place of
/// the largest coordinate.
double margin_m(const DepthFrame& frame, const CameraModel& camera) {
  constexpr double kLeast_m = 1e-4;
  constexpr double kUnits = 64.0 * 0x1p-24;
  const auto [left, right] = ends_of(camera, 0);
  const auto [top, bottom] = ends_of(camera, 1);
  const Vec3 steepest(std::max(std::fabs(left), std::fabs(right)),
                      std::max(std::fabs(top), std::fabs(bottom)), 1.0);
  const double reach_m = frame.T_world_camera.translation().cwiseAbs().maxCoeff() +
                         camera.config.range_max_m * steepest.norm();
  return std::max(kLeast_m, kUnits * reach_m);
}

void set_plane(const Eigen::Matrix3d& R, const Vec3& normal_camera, double at_m, double room_m,
               double (&plane)[4]) {
  const Vec3 normal = R * normal_camera;
  for (int a = 0; a < 3; ++a) plane[a] = normal[a];
  plane[3] = at_m + room_m * normal.lpNorm<1>();
}

/// The pyramid of rays down to `furthest_m`, and the voxels it can meet.
void set_bounds(const GridGeometry& grid, const Eigen::Matrix3d& R, const CameraModel& camera,
                double furthest_m, FrameView& view) {
  const auto [left, right] = ends_of(camera, 0);
  const auto [top, bottom] = ends_of(camera, 1);
  const double margin = static_cast<double>(view.margin_m);
  const double room_m = 0.5 * grid.resolution_m() + 2.0 * margin;
  set_plane(R, Vec3(1.0, 0.0, -left), 0.0, room_m, view.plane[0]);
  set_plane(R, Vec3(-1.0, 0.0, right), 0.0, room_m, view.plane[1]);
  set_plane(R, Vec3(0.0, 1.0, -top), 0.0, room_m, view.plane[2]);
  set_plane(R, Vec3(0.0, -1.0, bottom), 0.0, room_m, view.plane[3]);
  set_plane(R, Vec3(0.0, 0.0, 1.0), 0.0, room_m, view.plane[4]);
  set_plane(R, Vec3(0.0, 0.0, -1.0), furthest_m, room_m, view.plane[5]);

  Box3 reached_m(Vec3::Zero());
  for (const double x : {left, right}) {
    for (const double y : {top, bottom}) reached_m.extend(R * Vec3(x, y, 1.0) * furthest_m);
  }
  for (int a = 0; a < 3; ++a) {
    const double origin_m = view.origin_m[a];
    const int first = grid.key_of(origin_m + reached_m.min()[a] - margin) - 1 - view.min_key[a];
    const int last = grid.key_of(origin_m + reached_m.max()[a] + margin) + 1 - view.min_key[a];
    view.box_first[a] = std::max(first, 0);
    view.box_last[a] = std::min(last, view.size[a] - 1);
  }
}

void set_camera_voxel(const GridGeometry& grid, const DepthFrame& frame, const CameraModel& camera,
                      FrameView& view) {
  const RayOrigin origin = make_ray_origin(grid, frame.T_world_camera.translation().cast<float>());
  for (std::size_t a = 0; a < 3; ++a) {
    view.camera_key[a] = origin.key[a];
    view.lower_border_m[a] = static_cast<float>(origin.to_lower_border_m[a]);
    view.upper_border_m[a] = static_cast<float>(origin.to_upper_border_m[a]);
  }
  view.direction_slack = view.margin_m / static_cast<float>(camera.config.range_min_m);
}

}  // namespace

bool can_project(const GridGeometry& grid, const DepthFrame& frame, const CameraModel& camera) {
  constexpr double kRotationSlack = 1e-9;
  constexpr double kOctomapKeys = 32768.0;
  constexpr double kMarginsPerVoxel = 20.0;
  constexpr int kPixels = 1 << 23;
  const Eigen::Matrix3d R = frame.T_world_camera.linear();
  const double rotation_error =
      (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const double margin = margin_m(frame, camera);
  const double reach_m = margin / (64.0 * 0x1p-24);
  return grid.contains(grid.key_of(Vec3f(frame.T_world_camera.translation().cast<float>()))) &&
         rotation_error < kRotationSlack && camera.config.range_min_m > 0.0 &&
         reach_m < kOctomapKeys * grid.resolution_m() &&
         kMarginsPerVoxel * margin < grid.resolution_m() &&
         camera.config.width_px + 2 * kPadding < kPixels / (camera.config.height_px + kTile_px);
}

FrameView make_frame_view(const GridGeometry& grid, const DepthFrame& frame,
                          const CameraModel& camera, double furthest_m) {
  const Eigen::Matrix3d R = frame.T_world_camera.linear();
  const double half_m = 0.5 * grid.resolution_m();
  const double margin = margin_m(frame, camera);
  const double focal_px[2] = {camera.fx_px, camera.fy_px};
  const double center_px[2] = {camera.cx_px - 0.5, camera.cy_px - 0.5};
  const Vec3 toward(ends_of(camera, 0)[0], ends_of(camera, 1)[0], 1.0);
  FrameView view{};
  view.width = camera.config.width_px;
  view.height = camera.config.height_px;
  for (int a = 0; a < 3; ++a) {
    view.toward[a] = static_cast<float>(R.row(a).dot(toward));
    view.right[a] = static_cast<float>(R(a, 0) / focal_px[0]);
    view.down[a] = static_cast<float>(R(a, 1) / focal_px[1]);
    for (int k = 0; k < 3; ++k) view.camera_axis[k][a] = static_cast<float>(R(a, k));
    view.extent_m[a] = static_cast<float>(half_m * R.col(a).lpNorm<1>() + margin);
    view.origin_m[a] = frame.T_world_camera.translation()[a];
    view.min_key[a] = grid.min_key()[static_cast<std::size_t>(a)];
    view.size[a] = grid.size()[static_cast<std::size_t>(a)];
  }
  for (int k = 0; k < 2; ++k) {
    view.focal_px[k] = static_cast<float>(focal_px[k]);
    view.center_px[k] = static_cast<float>(center_px[k]);
  }
  view.center_slack = static_cast<float>(0.501 * std::hypot(1.0 / focal_px[0], 1.0 / focal_px[1]));
  view.half_voxel_m = static_cast<float>(half_m);
  view.margin_m = static_cast<float>(margin);
  view.resolution_m = grid.resolution_m();
  set_camera_voxel(grid, frame, camera, view);
  set_bounds(grid, R, camera, furthest_m, view);
  return view;
}

void set_ranges(const CameraModel& camera, PixelRow& row) {
  row.range_max_m = camera.config.range_max_m;
  row.range_min_m = static_cast<float>(camera.config.range_min_m);
  row.range_max_compared_m = static_cast<float>(camera.config.range_max_m);
}

}  // namespace gnbv
