#include "tools/surface/surface_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/render/pictures.hpp"
#include "tools/scene/colour.hpp"

namespace gnbv {
namespace {

constexpr int kMostCuts = 64;  // of an edge

Rgb linear_of(const Vec3f& srgb_levels) {
  Rgb colour{};
  for (std::size_t k = 0; k < 3; ++k) {
    colour[k] = srgb_to_linear(srgb_levels[static_cast<Eigen::Index>(k)] / 255.0F);
  }
  return colour;
}

PictureOptions options_of(const std::string& title) {
  PictureOptions options;
  options.width_px = 1280;
  options.height_px = 720;
  options.title = title;
  return options;
}

PanelLayout layout_of(const TriangleMesh& mesh, int legend_rows, const PictureOptions& options) {
  std::vector<Vec3> points_m;  // its box would leave much of the picture empty
  points_m.reserve(mesh.vertices_m.size());
  for (const Vec3f& p_m : mesh.vertices_m) points_m.push_back(p_m.cast<double>());
  return lay_out(points_m, {.legend_rows = legend_rows}, options);
}

/// On a ground with a metre grid.
Image drawn(SurfaceItem item, Picture picture, const PanelLayout& layout,
            const PictureOptions& options, float shading) {
  RenderScene& scene = picture.panels.emplace_back().scene;
  scene.shading = shading;
  scene.surfaces.push_back(std::move(item));
  scene.ground = GroundItem{};
  Renderer renderer;
  return with_words(draw_without_words(picture, options.title, options, layout, renderer));
}

/// A face in n x n like ones, each corner with the colour of its place in the atlas.
void add_pieces(const TexturedMesh& mesh, std::size_t face, int n, SurfaceItem& item) {
  const auto first = static_cast<std::uint32_t>(item.mesh.vertices_m.size());
  const auto& corners = mesh.shape.faces[face];
  const FaceUv& uv = mesh.face_uv[face];
  // row by row: row i holds n + 1 - i corners
  for (int i = 0; i <= n; ++i) {
    for (int k = 0; k + i <= n; ++k) {
      const float b = static_cast<float>(k) / static_cast<float>(n);
      const float c = static_cast<float>(i) / static_cast<float>(n);
      const auto mixed = [&](const auto& p, const auto& q, const auto& r) {
        return ((1.0F - b - c) * p + b * q + c * r).eval();
      };
      item.mesh.vertices_m.push_back(mixed(mesh.shape.vertices_m[corners[0]],
                                           mesh.shape.vertices_m[corners[1]],
                                           mesh.shape.vertices_m[corners[2]]));
      item.vertex_colours.push_back(linear_of(bilinear(mesh.atlas, mixed(uv[0], uv[1], uv[2]))));
    }
  }
  std::uint32_t row = first;
  for (int i = 0; i < n; ++i) {
    const auto length = static_cast<std::uint32_t>(n + 1 - i);
    for (std::uint32_t k = 0; k + 1 < length; ++k) {
      item.mesh.faces.push_back({row + k, row + k + 1, row + length + k});
      if (k + 2 < length) {
        item.mesh.faces.push_back({row + k + 1, row + length + k + 1, row + length + k});
      }
    }
    row += length;
  }
}

}  // namespace

SurfaceItem surface_item(const TexturedMesh& mesh) {
  SurfaceItem item{.mesh = mesh.shape, .vertex_colours = {}};
  for (const Rgb8& c : mesh.vertex_rgb) {
    item.vertex_colours.push_back(
        linear_of({static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])}));
  }
  return item;
}

SurfaceItem textured_item(const TexturedMesh& mesh, double piece_m) {
  if (mesh.face_uv.empty()) return surface_item(mesh);
  SurfaceItem item;
  item.is_lit = false;
  item.crease_rad = 0.0;
  for (std::size_t face = 0; face < mesh.shape.faces.size(); ++face) {
    float longest_m = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f& a = mesh.shape.vertices_m[mesh.shape.faces[face][k]];
      const Vec3f& b = mesh.shape.vertices_m[mesh.shape.faces[face][(k + 1) % 3]];
      longest_m = std::max(longest_m, (b - a).norm());
    }
    const double cuts = std::ceil(static_cast<double>(longest_m) / std::max(piece_m, 1e-9));
    add_pieces(mesh, face, static_cast<int>(std::clamp(cuts, 1.0, 1.0 * kMostCuts)), item);
  }
  return item;
}

Image surface_picture(const TexturedMesh& mesh, const std::string& title) {
  const PictureOptions options = options_of(title);
  const PanelLayout layout = layout_of(mesh.shape, 0, options);
  constexpr double kPiece_px = 2.0;
  const std::string faces = counted(mesh.shape.faces.size(), "face");
  return drawn(textured_item(mesh, kPiece_px / px_per_m_at_focus(layout.view)),
               {.detail = "reconstructed surface, " + faces}, layout, options, 1.0F);
}

Image error_picture(const TriangleMesh& mesh, std::span<const double> errors_m,
                    const std::string& title) {
  GNBV_CHECK(errors_m.size() == mesh.vertices_m.size(), "{} distances for {} vertices",
             errors_m.size(), mesh.vertices_m.size());
  SurfaceItem item{.mesh = mesh};
  const ErrorScale scale = error_scale(errors_m);
  for (const double error_m : errors_m) {
    item.vertex_colours.push_back(ramp(error_colours(), error_m / scale.most_m));
  }
  const PictureOptions options = options_of(title);
  Picture picture{.detail = fmt::format("distance of the reconstructed surface to the true "
                                        "structure: half of its corners within {:.2g} mm, 95 % "
                                        "within {:.2g} mm; gaps have none",
                                        1000.0 * scale.median_m, 1000.0 * scale.within_m),
                  .legend = {{.label = fmt::format("{:g} mm or more", 1000.0 * scale.most_m),
                              .colours = error_colours(),
                              .label_before = "0",
                              .label_middle = fmt::format("{:g}", 500.0 * scale.most_m)}}};
  return drawn(std::move(item), std::move(picture), layout_of(mesh, 1, options), options,
               kDataShading);
}

}  // namespace gnbv
