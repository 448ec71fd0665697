#include "tools/surface/surface_picture.hpp"

namespace gnbv {

Image surface_picture(const TexturedMesh& mesh, int width_px, int height_px,
                      const ViewAngles& angles) {
  SurfaceItem item{.mesh = mesh.shape, .vertex_colours = {}};
  for (const Rgb8& c : mesh.vertex_rgb) {
    item.vertex_colours.push_back(
        srgb((std::uint32_t{c[0]} << 16) | (std::uint32_t{c[1]} << 8) | c[2]));
  }
  RenderScene scene;
  scene.surfaces.push_back(std::move(item));
  scene.ground = GroundItem{};
  const RenderView view = frame_box(bounds_m(mesh.shape), angles, width_px, height_px);
  return render(scene, view);
}

}  // namespace gnbv
