// bake_atlas() of texture_atlas.hpp.
#include <algorithm>
#include <cmath>
#include <map>

#include "sim/core/parallel.hpp"
#include "tools/surface/texture_atlas.hpp"

namespace gnbv {
namespace {

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
