// Each figure as pictures and plots of the rooms that draw runs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "bench/compare/paper_figures.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/figures/run_figures.hpp"
#include "tools/paper/comparisons.hpp"
#include "tools/paper/figures.hpp"
#include "tools/render/grid_samples.hpp"
#include "tools/scene/flight.hpp"
#include "tools/surface/surface.hpp"
#include "tools/surface/surface_picture.hpp"

namespace gnbv {
namespace {

/// For a place beside others, whose words stand below it.
PictureOptions plain_options() {
  PictureOptions options;
  options.width_px = 960;
  options.height_px = 600;
  options.has_caption = false;
  return options;
}

Image picture_of(FigureDesk& desk, const PictureKind& kind, RunSource& run,
                 const PictureOptions& options) {
  RunSource* const runs[] = {&run};
  return draw_picture(kind, run, options, lay_out(kind, runs, options), desk.renderer());
}

/// The first view, from 1 on, that was chosen from a grid, of that scale if one is given.
std::optional<int> first_grid_view(const RunRecord& record, std::optional<double> scale = {}) {
  for (std::size_t i = 1; i < record.views.size(); ++i) {
    const Decision& decision = record.views[i].decision;
    if (traits_of(decision.sampler).on_grid && (!scale || decision.scale == *scale)) {
      return static_cast<int>(i);
    }
  }
  return std::nullopt;
}

void add_decision(FigureDesk& desk, int view, const std::string& what, const std::string& label) {
  PictureOptions options;
  options.iteration = view;
  desk.add(what, label, picture_of(desk, kCandidatesPicture, desk.source("proposed"), options));
}

/// What the paper calls a utility.
std::string label_of(const std::string& scenario, std::string_view utility) {
  return std::string(find_row(*find_paper_table(scenario), utility)->label);
}

/// Two directions of a lab flight, as the paper has them.
constexpr std::array<std::array<const char*, 2>, 2> kDirections = {
    {{"front", "from the side"}, {"top", "from above"}}};

const Rgb kImagePlace = srgb(0x12a150);

}  // namespace

void draw_rays_figure(FigureDesk& desk) {
  const std::optional<int> view = first_grid_view(desk.mission("proposed").record);
  if (!view) throw BadInput("the mission planned no view from the grid");
  add_decision(desk, *view, "rays", "");
}

void draw_profile_figure(FigureDesk& desk) {
  PictureOptions options;
  options.height_px = 480;
  options.has_profile = true;
  PictureKind wide = kProfilePicture;  // the paper shows the flight around the workspace, too
  wide.frame = kPathPicture.frame;
  desk.add("profile", "", picture_of(desk, wide, desk.source("proposed"), options));
}

void draw_scales_figure(FigureDesk& desk) {
  RunSource& run = desk.source("proposed");
  const RunRecord& record = run.record();
  const std::optional<int> view = first_grid_view(record);
  if (!view) throw BadInput("the mission planned no view from the grid");
  const ViewPose& from = record.views[static_cast<std::size_t>(*view) - 1].decision.view;
  const AgvsConfig& grid = record.scenario.planner.agvs;
  const std::array<double, 3> scales = {1.0, grid.scale_factor,
                                        grid.scale_factor * grid.scale_factor};
  PictureOptions options = plain_options();
  options.iteration = *view - 1;
  const RenderView camera = view_of_grid_samples(grid, from, scales.back(), ViewAngles{},
                                                 options.width_px, options.height_px);
  for (std::size_t i = 0; i < scales.size(); ++i) {
    RenderScene scene = kVoxelsPicture.draw(run, options, camera).panels.front().scene;
    add_grid_samples(grid, from, scales[i], layout_unit_m(camera), scene);
    const bool is_flown = first_grid_view(record, scales[i]).has_value();
    desk.add(fmt::format("scale-{}", i),
             fmt::format("scale {:g}{}", scales[i],
                         is_flown ? "" : ", which this mission did not come to"),
             desk.renderer().render(scene, camera));
  }
}

void draw_frontiers_figure(FigureDesk& desk) {
  // at first everything is a frontier
  std::vector<int> views;
  for (const ViewRecord& view : desk.mission("proposed").record.views) {
    if (traits_of(view.decision.sampler).at_frontier) views.push_back(view.iteration);
  }
  if (views.empty()) throw BadInput("this mission chose no view at frontiers");
  add_decision(desk, views[views.size() / 2], "frontiers", "");
}

void draw_paths_figure(FigureDesk& desk) {
  const std::array<const char*, 3> utilities = {"proposed", "isler", "bircher"};  // as the paper
  for (const PictureKind* const kind : {&kPathPicture, &kCoveragePicture}) {
    std::vector<RunSource*> runs;
    std::vector<std::string> names;
    for (const char* const utility : utilities) {
      try {
        runs.push_back(&desk.source(utility));
        names.emplace_back(utility);
      } catch (const BadInput& error) {
        if (kind == &kPathPicture) desk.miss(error.what());  // once is enough
      }
    }
    if (runs.empty()) return;
    const PanelLayout layout = lay_out(*kind, runs, plain_options());  // one camera for all
    const PictureOptions options = with_shared_angles(*kind, runs, plain_options(), layout.view);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const RunFigures& figures = *runs[i]->record().figures;
      const auto place = std::find(utilities.begin(), utilities.end(), names[i]);
      const std::string name =
          fmt::format("({}) {}", static_cast<char>('a' + (place - utilities.begin())),
                      label_of(desk.figure().scenario, names[i]));
      const std::string label =
          kind == &kPathPicture
              ? fmt::format("{}: {} views, {:.0f} m", name, runs[i]->record().views.size(),
                            figures.straight_m)
              : fmt::format("{}: {:.1f} % at 0.05 m", name, 100.0 * figures.coverage_final[0]);
      desk.add(fmt::format("{}-{}", kind->name, names[i]), label,
               draw_picture(*kind, *runs[i], options, layout, desk.renderer()));
      runs[i]->forget();
    }
  }
}

void draw_densities_figure(FigureDesk& desk) {
  const std::vector<DrawnGroup> series =
      mean_densities(desk.material(), *find_paper_table(desk.figure().scenario));
  if (series.empty()) throw BadInput("no mission came to its end");
  desk.add("density", "", mean_density_figure(series, human_name(desk.figure().scenario)));
}

void draw_entropy_figure(FigureDesk& desk) {
  const std::optional<Figure> figure = density_entropy_figure(desk.mission("proposed").record);
  if (!figure) throw BadInput("the mission took no view");
  desk.add("density-entropy", "", *figure);
}

void draw_path_in_map_figure(FigureDesk& desk) {
  RunSource& run = desk.source("proposed");
  const RunRecord& record = run.record();
  for (const auto& [camera, label] : kDirections) {
    PictureOptions options = plain_options();
    options.angles = choose_camera(camera).angles;
    options.has_profile = true;
    RunSource* const runs[] = {&run};
    const PanelLayout layout = lay_out(kPathPicture, runs, options);
    Picture picture = kVoxelsPicture.draw(run, options, layout.view);
    const FlightLook look{.unit_m = layout_unit_m(layout.view), .has_profile = true};
    add_flight(record, look, picture.panels.front().scene);
    add_views(record, options.every, look, picture.panels.front().scene);
    desk.add(fmt::format("path-{}", camera), label,
             draw_picture(picture, run, options, layout, desk.renderer()));
  }
}

void draw_reconstruction_figure(FigureDesk& desk) {
  const auto& pictured = desk.material().with_images;
  const auto mission = std::find_if(pictured.begin(), pictured.end(), [&](const PaperMission& m) {
    return m.scenario == desk.figure().scenario;
  });
  if (mission == pictured.end()) throw BadInput("no mission that kept its images came to its end");
  const RunRecord& record = mission->record;
  std::vector<std::string> notes;
  // vertices get the images' colours alike, so that there have to be many
  const SurfaceSettings settings{.simplify_m = 0.0, .has_texture = false};
  const TexturedMesh mesh = reconstruct_surface(
      record, settings, desk.threads(), [](double, const std::string&) {}, notes);
  for (const std::string& note : notes) desk.miss(note);
  const PictureOptions options = plain_options();
  for (const auto& [camera, label] : kDirections) {
    RenderScene scene;
    scene.surfaces.push_back(surface_item(mesh));
    scene.ground = GroundItem{};
    std::vector<Vec3> points_m;
    for (const Vec3f& p_m : mesh.shape.vertices_m) points_m.push_back(p_m.cast<double>());
    for (const ViewRecord& view : record.views) points_m.push_back(view.decision.view.p_world_m);
    const RenderView view =
        frame_points(points_m, choose_camera(camera).angles, options.width_px, options.height_px);
    const auto radius_m = static_cast<float>(5.0 * layout_unit_m(view));
    for (const ViewRecord& taken : record.views) {
      scene.balls.push_back({taken.decision.view.p_world_m.cast<float>(), radius_m, kImagePlace});
    }
    desk.add(fmt::format("surface-{}", camera), label, desk.renderer().render(scene, view));
  }
}

}  // namespace gnbv
