#include "tools/paper/figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/figures/figure_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFiguresFolder = "figures";

/// The scenario that a figure is drawn of, if one of them was asked for.
std::string scenario_of(const FigureKind& kind, const PaperRequest& request) {
  for (const std::string_view scenario : kind.scenarios) {
    const auto& asked = request.scenarios;
    if (std::find(asked.begin(), asked.end(), scenario) != asked.end())
      return std::string(scenario);
  }
  return "";
}

}  // namespace

const std::vector<FigureKind>& figure_kinds() {
  static const std::vector<std::string_view> any = {"aircraft", "power_plant", "lab_model",
                                                    "lab_airplane"};
  static const std::vector<FigureKind> kinds = {
      {"2", any,
       "Ray tracing from a candidate view: rays run within the sensor's limits until they reach "
       "its "
       "range or an occupied voxel; occupied, free and unknown voxels are told apart.",
       "The first planned view of a mission: rays of its cameras through the map as it was "
       "believed then, grey where they cross free voxels, orange where unknown ones, to the first "
       "occupied one. Pins are the other candidates.",
       draw_rays_figure},
      {"4", any,
       "The profile and the flight around the workspace after one, three and all eight waypoints.",
       "The same three moments of our profile over the true structure as a ghost.",
       draw_profile_figure},
      {"5", any, "Grid samples around the vehicle at the scales 1, b and b², times the step L.",
       "All samples around the vehicle (black) before a mission's first planned view, before any "
       "is checked: balls are positions, lines directions; voxels are the map as it was believed "
       "then, coloured by height.",
       draw_scales_figure},
      {"6", any,
       "Low-density frontier voxels, the centroids of their clusters, the field of view of two "
       "cameras, and three layers of views around a cluster.",
       "A decision at frontiers half way through a mission: voxels of little density, centroids, "
       "the candidates "
       "around the nearest clusters, and the cameras of the chosen one.",
       draw_frontiers_figure},
      {"8",
       {"aircraft"},
       "Path and coverage of the aircraft by three utilities: Proposed, Isler, Bircher.",
       "First seed, in the order of the paper's figure: the path from its first view (dark) to its "
       "last (bright), and below it the true surface, covered or missed (red) in voxels of 0.05 m.",
       draw_paths_figure},
      {"9",
       {"aircraft"},
       "Points a voxel over the iterations, for the three utilities.",
       "Means over the seeds with their 95 % interval.",
       draw_densities_figure},
      {"10",
       {"power_plant"},
       "Path and coverage of the power plant by three utilities: Proposed, Isler, Bircher.",
       "First seed, in the order of the paper's figure: the path from its first view (dark) to its "
       "last (bright), and below it the true surface, covered or missed (red) in voxels of 0.05 m.",
       draw_paths_figure},
      {"11",
       {"power_plant"},
       "Density and total entropy over the iterations by Proposed on the power plant; iterations "
       "that chose among frontier views are shaded.",
       "The same of the first seed.",
       draw_entropy_figure},
      {"13",
       {"lab_model"},
       "The lab flight from the side and from above: flown path with the profile, planned path, "
       "and the map's voxels.",
       "The same of a simulated flight in a room drawn to size: profile grey, planned part in the "
       "colours of its order, voxels coloured by height.",
       draw_path_in_map_figure},
      {"14",
       {"lab_model"},
       "Density and total entropy over the iterations in the lab.",
       "The same of the first seed.",
       draw_entropy_figure},
      {"15",
       {"lab_model"},
       "The textured reconstruction of the lab model from the side and from above, with the places "
       "of the images as green dots; made by photogrammetry from real images.",
       "A surface of the measured cloud with the colours of the rendered images; green dots are "
       "the places of the images.",
       draw_reconstruction_figure},
      {"16",
       {"lab_airplane"},
       "The flight around the airplane model from above and from the front: flown path with the "
       "profile, planned path, and the map's voxels.",
       "The same of a simulated flight around an airplane drawn to size: profile grey, planned "
       "part in the colours of its order, voxels coloured by height.",
       draw_path_in_map_figure},
      {"17",
       {"lab_airplane"},
       "Density and total entropy over the iterations with the airplane model.",
       "The same of the first seed.",
       draw_entropy_figure},
      {"18",
       {"lab_airplane"},
       "The textured reconstruction of the airplane with the places of the images as green dots; "
       "made by photogrammetry from real images.",
       "A surface of the measured cloud with the colours of the rendered images; green dots are "
       "the places of the images.",
       draw_reconstruction_figure}};
  return kinds;
}

const std::vector<UndrawnFigure>& undrawn_figures() {
  static const std::vector<UndrawnFigure> undrawn = {
      {"1", "A flow chart of the method: tools/mission/mission.cpp is the same as a program."},
      {"3",
       "A sketch of the density by neighbours in 2D: the tests of the surface cloud check the "
       "rule by hand-counted points."},
      {"7",
       "A screenshot of the collision boxes along a flight: planner.validity.collision_radius_m "
       "keeps candidates away from voxels; Figures 2 and 6 show those it rejects."},
      {"12", "A photograph of the vehicle's hardware: ours is simulated."}};
  return undrawn;
}

FigureDesk::FigureDesk(const PaperMaterial& material, fs::path folder, int threads)
    : material_(material), folder_(std::move(folder)), threads_(threads) {}

FigureDesk::~FigureDesk() = default;

Renderer& FigureDesk::renderer() {
  if (!renderer_) renderer_ = std::make_unique<Renderer>();
  return *renderer_;
}

void FigureDesk::begin(const FigureKind& kind, const std::string& scenario) {
  figure_ = {.kind = &kind, .scenario = scenario};
  for (auto& [key, source] : sources_) source->forget();  // maps of many missions are large
}

const PaperMission& FigureDesk::mission(std::string_view utility) const {
  const auto missions = missions_of(material_, figure_.scenario, utility);
  if (missions.empty()) {
    throw BadInput(
        fmt::format("no mission of {} by {} came to its end", figure_.scenario, utility));
  }
  return *missions.front();
}

RunSource& FigureDesk::source(std::string_view utility) {
  const PaperMission& shown = mission(utility);
  auto& source = sources_[{figure_.scenario, std::string(utility)}];
  if (!source) {
    source = std::make_unique<RunSource>(shown.record.folder, threads_,
                                         [](double, const std::string&) {});
  }
  return *source;
}

std::string FigureDesk::file_of(const std::string& what, const char* ending) const {
  return fmt::format("{}/fig{:0>2}-{}{}", kFiguresFolder, figure_.kind->number, what, ending);
}

void FigureDesk::add(const std::string& what, const std::string& label, const Image& image) {
  figure_.files.push_back({file_of(what, ".png"), label});
  write_png(image, folder_ / figure_.files.back().path);
}

void FigureDesk::add(const std::string& what, const std::string& label, const Figure& figure) {
  const std::string file = file_of(what, ".svg");
  const FigureTarget target{&figure, folder_ / file};
  draw_to_files({&target, 1});
  figure_.files.push_back({file, label});
}

std::vector<DrawnFigure> draw_figures(
    const PaperMaterial& material, const fs::path& folder, int threads,
    const std::function<void(std::size_t, std::size_t, const std::string&)>& progress) {
  make_folder(folder / kFiguresFolder);
  FigureDesk desk(material, folder, threads);
  std::vector<const FigureKind*> asked;
  for (const FigureKind& kind : figure_kinds()) {
    if (!scenario_of(kind, material.request).empty()) asked.push_back(&kind);
  }
  std::vector<DrawnFigure> drawn;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    progress(i, asked.size(), fmt::format("Figure {}", asked[i]->number));
    desk.begin(*asked[i], scenario_of(*asked[i], material.request));
    try {
      asked[i]->draw(desk);
    } catch (const BadInput& error) {
      desk.miss(error.what());
    }
    drawn.push_back(desk.figure());
  }
  return drawn;
}

}  // namespace gnbv
