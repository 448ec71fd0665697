#include "tools/surface/surface_picture.hpp"

namespace gnbv {

SurfaceItem surface_item(const TexturedMesh& mesh) {
  SurfaceItem item{.mesh = mesh.shape, .vertex_colours = {}};
  for (const Rgb8& c : mesh.vertex_rgb) {
    item.vertex_colours.push_back(
        srgb((std::uint32_t{c[0]} << 16) | (std::uint32_t{c[1]} << 8) | c[2]));
  }
  return item;
}

Image surface_picture(const TexturedMesh& mesh, int width_px, int height_px,
                      const ViewAngles& angles) {
  RenderScene scene;
  scene.surfaces.push_back(surface_item(mesh));
  scene.ground = GroundItem{};
  std::vector<Vec3> points_m;  // its box would leave much of the picture empty
  points_m.reserve(mesh.shape.vertices_m.size());
  for (const Vec3f& p_m : mesh.shape.vertices_m) points_m.push_back(p_m.cast<double>());
  const RenderView view = frame_points(points_m, angles, width_px, height_px);
  return render(scene, view);
}

}  // namespace gnbv
