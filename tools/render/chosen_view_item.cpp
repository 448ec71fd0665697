#include "tools/render/chosen_view_item.hpp"

#include <algorithm>

#include "tools/render/flight_items.hpp"

namespace gnbv {

const ChosenViewLook kChosenLook = {.chosen = srgb(0xd5420a),
                                    .pyramid = srgb(0x2b323c),
                                    .ray_free = srgb(0x8f99a6),
                                    .ray_unknown = srgb(0xe69f00)};

namespace {

constexpr int kRaysAcross = 9;
constexpr int kRaysDown = 7;

/// How far a camera's view is drawn: to its range, but not far beyond a small structure.
double reach_m(const World& world, const CameraConfig& camera, const ViewPose& view) {
  const Box3 box_m = bounds_m(world.structure);
  const Vec3 half_m = 0.5 * box_m.sizes();
  const Vec3 away_m = (view.p_world_m - box_m.center()).cwiseAbs() + half_m;  // farthest corner
  return std::min(camera.range_max_m, 1.2 * away_m.norm());
}

// A ray up to the first occupied voxel: where it runs through unknown ones it is grey.
void add_ray(const OccupancyGrid& grid, const Vec3& from, const Vec3& to, double unit_m,
             RenderScene& scene) {
  const double length_m = (to - from).norm();
  const double step_m = 0.25 * grid.geometry().resolution_m();
  const Vec3 along = (to - from) / length_m;
  VoxelState state = grid.state_at(from);
  Vec3 begin = from;
  bool is_hit = false;
  double t = 0.0;
  const auto end_piece = [&](const Vec3& end) {
    const Rgb& colour =
        state == VoxelState::unknown ? kChosenLook.ray_unknown : kChosenLook.ray_free;
    scene.tubes.push_back(
        {{begin.cast<float>(), end.cast<float>()}, {colour}, static_cast<float>(0.6 * unit_m)});
    begin = end;
  };
  for (; t < length_m && !is_hit; t += step_m) {
    const VoxelState next = grid.state_at(from + t * along);
    is_hit = next == VoxelState::occupied;
    if (next != state) end_piece(from + t * along);
    state = next;
  }
  if (!is_hit) end_piece(to);
  if (is_hit) {
    scene.balls.push_back(
        {begin.cast<float>(), static_cast<float>(2.6 * unit_m), kChosenLook.chosen});
  }
}

/// Of the pyramid no more than what says where it looks.
FrustumItem outline_of(const CameraConfig& camera, const ViewPose& view, double length_m,
                       double unit_m) {
  FrustumItem frustum =
      frustum_of(camera, T_world_body(view), view.gimbal_pitch_rad, length_m, kChosenLook.pyramid);
  frustum.edge_radius_m = static_cast<float>(1.3 * unit_m);
  return frustum;
}

}  // namespace

void add_chosen_view(const RunRecord& record, const World& world, const Belief& belief,
                     std::size_t iteration, double unit_m, RenderScene& scene) {
  const ViewPose& view = record.views[iteration].decision.view;
  for (const CameraConfig& camera : record.scenario.cameras) {
    const double length_m = reach_m(world, camera, view);
    const FrustumItem frustum = outline_of(camera, view, 60.0 * unit_m, unit_m);
    scene.frusta.push_back(frustum);
    for (int row = 0; row < kRaysDown; ++row) {
      for (int column = 0; column < kRaysAcross; ++column) {
        const double x = 2.0 * (column + 0.5) / kRaysAcross - 1.0;
        const double y = 2.0 * (row + 0.5) / kRaysDown - 1.0;
        const Vec3 end = length_m * Vec3(x * std::tan(0.5 * camera.fov_x_rad),
                                         y * std::tan(0.5 * camera.fov_y_rad), 1.0);
        add_ray(belief.grid, frustum.T_world_camera.translation(), frustum.T_world_camera * end,
                unit_m, scene);
      }
    }
  }
  // the way there
  std::vector<Vec3> way = {record.views[iteration - 1].decision.view.p_world_m};
  const auto& via = record.views[iteration].decision.via_world_m;
  way.insert(way.end(), via.begin(), via.end());
  way.push_back(view.p_world_m);
  scene.tubes.push_back(path_tube(way, 1.6 * unit_m, kChosenLook.chosen));
  scene.balls.push_back(
      {way.front().cast<float>(), static_cast<float>(6.0 * unit_m), srgb(0x14181e)});
  scene.balls.push_back(
      {way.back().cast<float>(), static_cast<float>(7.0 * unit_m), kChosenLook.chosen});
}

}  // namespace gnbv
