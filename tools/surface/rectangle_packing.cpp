#include "tools/surface/rectangle_packing.hpp"

#include <algorithm>
#include <cstdint>

// equal rectangles stay in their order on every system
#define STBRP_SORT(first, count, size, compare) \
  std::stable_sort(first, first + count,        \
                   [](const auto& a, const auto& b) { return compare(&a, &b) < 0; })
#define STBRP_STATIC
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb/stb_rect_pack.h>

namespace gnbv {
namespace {

std::optional<Packing> in_sheet(std::vector<stbrp_rect> rectangles, int side) {
  std::vector<stbrp_node> skyline(static_cast<std::size_t>(side));  // fewer would be coarser
  stbrp_context context;
  stbrp_init_target(&context, side, side, skyline.data(), side);
  const auto count = static_cast<int>(rectangles.size());
  if (stbrp_pack_rects(&context, rectangles.data(), count) == 0) return std::nullopt;
  Packing packing{.width = side, .height = 0, .corners = {}};
  packing.corners.reserve(rectangles.size());
  for (const stbrp_rect& r : rectangles) {
    packing.corners.push_back({r.x, r.y});
    packing.height = std::max(packing.height, r.y + r.h);
  }
  return packing;
}

}  // namespace

std::optional<Packing> packed(std::span<const RectangleSize> sizes, int max_side) {
  std::vector<stbrp_rect> rectangles;
  rectangles.reserve(sizes.size());
  std::int64_t area = 0;
  for (const RectangleSize& size : sizes) {
    rectangles.push_back(
        {.id = 0, .w = size.width, .h = size.height, .x = 0, .y = 0, .was_packed = 0});
    area += std::int64_t{size.width} * size.height;
  }
  for (int side = std::min(64, max_side);; side = std::min(2 * side, max_side)) {
    if (area <= std::int64_t{side} * side) {
      if (auto packing = in_sheet(rectangles, side)) return packing;
    }
    if (side == max_side) return std::nullopt;
  }
}

}  // namespace gnbv
