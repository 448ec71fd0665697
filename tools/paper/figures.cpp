#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <list>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/compare/paper_figures.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/figures/group_figures.hpp"
#include "tools/figures/run_figures.hpp"
#include "tools/paper/comparisons.hpp"
#include "tools/paper/page.hpp"
#include "tools/render/grid_samples.hpp"
#include "tools/render/pictures.hpp"
#include "tools/scene/flight.hpp"
#include "tools/surface/surface.hpp"
#include "tools/surface/surface_picture.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFiguresFolder = "figures";
const Rgb kImagePlace = srgb(0x12a150);

/// Where a figure is drawn: the missions, and what it leaves.
class FigureDesk {
 public:
  FigureDesk(const PaperMaterial& its_material, fs::path folder, int its_threads)
      : material(its_material), threads(its_threads), folder_(std::move(folder)) {}

  const PaperMaterial& material;
  const int threads;
  std::string scenario;                   // of which the figure is
  std::vector<std::string> missing = {};  // a sentence each: what it does not show, and why
  std::vector<Figure> curves = {};        // of all figures

  void begin(std::string number, std::string of_scenario) {
    number_ = std::move(number);
    scenario = std::move(of_scenario);
    missing.clear();
    pictures_ = Json::array();
  }

  /// Throws BadInput as Renderer does; only what is drawn in 3D needs one.
  Renderer& renderer() { return renderer_ ? *renderer_ : renderer_.emplace(); }

  /// The first seed's mission of a utility. Throws BadInput when there is none.
  const PaperMission& mission(std::string_view utility) const {
    const auto missions = missions_of(material, scenario, utility);
    if (!missions.empty()) return *missions.front();
    throw BadInput("no mission of {} by {} came to its end", scenario, utility);
  }
  RunSource source(std::string_view utility) const {
    return {mission(utility).record.folder, threads, [](double, const std::string&) {}};
  }

  void add(const std::string& what, const std::string& label, const Image& image) {
    const std::string path = path_of(what, ".png");
    pictures_.push_back({{"path", path}, {"label", label}, {"curve", nullptr}});
    write_png(image, folder_ / path);
  }
  /// A curve is drawn with the page.
  void add(const std::string& what, Figure curve) {
    const fs::path path = path_of(what, ".svg");
    curve.name = path.stem().string();
    pictures_.push_back({{"path", path.string()}, {"label", ""}, {"curve", curve.name}});
    curves.push_back(std::move(curve));
  }

  Json shown() const {
    return {{"number", number_},
            {"scenario", human_name(scenario)},
            {"pictures", pictures_},
            {"missing", missing}};
  }

 private:
  std::string path_of(const std::string& what, const char* ending) const {
    return fmt::format("{}/fig{:0>2}-{}{}", kFiguresFolder, number_, what, ending);
  }

  fs::path folder_;
  std::optional<Renderer> renderer_;
  std::string number_;
  Json pictures_;
};

/// For a place beside others, whose words stand below it.
PictureOptions plain_options() { return {.width_px = 960, .height_px = 600, .has_caption = false}; }

Image picture_of(FigureDesk& desk, const PictureKind& kind, RunSource& run,
                 const PictureOptions& options) {
  RunSource* const runs[] = {&run};
  return draw_picture(kind, run, options, lay_out(kind, runs, options), desk.renderer());
}

/// The first view, from 1 on, that was chosen from a grid, of that scale if one is given.
std::optional<int> find_grid_view(const RunRecord& record, std::optional<double> scale = {}) {
  for (std::size_t i = 1; i < record.views.size(); ++i) {
    const Decision& decision = record.views[i].decision;
    if (traits_of(decision.sampler).on_grid && (!scale || decision.scale == *scale)) {
      return static_cast<int>(i);
    }
  }
  return std::nullopt;
}

int first_grid_view(const RunRecord& record) {
  if (const std::optional<int> view = find_grid_view(record)) return *view;
  throw BadInput("the mission planned no view from the grid");
}

void add_decision(FigureDesk& desk, int view, const std::string& what) {
  RunSource run = desk.source("proposed");
  desk.add(what, "", picture_of(desk, kCandidatesPicture, run, {.iteration = view}));
}

/// Two directions of a lab flight, as the paper has them.
constexpr std::array<std::array<const char*, 2>, 2> kDirections = {
    {{"front", "from the side"}, {"top", "from above"}}};

void draw_rays(FigureDesk& desk) {
  add_decision(desk, first_grid_view(desk.mission("proposed").record), "rays");
}

void draw_profile(FigureDesk& desk) {
  PictureKind wide = kProfilePicture;  // the paper shows the flight around the workspace, too
  wide.frame = kPathPicture.frame;
  RunSource run = desk.source("proposed");
  desk.add("profile", "", picture_of(desk, wide, run, {.height_px = 480, .has_profile = true}));
}

void draw_scales(FigureDesk& desk) {
  RunSource run = desk.source("proposed");
  const RunRecord& record = run.record();
  const int before = first_grid_view(record) - 1;
  const ViewPose& from = record.views[static_cast<std::size_t>(before)].decision.view;
  const AgvsConfig& grid = record.scenario.planner.agvs;
  const std::array<double, 3> scales = {1.0, grid.scale_factor,
                                        grid.scale_factor * grid.scale_factor};
  PictureOptions options = plain_options();
  options.iteration = before;
  const RenderView camera = view_of_grid_samples(grid, from, scales.back(), ViewAngles{},
                                                 options.width_px, options.height_px);
  for (std::size_t i = 0; i < scales.size(); ++i) {
    RenderScene scene = kVoxelsPicture.draw(run, options, camera).panels.front().scene;
    add_grid_samples(grid, from, scales[i], layout_unit_m(camera), scene);
    const bool is_flown = find_grid_view(record, scales[i]).has_value();
    desk.add(fmt::format("scale-{}", i),
             fmt::format("scale {:g}{}", scales[i],
                         is_flown ? "" : ", which this mission did not come to"),
             desk.renderer().render(scene, camera));
  }
}

void draw_frontiers(FigureDesk& desk) {
  // at first everything is a frontier
  std::vector<int> views;
  for (const ViewRecord& view : desk.mission("proposed").record.views) {
    if (traits_of(view.decision.sampler).at_frontier) views.push_back(view.iteration);
  }
  if (views.empty()) throw BadInput("this mission chose no view at frontiers");
  add_decision(desk, views[views.size() / 2], "frontiers");
}

void draw_paths(FigureDesk& desk) {
  const PaperTable& table = *find_paper_table(desk.scenario);
  std::list<RunSource> sources;
  std::vector<RunSource*> runs;
  std::vector<std::string> names;
  char letter = 'a';
  for (const char* const utility : {"proposed", "isler", "bircher"}) {  // as the paper
    const std::string name = fmt::format("({}) {}", letter++, find_row(table, utility)->label);
    try {
      const fs::path& folder = desk.mission(utility).record.folder;
      sources.emplace_back(folder, desk.threads, [](double, const std::string&) {});
      runs.push_back(&sources.back());
      names.push_back(name);
    } catch (const BadInput& error) {
      desk.missing.emplace_back(error.what());
    }
  }
  if (runs.empty()) return;
  for (const PictureKind* const kind : {&kPathPicture, &kCoveragePicture}) {
    const PanelLayout layout = lay_out(*kind, runs, plain_options());  // one camera for all
    const PictureOptions options = with_shared_angles(*kind, runs, plain_options(), layout.view);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const RunFigures& figures = *runs[i]->record().figures;
      const std::string reached =
          kind == &kPathPicture
              ? fmt::format("{} views, {:.0f} m", figures.iterations, figures.straight_m)
              : fmt::format("{:.1f} % at 0.05 m", 100.0 * figures.coverage_final[0]);
      desk.add(fmt::format("{}-{}", kind->name, figures.utility),
               fmt::format("{}: {}", names[i], reached),
               draw_picture(*kind, *runs[i], options, layout, desk.renderer()));
      runs[i]->forget();  // maps of many missions are large
    }
  }
}

void draw_densities(FigureDesk& desk) {
  const std::vector<DrawnGroup> groups =
      mean_densities(desk.material, *find_paper_table(desk.scenario));
  if (groups.empty()) throw BadInput("no mission came to its end");
  desk.add("density", mean_density_figure(groups, human_name(desk.scenario)));
}

void draw_entropy(FigureDesk& desk) {
  const std::optional<Figure> figure = density_entropy_figure(desk.mission("proposed").record);
  if (!figure) throw BadInput("the mission took no view");
  desk.add("density-entropy", *figure);
}

void draw_path_in_map(FigureDesk& desk) {
  RunSource run = desk.source("proposed");
  RunSource* const runs[] = {&run};
  for (const auto& [camera, label] : kDirections) {
    PictureOptions options = plain_options();
    options.angles = choose_camera(camera).angles;
    options.has_profile = true;
    const PanelLayout layout = lay_out(kPathPicture, runs, options);
    Picture picture = kVoxelsPicture.draw(run, options, layout.view);
    const FlightLook look{.unit_m = layout_unit_m(layout.view), .has_profile = true};
    add_flight(run.record(), look, picture.panels.front().scene);
    add_views(run.record(), options.every, look, picture.panels.front().scene);
    desk.add(fmt::format("path-{}", camera), label,
             draw_picture(picture, run, options, layout, desk.renderer()));
  }
}

void draw_reconstruction(FigureDesk& desk) {
  const auto& pictured = desk.material.with_images;
  const auto mission = std::find_if(pictured.begin(), pictured.end(), [&](const PaperMission& m) {
    return m.scenario == desk.scenario;
  });
  if (mission == pictured.end()) throw BadInput("no mission that kept its images came to its end");
  const RunRecord& record = mission->record;
  // vertices get the images' colours alike, so that there have to be many
  const SurfaceSettings settings{.simplify_m = 0.0, .has_texture = false};
  const TexturedMesh mesh = reconstruct_surface(
      record, settings, desk.threads, [](double, const std::string&) {}, desk.missing);
  std::vector<Vec3> points_m;
  for (const Vec3f& p_m : mesh.shape.vertices_m) points_m.push_back(p_m.cast<double>());
  for (const ViewRecord& view : record.views) points_m.push_back(view.decision.view.p_world_m);
  const PictureOptions options = plain_options();
  for (const auto& [camera, label] : kDirections) {
    RenderScene scene;
    scene.surfaces.push_back(surface_item(mesh));
    scene.ground = GroundItem{};
    const RenderView view =
        frame_points(points_m, choose_camera(camera).angles, options.width_px, options.height_px);
    const auto radius_m = static_cast<float>(5.0 * layout_unit_m(view));
    for (const ViewRecord& taken : record.views) {
      scene.balls.push_back({taken.decision.view.p_world_m.cast<float>(), radius_m, kImagePlace});
    }
    desk.add(fmt::format("surface-{}", camera), label, desk.renderer().render(scene, view));
  }
}

/// A figure of the paper, and how it becomes ours.
struct FigureKind {
  const char* number;
  std::vector<std::string> scenarios;  // of which the first that was asked for is drawn
  void (*draw)(FigureDesk& desk);      // throws BadInput for what cannot be drawn
};

/// In the paper's order.
std::vector<FigureKind> figure_kinds() {
  const std::vector<std::string> any = {"aircraft", "power_plant", "lab_model", "lab_airplane"};
  return {{"2", any, draw_rays},
          {"4", any, draw_profile},
          {"5", any, draw_scales},
          {"6", any, draw_frontiers},
          {"8", {"aircraft"}, draw_paths},
          {"9", {"aircraft"}, draw_densities},
          {"10", {"power_plant"}, draw_paths},
          {"11", {"power_plant"}, draw_entropy},
          {"13", {"lab_model"}, draw_path_in_map},
          {"14", {"lab_model"}, draw_entropy},
          {"15", {"lab_model"}, draw_reconstruction},
          {"16", {"lab_airplane"}, draw_path_in_map},
          {"17", {"lab_airplane"}, draw_entropy},
          {"18", {"lab_airplane"}, draw_reconstruction}};
}

}  // namespace

Json draw_figures(const PaperMaterial& material, const fs::path& folder, int threads,
                  const FigureProgress& progress) {
  make_folder(folder / kFiguresFolder);
  FigureDesk desk(material, folder, threads);
  const std::vector<FigureKind> kinds = figure_kinds();
  Json shown = Json::array();
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const auto& asked = material.request.scenarios;
    const auto scenario = std::find_first_of(kinds[i].scenarios.begin(), kinds[i].scenarios.end(),
                                             asked.begin(), asked.end());
    if (scenario == kinds[i].scenarios.end()) continue;
    progress(static_cast<double>(i) / static_cast<double>(kinds.size()),
             fmt::format("Figure {}", kinds[i].number));
    desk.begin(kinds[i].number, *scenario);
    try {
      kinds[i].draw(desk);
    } catch (const BadInput& error) {
      desk.missing.emplace_back(error.what());
    }
    shown.push_back(desk.shown());
  }
  return {{"shown", std::move(shown)},
          {"figures", Json::parse(figures_json(desk.curves))["figures"]}};
}

}  // namespace gnbv
