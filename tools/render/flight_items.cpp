#include "tools/render/flight_items.hpp"

#include <algorithm>
#include <iterator>
#include <span>

namespace gnbv {
namespace {

// A point is dropped where the path between its kept neighbours lies within `tolerance_m` of the
// straight line between them, while these stay within `reach_m` of each other (colours change along
// the way).
std::vector<std::size_t> simplified(const std::vector<Vec3>& path, double tolerance_m,
                                    double reach_m) {
  if (path.empty()) return {};
  std::vector<std::size_t> kept = {0};
  const auto is_straight = [&](std::size_t a, std::size_t b) {
    const Vec3 chord = path[b] - path[a];
    const double length_m = chord.norm();
    if (length_m > reach_m) return false;
    for (std::size_t i = a + 1; i < b; ++i) {
      const Vec3 away = path[i] - path[a];
      const double t =
          length_m > 0.0 ? std::clamp(away.dot(chord) / (length_m * length_m), 0.0, 1.0) : 0.0;
      if ((away - t * chord).norm() > tolerance_m) return false;
    }
    return true;
  };
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    if (!is_straight(kept.back(), i + 1)) kept.push_back(i);
  }
  if (path.size() > 1) kept.push_back(path.size() - 1);
  return kept;
}

// Metres flown since the profile's flight ended.
double planned_metres(const RunRecord& record, const std::vector<Vec3>& path, double begin_s) {
  double metres = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (record.path[i - 1].time_s >= begin_s) metres += (path[i] - path[i - 1]).norm();
  }
  return metres;
}

// How far a time is in the order of the views: 0 at the first one, 1 at the last.
double share_of_views(std::span<const ViewRecord> views, double time_s) {
  const auto is_later = [](double t_s, const ViewRecord& view) { return t_s < view.time_s; };
  const auto next = std::upper_bound(views.begin(), views.end(), time_s, is_later);
  if (next == views.begin()) return 0.0;
  if (next == views.end()) return views.size() > 1 ? 1.0 : 0.0;
  const ViewRecord& before = *std::prev(next);
  const double within = (time_s - before.time_s) / (next->time_s - before.time_s);
  return (static_cast<double>(next - views.begin()) - 1.0 + within) /
         static_cast<double>(views.size() - 1);
}

}  // namespace

const Rgb kProfileColour = srgb(0x7b8896);

void add_flight(const RunRecord& record, const FlightLook& look, RenderScene& scene) {
  if (record.path.empty()) return;
  std::vector<Vec3> path;
  for (const TrajectorySample& sample : record.path) {
    path.push_back(sample.T_world_body.translation());
  }
  const double begin_s = record.views_begin_s.value_or(record.path.front().time_s);
  const double total_m = std::max(planned_metres(record, path, begin_s), 1e-9);
  const double width_m = look.thickness * look.unit_m;
  TubeItem profile{{}, {kProfileColour}, static_cast<float>(0.9 * width_m)};
  TubeItem planned{{}, {}, static_cast<float>(1.8 * width_m)};
  for (const std::size_t i : simplified(path, 0.25 * look.unit_m, total_m / 150.0)) {
    if (record.path[i].time_s > look.until_s) break;
    const Vec3f p = path[i].cast<float>();
    const bool is_profile = record.path[i].time_s < begin_s;
    if (is_profile || planned.points_m.empty()) profile.points_m.push_back(p);
    if (is_profile) continue;
    planned.points_m.push_back(p);
    planned.colours.push_back(path_ramp(share_of_views(record.views, record.path[i].time_s)));
  }
  if (look.has_profile && profile.points_m.size() > 1) scene.tubes.push_back(std::move(profile));
  if (!planned.points_m.empty()) scene.tubes.push_back(std::move(planned));
}

std::size_t pyramid_step(std::size_t views, int every) {
  return every > 0 ? static_cast<std::size_t>(every) : 1 + views / 40;
}

void add_views(const RunRecord& record, std::size_t count, int every, const FlightLook& look,
               RenderScene& scene) {
  const std::size_t all = record.views.size();
  const std::size_t step = pyramid_step(all, every);
  const double unit_m = look.thickness * look.unit_m;
  for (std::size_t i = 0; i < std::min(count, all); ++i) {
    const ViewPose& pose = record.views[i].decision.view;
    const Rgb colour =
        path_ramp(all > 1 ? static_cast<double>(i) / static_cast<double>(all - 1) : 0.0);
    scene.balls.push_back({pose.p_world_m.cast<float>(), static_cast<float>(3.2 * unit_m), colour});
    if (i % step != 0) continue;
    for (const CameraConfig& camera : record.scenario.cameras) {
      FrustumItem frustum =
          frustum_of(camera, T_world_body(pose), pose.gimbal_pitch_rad, 27.0 * look.unit_m, colour);
      frustum.edge_radius_m = static_cast<float>(0.75 * unit_m);
      frustum.face_opacity = 0.25F;
      add_hung(frustum, pose, unit_m, scene);
    }
  }
}

void add_hung(const FrustumItem& frustum, const ViewPose& view, double unit_m, RenderScene& scene) {
  const Vec3f body = view.p_world_m.cast<float>();
  const Vec3f apex = frustum.T_world_camera.translation().cast<float>();
  if ((apex - body).norm() > 6.0 * unit_m) {  // whose view it is could not be told
    scene.tubes.push_back({{body, apex}, {frustum.colour}, frustum.edge_radius_m});
  }
  scene.frusta.push_back(frustum);
}

FrustumItem frustum_of(const CameraConfig& camera, const Isometry& T_world_body,
                       double gimbal_pitch_rad, double length_m, const Rgb& colour) {
  FrustumItem frustum;
  frustum.T_world_camera =
      T_world_body * turned(make_camera_model(camera), gimbal_pitch_rad).T_body_camera;
  frustum.fov_x_rad = camera.fov_x_rad;
  frustum.fov_y_rad = camera.fov_y_rad;
  frustum.length_m = length_m;
  frustum.colour = colour;
  return frustum;
}

TubeItem path_tube(const std::vector<Vec3>& path_world_m, double unit_m, const Rgb& colour) {
  TubeItem tube{{}, {colour}, static_cast<float>(1.6 * unit_m)};
  for (const std::size_t i :
       simplified(path_world_m, 0.25 * unit_m, std::numeric_limits<double>::infinity())) {
    tube.points_m.push_back(path_world_m[i].cast<float>());
  }
  return tube;
}

}  // namespace gnbv
