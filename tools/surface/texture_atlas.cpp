#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"
#include "tools/surface/textured_mesh.hpp"

// equal rectangles stay in their order on every system
#define STBRP_SORT(first, count, size, compare) \
  std::stable_sort(first, first + count,        \
                   [](const auto& a, const auto& b) { return compare(&a, &b) < 0; })
#define STBRP_STATIC
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb/stb_rect_pack.h>

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

/// The size of the chart in the atlas, scaled to that density.
stbrp_rect scaled(AtlasPatch& patch, double texels_per_m) {
  patch.chart.scale =
      static_cast<float>(std::min(1.0, texels_per_m / std::max(patch.pixels_per_m, 1e-6)));
  const Vec2f size = patch.chart.scale * patch.extent_px;
  return {.id = 0,
          .w = static_cast<int>(std::ceil(size.x())) + 1 + 2 * kGutter_px,
          .h = static_cast<int>(std::ceil(size.y())) + 1 + 2 * kGutter_px,
          .x = 0,
          .y = 0,
          .was_packed = 0};
}

/// The side of the narrowest sheet, a power of two or the widest that is allowed, in which they lie
/// side by side and that is no taller than wide. Nothing when there is none.
std::optional<int> pack(std::vector<stbrp_rect>& rectangles, int max_side) {
  std::int64_t area = 0;
  for (const stbrp_rect& r : rectangles) area += std::int64_t{r.w} * r.h;
  for (int side = std::min(64, max_side);; side = std::min(2 * side, max_side)) {
    if (area <= std::int64_t{side} * side) {
      std::vector<stbrp_node> skyline(static_cast<std::size_t>(side));  // fewer would be coarser
      stbrp_context context;
      stbrp_init_target(&context, side, side, skyline.data(), side);
      std::vector<stbrp_rect> placed = rectangles;
      if (stbrp_pack_rects(&context, placed.data(), static_cast<int>(placed.size())) != 0) {
        rectangles = std::move(placed);
        return side;
      }
    }
    if (side == max_side) return std::nullopt;
  }
}

/// Places the charts at the finest scale, down from the wanted one, at which they and the swatches
/// fit into the largest atlas.
void fit(std::vector<AtlasPatch>& patches, std::size_t swatches, int max_side_px,
         AtlasLayout& layout) {
  constexpr double kStep = 0.93;
  for (; layout.texels_per_m > 1e-3; layout.texels_per_m *= kStep) {
    std::vector<stbrp_rect> rectangles;
    for (AtlasPatch& patch : patches) rectangles.push_back(scaled(patch, layout.texels_per_m));
    const std::optional<int> width = pack(rectangles, max_side_px);
    if (!width) continue;
    layout.width = *width;
    layout.height = 0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const stbrp_rect& r = rectangles[i];
      Chart& chart = patches[i].chart;
      chart.x = r.x;
      chart.y = r.y;
      chart.width = r.w;
      chart.height = r.h;
      layout.height = std::max(layout.height, r.y + r.h);
    }
    if (layout.height + swatches_height_px(swatches, *width) <= max_side_px) return;
  }
  throw BadInput("--texture-px: {} charts and {} swatches do not fit into {} x {} px",
                 patches.size(), swatches, max_side_px, max_side_px);
}

constexpr std::uint8_t kEmpty = 128;  // grey

/// The mean of the picture over a texel.
Vec3f texel_colour(const Image& picture, const Chart& chart, int column, int row) {
  const Vec2f middle_px = chart.pixel_of(column, row);
  const int n = static_cast<int>(std::ceil(1.0F / chart.scale - 1e-4F));  // samples a side
  const float side_px = 1.0F / chart.scale;
  Vec3f sum = Vec3f::Zero();
  for (int i = 0; i < n * n; ++i) {
    const Vec2f part((static_cast<float>(i % n) + 0.5F) / static_cast<float>(n) - 0.5F,
                     (static_cast<float>(i / n) + 0.5F) / static_cast<float>(n) - 0.5F);
    sum += bilinear(picture, middle_px + side_px * part);
  }
  return sum / static_cast<float>(n * n);
}

void fill(const Image& picture, const Chart& chart, Image& atlas) {
  for (int row = 0; row < chart.height; ++row) {
    for (int column = 0; column < chart.width; ++column) {
      const Vec3f colour = texel_colour(picture, chart, column, row);
      const std::size_t i =
          3 * (static_cast<std::size_t>(chart.y + row) * static_cast<std::size_t>(atlas.width_px) +
               static_cast<std::size_t>(chart.x + column));
      for (std::size_t k = 0; k < 3; ++k) {
        atlas.rgb[i + k] =
            static_cast<std::uint8_t>(std::lround(colour[static_cast<Eigen::Index>(k)]));
      }
    }
  }
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
  fit(patches, swatches, settings.max_side_px, layout);
  for (AtlasPatch& patch : patches) {
    Chart& chart = patch.chart;
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

Vec3f bilinear(const Image& image, const Vec2f& p_px) {
  const float x = std::clamp(p_px.x() - 0.5F, 0.0F, static_cast<float>(image.width_px - 1));
  const float y = std::clamp(p_px.y() - 0.5F, 0.0F, static_cast<float>(image.height_px - 1));
  const int x0 = std::min(static_cast<int>(x), std::max(image.width_px - 2, 0));
  const int y0 = std::min(static_cast<int>(y), std::max(image.height_px - 2, 0));
  const int x1 = std::min(x0 + 1, image.width_px - 1);
  const int y1 = std::min(y0 + 1, image.height_px - 1);
  const float fx = x - static_cast<float>(x0);
  const float fy = y - static_cast<float>(y0);
  const auto colour = [&](int u, int v) {
    const auto rgb = image.at(u, v);
    return Vec3f(rgb[0], rgb[1], rgb[2]);
  };
  return (1.0F - fy) * ((1.0F - fx) * colour(x0, y0) + fx * colour(x1, y0)) +
         fy * ((1.0F - fx) * colour(x0, y1) + fx * colour(x1, y1));
}

Image bake_atlas(const AtlasLayout& layout, const std::function<Image(std::uint32_t view)>& picture,
                 int threads) {
  Image atlas{layout.width, layout.height, {}};
  atlas.rgb.assign(
      3 * static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height), kEmpty);
  std::map<std::uint32_t, std::vector<const Chart*>> by_view;
  for (const Chart& chart : layout.charts) by_view[chart.view].push_back(&chart);
  std::vector<std::pair<std::uint32_t, std::vector<const Chart*>>> work(by_view.begin(),
                                                                        by_view.end());
  parallel_for(threads, work.size(), [&](std::size_t i) {
    const Image source = picture(work[i].first);
    for (const Chart* const chart : work[i].second) fill(source, *chart, atlas);
  });
  return atlas;
}

}  // namespace gnbv
