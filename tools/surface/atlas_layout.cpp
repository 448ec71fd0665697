// lay_out_atlas() of texture_atlas.hpp.
#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "tools/surface/mesh_edges.hpp"
#include "tools/surface/rectangle_packing.hpp"
#include "tools/surface/texture_atlas.hpp"

namespace gnbv {
namespace {

/// A chart before its scale is chosen.
struct AtlasPatch {
  Chart chart;
  Vec2f extent_px = Vec2f::Zero();  // in the picture
  double pixels_per_m = 0.0;        // of the picture, over the whole patch
};

/// Faces that hang together by edges and share a view, by their lowest face.
std::vector<Chart> connected_charts(const TriangleMesh& mesh,
                                    std::span<const std::int32_t> chosen) {
  const auto neighbours = neighbours_across_edges(mesh);
  std::vector<std::uint8_t> is_taken(mesh.faces.size());
  std::vector<Chart> charts;
  for (std::uint32_t first = 0; first < mesh.faces.size(); ++first) {
    if (is_taken[first] != 0 || chosen[first] == kNoView) continue;
    Chart& chart = charts.emplace_back();
    chart.view = static_cast<std::uint32_t>(chosen[first]);
    chart.faces.push_back(first);
    is_taken[first] = 1;
    for (std::size_t next = 0; next < chart.faces.size(); ++next) {
      for (const std::uint32_t other : neighbours[chart.faces[next]]) {
        if (other == kNoNeighbour || is_taken[other] != 0) continue;
        if (chosen[other] != chosen[first]) continue;
        is_taken[other] = 1;
        chart.faces.push_back(other);
      }
    }
  }
  return charts;
}

AtlasPatch patch_of(const TriangleMesh& mesh, const TextureView& view, Chart chart) {
  Eigen::AlignedBox2f box;
  double picture_px2 = 0.0;
  double surface_m2 = 0.0;
  for (const std::uint32_t face : chart.faces) {
    std::array<Vec3f, 3> p_m;
    std::array<Vec2f, 3> p_px;
    for (std::size_t k = 0; k < 3; ++k) {
      p_m[k] = mesh.vertices_m[mesh.faces[face][k]];
      p_px[k] = view.pixel_of(p_m[k]);
      box.extend(p_px[k]);
    }
    const Vec2f u = p_px[1] - p_px[0];
    const Vec2f v = p_px[2] - p_px[0];
    picture_px2 += 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
    surface_m2 += 0.5 * (p_m[1] - p_m[0]).cross(p_m[2] - p_m[0]).norm();
  }
  chart.origin_px = box.min();
  return {.chart = std::move(chart),
          .extent_px = box.sizes(),
          .pixels_per_m = std::sqrt(picture_px2 / std::max(surface_m2, 1e-12))};
}

/// Scales the chart to that density and gives it its size in the atlas.
void scale(AtlasPatch& patch, double texels_per_m) {
  Chart& chart = patch.chart;
  chart.scale =
      static_cast<float>(std::min(1.0, texels_per_m / std::max(patch.pixels_per_m, 1e-6)));
  const Vec2f size = chart.scale * patch.extent_px;
  chart.width = static_cast<int>(std::ceil(size.x())) + 1 + 2 * kGutter_px;
  chart.height = static_cast<int>(std::ceil(size.y())) + 1 + 2 * kGutter_px;
}

/// The finest scale, down from the wanted one, at which all patches and swatches fit into the
/// largest atlas.
Packing fit(std::vector<AtlasPatch>& patches, std::size_t swatches, double& texels_per_m,
            int max_side_px) {
  constexpr double kStep = 0.93;
  for (; texels_per_m > 1e-3; texels_per_m *= kStep) {
    std::vector<RectangleSize> sizes;
    sizes.reserve(patches.size());
    for (AtlasPatch& patch : patches) {
      scale(patch, texels_per_m);
      sizes.push_back({patch.chart.width, patch.chart.height});
    }
    std::optional<Packing> packing = packed(sizes, max_side_px);
    if (!packing) continue;
    const int height = packing->height + swatches_height_px(swatches, packing->width);
    if (height <= max_side_px) return *std::move(packing);
  }
  throw BadInput(fmt::format("--texture-px: {} charts and {} swatches do not fit into {} x {} px",
                             patches.size(), swatches, max_side_px, max_side_px));
}

}  // namespace

int swatches_height_px(std::size_t faces_without_view, int atlas_width_px) {
  const auto in_row = static_cast<std::size_t>(atlas_width_px / 2);
  return 2 * static_cast<int>((faces_without_view + in_row - 1) / in_row);
}

Vec2f Chart::texel_of(const Vec2f& p_px) const {
  const Vec2f corner(static_cast<float>(x + kGutter_px), static_cast<float>(y + kGutter_px));
  return corner + scale * (p_px - origin_px);
}

Vec2f Chart::pixel_of(int column, int row) const {
  const Vec2f middle(static_cast<float>(column - kGutter_px) + 0.5F,
                     static_cast<float>(row - kGutter_px) + 0.5F);
  return origin_px + middle / scale;
}

AtlasLayout lay_out_atlas(const TriangleMesh& mesh, std::span<const std::int32_t> chosen,
                          std::span<const TextureView> views, const AtlasSettings& settings) {
  GNBV_CHECK(chosen.size() == mesh.faces.size(), "{} choices, {} faces", chosen.size(),
             mesh.faces.size());
  std::vector<AtlasPatch> patches;
  for (Chart& chart : connected_charts(mesh, chosen)) {
    const TextureView& view = views[chart.view];
    patches.push_back(patch_of(mesh, view, std::move(chart)));
  }
  AtlasLayout layout{.texels_per_m = settings.texels_per_m};
  layout.face_uv.assign(mesh.faces.size(), FaceUv{Vec2f(-1, -1), Vec2f(-1, -1), Vec2f(-1, -1)});
  if (patches.empty()) return layout;
  const auto swatches = static_cast<std::size_t>(std::count(chosen.begin(), chosen.end(), kNoView));
  const Packing packing = fit(patches, swatches, layout.texels_per_m, settings.max_side_px);
  layout.width = packing.width;
  layout.height = packing.height;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    Chart& chart = patches[i].chart;
    chart.x = packing.corners[i].x;
    chart.y = packing.corners[i].y;
    for (const std::uint32_t face : chart.faces) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3f& p_m = mesh.vertices_m[mesh.faces[face][k]];
        layout.face_uv[face][k] = chart.texel_of(views[chart.view].pixel_of(p_m));
      }
    }
    layout.charts.push_back(std::move(chart));
  }
  return layout;
}

}  // namespace gnbv
