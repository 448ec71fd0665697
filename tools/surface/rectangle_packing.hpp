// Rectangles side by side in as small a sheet as they need.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace gnbv {

struct RectangleSize {
  int width = 0;
  int height = 0;
};

struct Packing {
  int width = 0;  // of the sheet; a power of two, or the widest that is allowed
  int height = 0;
  struct Corner {
    int x = 0;
    int y = 0;
  };
  std::vector<Corner> corners;  // (rectangles) top left
};

/// Shelves of rectangles, the tallest first, in the narrowest sheet that is no taller than wide.
/// None overlaps another. Nothing when even a sheet of `max_side` is too small, or one rectangle is
/// wider. Deterministic.
std::optional<Packing> packed(std::span<const RectangleSize> rectangles, int max_side);

}  // namespace gnbv
