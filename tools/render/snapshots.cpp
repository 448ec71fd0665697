#include "tools/render/snapshots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "bench/score/voxel_set.hpp"
#include "tools/render/flight_items.hpp"
#include "tools/render/point_normals.hpp"
#include "tools/render/vehicle_item.hpp"
#include "tools/run_files/run_poses.hpp"

namespace gnbv {
namespace {

const Rgb kSeen = srgb(0x0b6fa8);
const Rgb kFrustum = srgb(0xd5420a);

Picture no_picture(RunSource&, const PictureOptions&, const RenderView&) { return {}; }

}  // namespace

const PictureKind kSnapshotFraming = {.name = "snapshots",
                                      .shows = "third-person images each --every views",
                                      .frame = kPathPicture.frame,
                                      .draw = no_picture};

std::vector<std::size_t> snapshot_iterations(std::size_t views, int every, std::size_t about) {
  const std::size_t step = every > 0 ? static_cast<std::size_t>(every)
                                     : std::max<std::size_t>(1, (views + about / 2) / about);
  std::vector<std::size_t> iterations;
  for (std::size_t i = 0; i < views; i += step) iterations.push_back(i);
  if (views > 0 && iterations.back() + 1 < views) iterations.push_back(views - 1);
  return iterations;
}

Snapshots::Snapshots(RunSource& run, const PictureOptions& options, const RenderView& fixed,
                     bool follows)
    : run_(run), options_(options), fixed_(fixed), follows_(follows) {
  iteration_of(run.record(), options, 0);  // a run without views has nothing to show
  const std::vector<Vec3f>& all = run.cloud().points_world_m;
  const double cell_m =
      std::max(1.2 * layout_unit_m(fixed), run.record().scenario.planner.cloud.leaf_m);
  // the first point of each cell stays the first, however much of the cloud is drawn
  std::unordered_set<std::uint64_t> cells;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!cells.insert(voxel_code(all[i], cell_m)).second) continue;
    points_.push_back(i);
    cloud_.points_m.push_back(all[i]);
  }
  cloud_.normals = point_normals(cloud_.points_m, 2.5 * cell_m);
  cloud_.colours = {kSeen};
  cloud_.radius_m = static_cast<float>(0.95 * cell_m);
}

Isometry Snapshots::T_world_body(std::size_t iteration) const {
  const ViewRecord& view = run_.record().views[iteration];
  return true_pose_at(run_.record(), view.time_s).value_or(gnbv::T_world_body(view.decision.view));
}

RenderView Snapshots::view(std::size_t iteration) const {
  if (!follows_) return fixed_;
  const ViewPose& pose = run_.record().views[iteration].decision.view;
  const Vec3 ahead(std::cos(pose.yaw_rad), std::sin(pose.yaw_rad), 0.0);
  const double range_m = run_.record().scenario.cameras.front().range_max_m;
  RenderView view = fixed_;
  view.fov_y_rad = deg_to_rad(45.0);
  const Vec3 eye = pose.p_world_m - 0.9 * range_m * ahead + Vec3(0.0, 0.0, 0.5 * range_m);
  view.T_world_camera = look_at(eye, pose.p_world_m + 0.3 * range_m * ahead);
  view.focus_m = (pose.p_world_m - eye).norm();
  return view;
}

Picture Snapshots::picture(std::size_t iteration, const RenderView& view) const {
  const RunRecord& record = run_.record();
  const ViewRecord& now = record.views[iteration];
  const double unit_m = layout_unit_m(view);
  Picture picture{.panels = std::vector<Panel>(1)};
  RenderScene& scene = picture.panels.front().scene;
  add_ghost(run_, 0.5F, scene);

  const std::size_t seen = run_.cloud().view_points[iteration];
  const auto count = std::lower_bound(points_.begin(), points_.end(), seen) - points_.begin();
  DotsItem dots = cloud_;
  dots.points_m.resize(static_cast<std::size_t>(count));
  dots.normals.resize(static_cast<std::size_t>(count));
  scene.dots.push_back(std::move(dots));

  add_flight(record, {.unit_m = unit_m, .has_profile = false, .until_s = now.time_s}, scene);
  const Isometry T = T_world_body(iteration);
  const AirframeParameters& airframe = record.scenario.vehicle.airframe;
  const double scale = std::max(1.0, 42.0 * unit_m / rotor_span_m(airframe));
  add_vehicle(airframe, T, scale, scene);
  for (const CameraConfig& camera : record.scenario.cameras) {
    FrustumItem frustum =
        frustum_of(camera, T, now.decision.view.gimbal_pitch_rad, camera.range_max_m, kFrustum);
    frustum.edge_radius_m = static_cast<float>(0.9 * unit_m);
    frustum.face_opacity = 0.10F;
    scene.frusta.push_back(frustum);
  }
  picture.detail = fmt::format("view {} of {}, {:.0f} s, {:.1f} m, {} points", iteration,
                               record.views.size() - 1, now.time_s, now.flown_m, now.cloud_points);
  picture.legend = {
      {.label = "last view", .colours = path_colours(), .label_before = "first"},
      {.label = "seen", .colours = {kSeen}, .mark = LegendItem::Mark::dot},
      {.label = scale > 1.05 ? fmt::format("vehicle, {:.1f} times as large", scale) : "vehicle",
       .colours = {kFrustum},
       .mark = LegendItem::Mark::line}};
  return picture;
}

}  // namespace gnbv
