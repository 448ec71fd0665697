#include "tools/surface/surface_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/error.hpp"
#include "tools/render/caption.hpp"
#include "tools/run/words.hpp"

namespace gnbv {
namespace {

constexpr int kMostCuts = 64;  // of an edge
constexpr std::array<std::uint32_t, 6> kErrorTable = {0xdfe5ec, 0xf2e0a0, 0xf5b04e,
                                                      0xe2702c, 0xb5301f, 0x6d0a1c};

Rgb linear_of(const Vec3f& srgb_levels) {
  Rgb colour{};
  for (std::size_t k = 0; k < 3; ++k) {
    colour[k] = srgb_to_linear(srgb_levels[static_cast<Eigen::Index>(k)] / 255.0F);
  }
  return colour;
}

/// From pale, which is right, over yellow and orange to a dark red: errors stand out from shadows.
const std::vector<Rgb>& error_colours() {
  static const std::vector<Rgb> colours = linear_colours(kErrorTable);
  return colours;
}

/// What that share of the values stays under; 0 without any.
double quantile(std::span<const double> values, double share) {
  if (values.empty()) return 0.0;
  std::vector<double> sorted(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1));
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

RenderView framed(const TriangleMesh& mesh, int width_px, int height_px, const ViewAngles& angles) {
  std::vector<Vec3> points_m;  // its box would leave much of the picture empty
  points_m.reserve(mesh.vertices_m.size());
  for (const Vec3f& p_m : mesh.vertices_m) points_m.push_back(p_m.cast<double>());
  const double unit_px = layout_unit_px(width_px, height_px);
  FrameMargins margins = caption_margins(width_px, height_px, unit_px);
  const double below_title = 82.0 * unit_px / height_px;
  if (margins.bottom + below_title < 1.0) margins.top = std::max(margins.top, below_title);
  return frame_points(points_m, angles, width_px, height_px, margins);
}

Image drawn(SurfaceItem item, const RenderView& view, const Caption& caption,
            float shading = 1.0F) {
  RenderScene scene;
  scene.shading = shading;
  scene.surfaces.push_back(std::move(item));
  scene.ground = GroundItem{};
  Image image = render(scene, view);
  if (fits_caption(view.width_px, view.height_px)) draw_caption(image, caption, view);
  return image;
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

Image surface_picture(const TexturedMesh& mesh, const std::string& title, int width_px,
                      int height_px, const ViewAngles& angles) {
  const RenderView view = framed(mesh.shape, width_px, height_px, angles);
  constexpr double kPiece_px = 2.0;
  return drawn(
      textured_item(mesh, kPiece_px / px_per_m_at_focus(view)), view,
      {.title = title,
       .detail = fmt::format("reconstructed surface, {}", counted(mesh.shape.faces.size(), "face")),
       .legend = {}});
}

double error_range_m(std::span<const double> errors_m) {
  constexpr double kLeast_m = 0.001;
  const double most_m = std::max(kLeast_m, quantile(errors_m, 0.95));
  const double power_m = std::pow(10.0, std::floor(std::log10(most_m) + 1e-9));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (most_m <= (factor + 1e-9) * power_m) return factor * power_m;
  }
  return 10.0 * power_m;
}

Image error_picture(const TriangleMesh& mesh, std::span<const double> errors_m,
                    const std::string& title, int width_px, int height_px,
                    const ViewAngles& angles) {
  GNBV_CHECK(errors_m.size() == mesh.vertices_m.size(), "{} distances for {} vertices",
             errors_m.size(), mesh.vertices_m.size());
  SurfaceItem item{.mesh = mesh, .vertex_colours = {}};
  const double most_m = error_range_m(errors_m);
  for (const double error_m : errors_m) {
    item.vertex_colours.push_back(ramp(error_colours(), error_m / most_m));
  }
  return drawn(
      std::move(item), framed(mesh, width_px, height_px, angles),
      {.title = title,
       .detail = fmt::format("distance of the reconstructed surface to the true "
                             "structure: half of its corners within {:.2g} mm, 95 % "
                             "within {:.2g} mm; gaps have none",
                             1000.0 * quantile(errors_m, 0.5), 1000.0 * quantile(errors_m, 0.95)),
       .legend = {{.label = fmt::format("{:g} mm or more", 1000.0 * most_m),
                   .colours = error_colours(),
                   .label_before = "0",
                   .label_middle = fmt::format("{:g}", 500.0 * most_m)}}},
      kDataShading);
}

}  // namespace gnbv
