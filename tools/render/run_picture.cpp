#include "tools/render/run_picture.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "tools/render/lettering.hpp"

namespace gnbv {
namespace {

const Rgb kProfileColour = srgb(0x7b8896);
constexpr Rgb8 kInk = {38, 44, 54};
constexpr Rgb8 kPaleInk = {92, 100, 112};

// Everything is laid out in units of a pixel of a 1280 x 720 picture, small pictures coarser.
double unit_px(int width_px, int height_px) {
  return std::max(0.7, std::min(width_px / 1280.0, height_px / 720.0));
}

bool has_caption(const RunPictureOptions& options) {
  return options.has_caption && options.width_px >= 320 && options.height_px >= 240;
}

double px_per_m_at_focus(const RenderView& view) {
  return 0.5 * view.height_px / std::tan(0.5 * view.fov_y_rad) / view.focus_m;
}

// A sample is dropped where the path between its kept neighbours lies within `tolerance_m` of the
// straight line between them, while these stay within `reach_m` of each other (colours change along
// the way).
std::vector<std::size_t> simplified(const std::vector<TrajectorySample>& path, double tolerance_m,
                                    double reach_m) {
  std::vector<std::size_t> kept = {0};
  const auto is_straight = [&](std::size_t a, std::size_t b) {
    const Vec3 chord = path[b].T_world_body.translation() - path[a].T_world_body.translation();
    const double length_m = chord.norm();
    if (length_m > reach_m) return false;
    for (std::size_t i = a + 1; i < b; ++i) {
      const Vec3 away = path[i].T_world_body.translation() - path[a].T_world_body.translation();
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

// Metres flown up to each sample since the profile flight ended; 0 during it.
std::vector<double> planned_metres(const RunRecord& record) {
  const double begin_s = record.views_begin_s.value_or(record.path.front().time_s);
  std::vector<double> metres(record.path.size(), 0.0);
  for (std::size_t i = 1; i < metres.size(); ++i) {
    const double step_m =
        (record.path[i].T_world_body.translation() - record.path[i - 1].T_world_body.translation())
            .norm();
    metres[i] = metres[i - 1] + (record.path[i - 1].time_s >= begin_s ? step_m : 0.0);
  }
  return metres;
}

void add_path(const RunRecord& record, double unit_m, RenderScene& scene) {
  if (record.path.empty()) return;
  const std::vector<double> metres = planned_metres(record);
  const double total_m = std::max(metres.back(), 1e-9);
  const double begin_s = record.views_begin_s.value_or(record.path.front().time_s);
  TubeItem profile{{}, {kProfileColour}, static_cast<float>(1.05 * unit_m)};
  TubeItem planned{{}, {}, static_cast<float>(1.8 * unit_m)};
  for (const std::size_t i : simplified(record.path, 0.25 * unit_m, total_m / 150.0)) {
    const Vec3f p = record.path[i].T_world_body.translation().cast<float>();
    const bool is_profile = record.path[i].time_s < begin_s;
    if (is_profile || planned.points_m.empty()) profile.points_m.push_back(p);
    if (is_profile) continue;
    planned.points_m.push_back(p);
    planned.colours.push_back(path_ramp(metres[i] / total_m));
  }
  if (profile.points_m.size() > 1) scene.tubes.push_back(std::move(profile));
  if (!planned.points_m.empty()) scene.tubes.push_back(std::move(planned));
}

void add_views(const RunRecord& record, const RunPictureOptions& options, double unit_m,
               RenderScene& scene) {
  const std::size_t count = record.views.size();
  const std::size_t every =
      options.frustum_every > 0 ? static_cast<std::size_t>(options.frustum_every) : 1 + count / 40;
  const Isometry T_body_camera = make_camera_model(record.scenario.cameras.front()).T_body_camera;
  for (std::size_t i = 0; i < count; ++i) {
    const ViewPose& pose = record.views[i].decision.view;
    const Rgb colour =
        path_ramp(count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0.0);
    scene.balls.push_back({pose.p_world_m.cast<float>(), static_cast<float>(3.4 * unit_m), colour});
    if (i % every != 0) continue;
    FrustumItem frustum;
    frustum.T_world_camera = T_world_body(pose) * T_body_camera;
    frustum.fov_x_rad = record.scenario.cameras.front().fov_x_rad;
    frustum.fov_y_rad = record.scenario.cameras.front().fov_y_rad;
    frustum.length_m = 27.0 * unit_m;
    frustum.edge_radius_m = static_cast<float>(0.75 * unit_m);
    frustum.colour = colour;
    frustum.face_opacity = 0.25F;
    scene.frusta.push_back(frustum);
  }
}

// The longest of 1, 2, 5, 10 ... m that stays under `limit_m`.
double round_length_m(double limit_m) {
  const double power = std::pow(10.0, std::floor(std::log10(limit_m)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= limit_m) return step * power;
  }
  return power;
}

}  // namespace

RenderView run_view(const RunRecord& record, const TriangleMesh& structure,
                    const RunPictureOptions& options) {
  std::vector<Vec3> points;
  points.reserve(structure.vertices_m.size() + record.path.size() + record.views.size());
  for (const Vec3f& v : structure.vertices_m) points.push_back(v.cast<double>());
  for (const TrajectorySample& sample : record.path) {
    points.push_back(sample.T_world_body.translation());
  }
  for (const ViewRecord& view : record.views) points.push_back(view.decision.view.p_world_m);
  FrameMargins margins;
  if (has_caption(options)) {
    const double u = unit_px(options.width_px, options.height_px) / options.height_px;
    // the title fills a corner that wide pictures leave free anyway
    const bool is_wide = 3 * options.width_px > 4 * options.height_px;
    margins.top = (is_wide ? 34.0 : 82.0) * u;
    margins.bottom = 46.0 * u;
  }
  return frame_points(points, options.angles, options.width_px, options.height_px, margins);
}

RenderScene run_scene(const RunRecord& record, const TriangleMesh& structure,
                      const RunPictureOptions& options, const RenderView& view) {
  RenderScene scene;
  if (!structure.faces.empty()) {
    SurfaceItem surface;
    surface.mesh = structure;
    scene.surfaces.push_back(std::move(surface));
  }
  if (record.scenario.structure.ground) scene.ground = GroundItem{};
  const double unit_m = unit_px(view.width_px, view.height_px) / px_per_m_at_focus(view);
  add_path(record, unit_m, scene);
  add_views(record, options, unit_m, scene);
  return scene;
}

void draw_run_caption(Image& image, const RunRecord& record, const RunPictureOptions& options,
                      const RenderView& view) {
  const double u = unit_px(image.width_px, image.height_px);
  const double bottom = image.height_px - 24.0 * u;
  const std::string title = options.title.empty() ? run_title(record) : options.title;
  draw_text(image, title, 26.0 * u, 40.0 * u, 15.0 * u, kInk);
  draw_text(image, run_detail(record), 26.0 * u, 64.0 * u, 10.0 * u, kPaleInk);

  // scale bar, true at the focus
  const double px_per_m = px_per_m_at_focus(view);
  const double length_m = round_length_m(0.16 * image.width_px / px_per_m);
  const double x0 = 26.0 * u;
  const double x1 = x0 + length_m * px_per_m;
  draw_line(image, {x0, bottom}, {x1, bottom}, 2.0 * u, kInk);
  for (const double x : {x0, x1}) {
    draw_line(image, {x, bottom - 5.0 * u}, {x, bottom + 5.0 * u}, 2.0 * u, kInk);
  }
  draw_text(image, fmt::format("{} m", length_m), x1 + 10.0 * u, bottom + 5.0 * u, 10.0 * u, kInk);

  // colour key, laid out from the right
  double x = image.width_px - 26.0 * u;
  const auto write_before = [&](const std::string& text) {
    x -= text_width_px(text, 10.0 * u);
    draw_text(image, text, x, bottom + 5.0 * u, 10.0 * u, kInk);
    x -= 10.0 * u;
  };
  write_before("last");
  const double bar = 120.0 * u;
  x -= bar;
  for (double d = 0.0; d < bar; d += 1.0) {
    draw_line(image, {x + d, bottom}, {x + std::min(d + 1.0, bar), bottom}, 6.0 * u,
              to_rgb8(path_ramp(d / bar)));
  }
  x -= 10.0 * u;
  write_before("first view");
  if (!record.views_begin_s) return;
  x -= 16.0 * u;
  write_before("profile");
  draw_line(image, {x - 30.0 * u, bottom}, {x, bottom}, 4.0 * u, to_rgb8(kProfileColour));
}

void render_run(const RunRecord& record, const TriangleMesh& structure,
                const RunPictureOptions& options, const std::filesystem::path& png) {
  const RenderView view = run_view(record, structure, options);
  Image image = render(run_scene(record, structure, options, view), view);
  if (has_caption(options)) draw_run_caption(image, record, options, view);
  write_png(image, png);
}

}  // namespace gnbv
