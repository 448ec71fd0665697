// A level sheet and pictures of it from above, for tests of surfaces.
#pragma once

#include <vector>

#include "sensors/ray_scene.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {

constexpr int kWidth_px = 160;
constexpr int kHeight_px = 120;

/// A camera at height z_m over (x_m, 0) that looks straight down.
inline TextureView view_from(float x_m, float z_m) {
  Isometry T_world_camera = Isometry::Identity();
  T_world_camera.translate(Vec3(x_m, 0, z_m));
  T_world_camera.rotate(Eigen::AngleAxisd(kPi, Vec3::UnitX()));  // optical axis down
  return {.T_camera_world = T_world_camera.inverse(),
          .p_world_m = Vec3f(x_m, 0, z_m),
          .camera = {.name = "c",
                     .width_px = kWidth_px,
                     .height_px = kHeight_px,
                     .fx_px = 130,
                     .fy_px = 140,
                     .cx_px = 80,
                     .cy_px = 60}};
}

/// A level sheet of 2 n^2 triangles around (x_m, 0), facing up.
inline void add_sheet(TriangleMesh& mesh, float x_m, float z_m, float side_m, int n) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const auto at = [&](int k) {
        return side_m * (static_cast<float>(k) / static_cast<float>(n) - 0.5F);
      };
      mesh.vertices_m.emplace_back(x_m + at(i), at(j), z_m);
    }
  }
  const auto row = static_cast<std::uint32_t>(n + 1);
  for (std::uint32_t i = 0; i + 1 < row; ++i) {
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const std::uint32_t a = first + i * row + j;
      mesh.faces.push_back({a, a + row, a + row + 1});
      mesh.faces.push_back({a, a + row + 1, a + 1});
    }
  }
}

inline TriangleMesh sheet(float side_m = 1.0F, int n = 20) {
  TriangleMesh mesh;
  add_sheet(mesh, 0.0F, 0.0F, side_m, n);
  return mesh;
}

/// Smooth and without two equal places: red grows to the right, green downwards.
inline Image gradient(std::uint8_t blue) {
  Image image{kWidth_px, kHeight_px, {}};
  for (int y = 0; y < kHeight_px; ++y) {
    for (int x = 0; x < kWidth_px; ++x) {
      image.rgb.push_back(static_cast<std::uint8_t>(x + 40));
      image.rgb.push_back(static_cast<std::uint8_t>(2 * y));
      image.rgb.push_back(blue);
    }
  }
  return image;
}

inline std::vector<std::int32_t> chosen_views(const TriangleMesh& mesh,
                                              const std::vector<TextureView>& views,
                                              int threads = 2) {
  const RayScene scene(World{.structure = mesh, .has_ground = false});
  return choose_views(mesh, scene, views, {}, threads);
}

inline TexturedMesh textured(int threads = 2) {
  TriangleMesh mesh = sheet();
  const std::vector<TextureView> views = {view_from(-0.9F, 2.0F)};
  const AtlasLayout layout = lay_out_atlas(mesh, chosen_views(mesh, views, threads), views, {});
  const Image baked = bake_atlas(
      layout, [](std::uint32_t) { return gradient(200); }, threads);
  return with_texture(std::move(mesh), layout, baked);
}

}  // namespace gnbv
