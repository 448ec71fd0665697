#include "tools/scene/flight.hpp"

#include <algorithm>
#include <iterator>

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

constexpr int kDiscSides = 28;

SurfaceItem disc(const Isometry& T_world_disc, double radius_m, const Rgb& colour) {
  SurfaceItem item;
  item.mesh.vertices_m.push_back(T_world_disc.translation().cast<float>());
  for (std::uint32_t i = 0; i < kDiscSides; ++i) {
    const double angle = 2.0 * kPi * i / kDiscSides;
    item.mesh.vertices_m.push_back(
        (T_world_disc * Vec3(radius_m * std::cos(angle), radius_m * std::sin(angle), 0.0))
            .cast<float>());
    item.mesh.faces.push_back({0, 1 + i, 1 + (i + 1) % kDiscSides});
  }
  item.vertex_colours.assign(item.mesh.vertices_m.size(), colour);
  return item;
}

}  // namespace

void add_flight(const RunRecord& record, const FlightLook& look, RenderScene& scene) {
  if (record.path.empty()) return;
  std::vector<Vec3> path;
  for (const TrajectorySample& sample : record.path) {
    path.push_back(sample.T_world_body.translation());
  }
  const double begin_s = record.views_begin_s.value_or(record.path.front().time_s);
  double planned_m = 1e-9;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (record.path[i - 1].time_s >= begin_s) planned_m += (path[i] - path[i - 1]).norm();
  }
  const double width_m = look.thickness * look.unit_m;
  TubeItem profile{{}, {looks::kProfile.rgb()}, static_cast<float>(0.9 * width_m)};
  TubeItem planned{{}, {}, static_cast<float>(1.8 * width_m)};
  for (const std::size_t i : simplified(path, 0.25 * look.unit_m, planned_m / 150.0)) {
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

void add_views(const RunRecord& record, int every, const FlightLook& look, RenderScene& scene) {
  const std::size_t count = record.views.size();
  const std::size_t step = pyramid_step(count, every);
  const double unit_m = look.thickness * look.unit_m;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(std::max(count, 2UL) - 1);
    const ViewSize mark{.ball_m = 3.2 * unit_m,
                        .pyramid_m = i % step == 0 ? 27.0 * look.unit_m : 0.0,
                        .edge_m = 0.75 * unit_m,
                        .face_opacity = 0.25F};
    add_view(sights_of(record.scenario), record.views[i].decision.view, mark, path_ramp(share),
             scene);
  }
}

void add_view(std::span<const CameraConfig> cameras, const ViewPose& view, const ViewSize& mark,
              const Rgb& colour, RenderScene& scene) {
  if (mark.ball_m > 0.0) scene.add_ball(view.p_world_m, mark.ball_m, colour);
  if (mark.pyramid_m <= 0.0) return;
  for (const CameraConfig& camera : cameras) {
    FrustumItem frustum =
        frustum_of(camera, T_world_body(view), view.gimbal_pitch_rad, mark.pyramid_m, colour);
    frustum.edge_radius_m = static_cast<float>(mark.edge_m);
    frustum.face_opacity = mark.face_opacity;
    const Vec3 apex = frustum.T_world_camera.translation();
    if ((apex - view.p_world_m).norm() > 8.0 * mark.edge_m) {  // whose view it is could not be told
      scene.add_line(view.p_world_m, apex, mark.edge_m, colour);
    }
    scene.frusta.push_back(std::move(frustum));
  }
}

FrustumItem frustum_of(const CameraConfig& camera, const Isometry& T_world_body,
                       double gimbal_pitch_rad, double length_m, const Rgb& colour) {
  FrustumItem frustum;
  const CameraModel model = turned(make_camera_model(camera), gimbal_pitch_rad);
  frustum.T_world_camera = T_world_body * model.T_body_camera;
  frustum.sight = model.sight;
  frustum.is_radial = model.is_radial();
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

double rotor_span_m(const AirframeParameters& airframe) {
  double span_m = 0.0;
  for (const RotorMount& a : airframe.rotors) {
    for (const RotorMount& b : airframe.rotors) {
      span_m = std::max(span_m, (a.p_body_m - b.p_body_m).norm());
    }
  }
  return span_m;
}

void add_vehicle(const AirframeParameters& airframe, const Isometry& T_world_body, double scale,
                 RenderScene& scene) {
  const double span_m = scale * rotor_span_m(airframe);
  const Vec3 centre = T_world_body.translation();
  scene.add_ball(centre, 0.14 * span_m, looks::kHull.rgb(), true);
  for (const RotorMount& rotor : airframe.rotors) {
    const Vec3 hub = scale * rotor.p_body_m;
    const Rgb colour = (rotor.p_body_m.x() > 0.0 ? looks::kFrontRotors : looks::kRearRotors).rgb();
    scene.add_line(centre, T_world_body * hub, 0.03 * span_m, looks::kHull.rgb(), true);
    Isometry T_world_disc = T_world_body;
    T_world_disc.translation() = T_world_body * (hub + Vec3(0.0, 0.0, 0.06 * span_m));
    scene.surfaces.push_back(disc(T_world_disc, 0.21 * span_m, colour));
  }
}

}  // namespace gnbv
