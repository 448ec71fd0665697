#include "tools/render/snapshots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "bench/score/voxel_set.hpp"
#include "sensors/capture.hpp"
#include "sim/core/text.hpp"
#include "tools/run/run_record.hpp"
#include "tools/scene/flight.hpp"
#include "tools/scene/structure.hpp"
#include "tools/scene/voxels.hpp"

namespace gnbv {
namespace {

constexpr double kLeastReach = 0.65;  // of the structure's diagonal
constexpr double kShoulder_rad = 0.6;

/// How far pyramids are drawn: the same everywhere in one run.
double pyramid_m(const RunRecord& record, const World& world, const CameraConfig& camera) {
  Box3 box_m = bounds_m(world.structure);
  for (const ViewRecord& view : record.views) box_m.extend(view.decision.view.p_world_m);
  return std::min(camera.range_max_m, 0.09 * box_m.diagonal().norm());
}

/// The flight, and what its cameras' pyramids reach.
void frame_series(RunSource& run, const PictureOptions& options,
                  std::vector<Vec3>& points_world_m) {
  kPathPicture.frame(run, options, points_world_m);
  const RunRecord& record = run.record();
  for (const CameraConfig& camera : sights_of(record.scenario)) {
    const double length_m = pyramid_m(record, run.world(), camera);
    for (const ViewRecord& view : record.views) {
      const ViewPose& pose = view.decision.view;
      for (const Vec3& corner_m : far_corners_m(
               frustum_of(camera, T_world_body(pose), pose.gimbal_pitch_rad, length_m, {}))) {
        points_world_m.push_back(corner_m);
      }
    }
  }
}

/// "3 of 12 views (iteration 2), 8 s and 2.1 m flown since the first".
std::string flown_so_far(const RunRecord& record, std::size_t iteration, double time_s) {
  const double since_s = time_s - record.views.front().time_s;
  if (since_s < 0.0) return "before the first view";
  return fmt::format("{}, {} s and {} m flown since the first", views_so_far(record, iteration),
                     grouped(static_cast<std::size_t>(std::lround(since_s))),
                     grouped(record.views[iteration].flown_m, 1));
}

Picture no_picture(RunSource&, const PictureOptions&, const RenderView&) { return {}; }

}  // namespace

const PictureKind kSnapshotFraming = {.name = "snapshots",
                                      .shows = "third-person images each --every views",
                                      .has_inset = true,
                                      .frame = frame_series,
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
  const double unit_m = layout_unit_m(view(0));
  // seen from near, points would be balls
  const double cell_m =
      std::max((follows ? 3.2 : 1.2) * unit_m, run.record().scenario.planner.cloud.leaf_m);
  // the first point of each cell stays the first, however much of the cloud is drawn
  std::unordered_set<std::uint64_t> cells;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!cells.insert(voxel_code(all[i], cell_m)).second) continue;
    points_.push_back(i);
    cloud_.points_m.push_back(all[i]);
  }
  cloud_.normals = point_normals(cloud_.points_m, 2.5 * cell_m);
  cloud_.colours = {looks::kSeen.rgb()};
  cloud_.radius_m = static_cast<float>(0.95 * cell_m);
}

std::vector<double> film_times_s(const RunRecord& record, std::size_t images) {
  std::vector<double> times_s;
  if (record.views.empty()) return times_s;
  double begin_s = record.views.front().time_s;
  double end_s = record.views.back().time_s;
  if (!record.path.empty()) {
    const ProfilingMethod profile = record.scenario.planner.profiling.method;
    const bool is_from_take_off =
        profile == ProfilingMethod::none || profile == ProfilingMethod::saved;
    if (is_from_take_off) begin_s = std::min(begin_s, record.path.front().time_s);
    end_s = std::max(end_s, record.path.back().time_s);
  }
  const double whole_s = end_s - begin_s;
  const std::size_t count = whole_s > 0.0 ? std::max<std::size_t>(images, 2) : 1;
  for (std::size_t i = 0; i < count; ++i) {
    times_s.push_back(begin_s + whole_s * static_cast<double>(i) /
                                    static_cast<double>(std::max<std::size_t>(count - 1, 1)));
  }
  return times_s;
}

std::size_t Snapshots::iteration_at(double time_s) const {
  const std::vector<ViewRecord>& views = run_.record().views;
  const auto after =
      std::upper_bound(views.begin(), views.end(), time_s,
                       [](double t_s, const ViewRecord& view) { return t_s < view.time_s; });
  return after == views.begin() ? 0 : static_cast<std::size_t>(after - views.begin()) - 1;
}

Isometry Snapshots::T_world_body(double time_s) const {
  const ViewRecord& last = run_.record().views[iteration_at(time_s)];
  return true_pose_at(run_.record(), time_s).value_or(gnbv::T_world_body(last.decision.view));
}

RenderView Snapshots::view(std::size_t iteration) const {
  RenderView view = view_at(run_.record().views[iteration].time_s);
  // a film keeps its light; a picture by itself shows the side that it is taken from
  if (follows_) view.to_light_world = key_light(view.T_world_camera);
  return view;
}

/// Over the vehicle's right shoulder, towards the middle of the structure: it turns evenly, however
/// the vehicle does. As far away as the middle of the structure, within what the cameras see.
RenderView Snapshots::view_at(double time_s) const {
  if (!follows_) return fixed_;
  Vec3 sum_m = Vec3::Zero();  // over some seconds of the path: what hangs on it does not jerk
  double count = 0.0;
  for (double shift_s = -3.0; shift_s <= 3.0; shift_s += 0.25) {
    const auto pose = true_pose_at(run_.record(), time_s + shift_s);
    if (!pose) continue;
    sum_m += pose->translation();
    count += 1.0;
  }
  const Vec3 place_m = count > 0.0 ? Vec3(sum_m / count) : T_world_body(time_s).translation();
  const Box3 structure_m = bounds_m(run_.world().structure);
  Vec3 ahead = structure_m.center() - place_m;
  ahead.z() = 0.0;
  const double reach_m =
      std::min(sights_of(run_.record().scenario).front().range_max_m,
               std::max(ahead.norm(), kLeastReach * structure_m.diagonal().norm()));
  ahead = ahead.norm() > 1e-6 ? Vec3(ahead.normalized()) : Vec3(Vec3::UnitX());
  const Vec3 back = Eigen::AngleAxisd(kShoulder_rad, Vec3::UnitZ()) * Vec3(-ahead);
  const Vec3 eye = place_m + reach_m * (back + Vec3(0.0, 0.0, 0.55));
  RenderView view = fixed_;
  view.fov_y_rad = deg_to_rad(45.0);
  view.T_world_camera = look_at(eye, place_m + 0.45 * reach_m * ahead);
  view.focus_m = (place_m - eye).norm();
  return view;
}

const Image& Snapshots::seen_by_camera(std::size_t iteration) {
  if (onboard_ && onboard_->first == iteration) return onboard_->second;
  const RunRecord& record = run_.record();
  const ViewRecord& view = record.views[iteration];
  const CameraConfig& config = record.scenario.cameras.front();
  const CameraModel camera = turned(make_camera_model(config), view.decision.view.gimbal_pitch_rad);
  ColourFrame frame = capture_colour(run_.scene().at(view.time_s), camera, 0,
                                     T_world_body(view.time_s), run_.threads());
  Image image{config.width_px, config.height_px, {}};
  for (const Rgb8& pixel : frame.rgb) image.rgb.insert(image.rgb.end(), pixel.begin(), pixel.end());
  onboard_.emplace(iteration, std::move(image));
  return onboard_->second;
}

Picture Snapshots::picture_at(double time_s, double speed, const RenderView& view) {
  const RunRecord& record = run_.record();
  const std::size_t iteration = iteration_at(time_s);
  const ViewRecord& now = record.views[iteration];
  const double unit_m = layout_unit_m(view);
  Picture picture{.panels = std::vector<Panel>(1)};
  RenderScene& scene = picture.panels.front().scene;
  if (speed > 0.0) {  // all that a film shows, near enough
    scene.series_box_m = bounds_m(run_.world().structure);
    for (const TrajectorySample& sample : record.path) {
      scene.series_box_m->extend(sample.T_world_body.translation());
    }
  }
  add_ghost(run_, 0.5F, scene, time_s);

  const bool has_begun = time_s >= record.views.front().time_s;
  const RunCloud& cloud = run_.cloud();
  const std::size_t seen = has_begun ? cloud.view_points[iteration] : cloud.profile_points;
  const auto count = std::lower_bound(points_.begin(), points_.end(), seen) - points_.begin();
  DotsItem dots = cloud_;
  dots.points_m.resize(static_cast<std::size_t>(count));
  dots.normals.resize(static_cast<std::size_t>(count));
  scene.dots.push_back(std::move(dots));

  add_flight(record,
             {.unit_m = unit_m,
              .has_profile = false,
              .until_s = time_s,
              .thickness = follows_ ? 0.85 : 1.0},  // from near it would hide what it passes
             scene);
  const Isometry T = T_world_body(time_s);
  const AirframeParameters& airframe = record.scenario.vehicle.airframe;
  const double scale = std::max(1.0, 42.0 * unit_m / rotor_span_m(airframe));
  add_vehicle(airframe, T, scale, scene);
  for (const CameraConfig& camera : sights_of(record.scenario)) {
    // seen from near, as by a camera that follows, it would fill the picture
    const double length_m =
        std::min(pyramid_m(record, run_.world(), camera), (follows_ ? 90.0 : 130.0) * unit_m);
    FrustumItem frustum =
        frustum_of(camera, T, now.decision.view.gimbal_pitch_rad, length_m, looks::kCamera.rgb());
    frustum.edge_radius_m = static_cast<float>(1.3 * unit_m);
    scene.frusta.push_back(frustum);
  }
  picture.detail =
      fmt::format("{}, {}{}", flown_so_far(record, iteration, time_s), counted(seen, "point"),
                  speed > 0.0 ? fmt::format(", shown {:.0f} times as fast", speed) : "");
  const std::string larger = scale > 1.05 ? fmt::format(", {:.1f} times as large", scale) : "";
  picture.legend = {bar(path_colours(), "first", "last view"),
                    {"not seen yet", {looks::kStructure.rgb()}},
                    entry(looks::kSeen, LegendItem::Mark::dot),
                    {"vehicle" + larger, {looks::kFrontRotors.rgb()}},
                    entry(looks::kCamera, LegendItem::Mark::pyramid)};
  if (!record.scenario.obstacles.empty()) picture.legend.push_back(entry(looks::kObstacle));
  if (has_begun && !record.scenario.cameras.empty()) picture.inset = seen_by_camera(iteration);
  picture.inset_words = "the camera's last view";
  return picture;
}

}  // namespace gnbv
