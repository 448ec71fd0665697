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

/// In the narrowest sheet that is no taller than wide. None overlaps another. Nothing when they do
/// not fit into a sheet of `max_side`. Deterministic.
std::optional<Packing> packed(std::span<const RectangleSize> sizes, int max_side);

}  // namespace gnbv
