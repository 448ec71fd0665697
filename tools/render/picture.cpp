#include "tools/render/picture.hpp"

#include "sim/core/error.hpp"
#include "tools/render/paint.hpp"
#include "tools/run/words.hpp"

namespace gnbv {

const Rgb kGhostColour = srgb(0xc9d1da);

double unit_px(const PictureOptions& options) {
  return options.letters * layout_unit_px(options.width_px, options.height_px);
}

double layout_unit_m(const RenderView& view) {
  return layout_unit_px(view.width_px, view.height_px) / px_per_m_at_focus(view);
}

std::size_t iteration_of(const RunRecord& record, const PictureOptions& options,
                         std::size_t otherwise) {
  if (record.views.empty()) {
    throw BadInput(fmt::format("{}: took no view yet", record.folder.string()));
  }
  const std::size_t count = record.views.size();
  if (!options.iteration) return std::min(otherwise, count - 1);
  const auto iteration = static_cast<std::size_t>(*options.iteration);
  if (*options.iteration < 0 || iteration >= count) {
    throw BadInput(fmt::format("--iteration {}: {} has iterations 0 to {}", *options.iteration,
                               record.folder.string(), count - 1));
  }
  return iteration;
}

std::string views_so_far(const RunRecord& record, std::size_t iteration) {
  const std::size_t all = record.views.size();
  if (iteration + 1 == all) return counted(all, "view");
  return fmt::format("{} of {} (iteration {})", grouped(iteration + 1), counted(all, "view"),
                     iteration);
}

void frame_structure(RunSource& run, std::vector<Vec3>& points_world_m) {
  for (const Vec3f& v : run.world().structure.vertices_m) {
    points_world_m.push_back(v.cast<double>());
  }
}

namespace {

const Rgb kObstacleColour = srgb(0xb59a7a);
const Rgb kTerrainColour = srgb(0xa9b39a);
const Rgb kNoFlyColour = srgb(0xc8375d);

void add_in_one_colour(const TriangleMesh& mesh, const Rgb& colour, float opacity,
                       RenderScene& scene) {
  if (mesh.faces.empty()) return;
  SurfaceItem surface;
  surface.mesh = mesh;
  surface.vertex_colours.assign(mesh.vertices_m.size(), colour);
  surface.opacity = opacity;
  scene.surfaces.push_back(std::move(surface));
}

}  // namespace

void add_ground(RunSource& run, RenderScene& scene) {
  if (has_flat_ground(run.record().scenario)) scene.ground = GroundItem{};
  if (run.world().terrain.faces.empty()) return;
  add_in_one_colour(run.world().terrain, kTerrainColour, 1.0F, scene);
  scene.surfaces.back().casts_shadow = false;
}

std::vector<LegendItem> legend_of_surroundings(RunSource& run) {
  const Scenario& scenario = run.record().scenario;
  std::vector<LegendItem> legend;
  if (!scenario.obstacles.empty()) legend.push_back({"obstacle", {kObstacleColour}});
  if (!scenario.no_fly.empty()) legend.push_back({"no-fly box", {kNoFlyColour}});
  return legend;
}

void add_structure(RunSource& run, RenderScene& scene) {
  add_ground(run, scene);
  if (run.world().structure.faces.empty()) return;
  SurfaceItem surface;
  surface.mesh = run.world().structure;
  surface.is_painted = true;
  scene.surfaces.push_back(std::move(surface));
  add_surroundings(run, scene);
}

void add_surroundings(RunSource& run, RenderScene& scene) {
  add_in_one_colour(run.world().obstacles, kObstacleColour, 1.0F, scene);
  TriangleMesh boxes;
  for (const NoFlyConfig& keep_out : run.record().scenario.no_fly) {
    append(boxes, box_mesh(keep_out.box_m));
  }
  constexpr float kNoFlyOpacity = 0.3F;
  add_in_one_colour(boxes, kNoFlyColour, kNoFlyOpacity, scene);
}

void paint_structure(RunSource& run, const RenderView& view, RenderScene& scene) {
  const std::size_t faces = run.world().structure.faces.size();
  if (faces > 0) scene.paint = paint_of_structure(run.scene(), faces, view, run.threads());
}

void add_ghost(RunSource& run, float opacity, RenderScene& scene) {
  add_ground(run, scene);
  add_in_one_colour(run.world().structure, kGhostColour, opacity, scene);
  add_in_one_colour(run.world().obstacles, kObstacleColour, opacity, scene);
}

}  // namespace gnbv
