#include "tools/surface/rectangle_packing.hpp"

#include <algorithm>
#include <numeric>

namespace gnbv {
namespace {

/// All rectangles on shelves of a sheet of that width, in the given order, the tallest first.
Packing on_shelves(std::span<const RectangleSize> rectangles,
                   std::span<const std::size_t> tallest_first, int width) {
  Packing packing{.width = width, .height = 0, .corners = {}};
  packing.corners.resize(rectangles.size());
  int x = 0;
  int shelf_y = 0;
  for (const std::size_t i : tallest_first) {
    const RectangleSize& size = rectangles[i];
    if (x + size.width > width) {
      x = 0;
      shelf_y = packing.height;
    }
    packing.corners[i] = {x, shelf_y};
    packing.height = std::max(packing.height, shelf_y + size.height);
    x += size.width;
  }
  return packing;
}

}  // namespace

std::optional<Packing> packed(std::span<const RectangleSize> rectangles, int max_side) {
  std::vector<std::size_t> order(rectangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return rectangles[a].height > rectangles[b].height;
  });
  int widest = 1;
  for (const RectangleSize& size : rectangles) widest = std::max(widest, size.width);
  for (int width = std::min(64, max_side);; width = std::min(2 * width, max_side)) {
    if (width >= widest) {
      Packing packing = on_shelves(rectangles, order, width);
      if (packing.height <= width) return packing;
    }
    if (width == max_side) return std::nullopt;
  }
}

}  // namespace gnbv
