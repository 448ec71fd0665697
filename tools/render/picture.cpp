#include "tools/render/picture.hpp"

#include "sim/core/error.hpp"

namespace gnbv {

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
    throw BadInput(fmt::format("--iteration {}: {} took views 0 to {}", *options.iteration,
                               record.folder.string(), count - 1));
  }
  return iteration;
}

void frame_structure(RunSource& run, std::vector<Vec3>& points_world_m) {
  for (const Vec3f& v : run.world().structure.vertices_m) {
    points_world_m.push_back(v.cast<double>());
  }
}

void add_ground(RunSource& run, RenderScene& scene) {
  if (run.record().scenario.structure.ground) scene.ground = GroundItem{};
}

void add_structure(RunSource& run, RenderScene& scene) {
  add_ground(run, scene);
  if (run.world().structure.faces.empty()) return;
  SurfaceItem surface;
  surface.mesh = run.world().structure;
  scene.surfaces.push_back(std::move(surface));
}

void add_ghost(RunSource& run, float opacity, RenderScene& scene) {
  add_ground(run, scene);
  if (run.world().structure.faces.empty()) return;
  SurfaceItem surface;
  surface.mesh = run.world().structure;
  surface.vertex_colours.assign(surface.mesh.vertices_m.size(), srgb(0xc9d1da));
  surface.opacity = opacity;
  scene.surfaces.push_back(std::move(surface));
}

}  // namespace gnbv
