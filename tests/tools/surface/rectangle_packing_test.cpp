// Laws of packed rectangles.
#include "tools/surface/rectangle_packing.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

std::vector<RectangleSize> made_sizes(std::size_t count, int largest) {
  std::vector<RectangleSize> sizes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto side = [&](std::uint64_t axis) {
      return 1 + static_cast<int>(largest * uniform01({7, Stream::bench, i, axis}));
    };
    sizes.push_back({side(0), side(1)});
  }
  return sizes;
}

/// Share of the sheet that they fill, each texel once.
double filled_share(const std::vector<RectangleSize>& sizes, const Packing& packing) {
  const auto width = static_cast<std::size_t>(packing.width);
  std::vector<std::uint8_t> is_taken(width * static_cast<std::size_t>(packing.height));
  std::size_t taken = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const auto [x, y] = packing.corners[i];
    EXPECT_TRUE(x >= 0 && y >= 0 && x + sizes[i].width <= packing.width &&
                y + sizes[i].height <= packing.height)
        << i;
    for (int row = y; row < y + sizes[i].height; ++row) {
      for (int column = x; column < x + sizes[i].width; ++column) {
        const std::size_t at =
            static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
        if (is_taken.at(at)++ != 0) ADD_FAILURE() << i << " overlaps another";
        ++taken;
      }
    }
  }
  return static_cast<double>(taken) / static_cast<double>(is_taken.size());
}

TEST(Packing, RectanglesKeepApartAndLeaveLittle) {
  for (const auto& [count, largest, side] : {std::tuple{300UL, 50, 512}, {40'000UL, 60, 8192}}) {
    const std::vector<RectangleSize> sizes = made_sizes(count, largest);
    const std::optional<Packing> packing = packed(sizes, 8192);
    ASSERT_TRUE(packing.has_value());
    EXPECT_EQ(packing->width, side);
    EXPECT_LE(packing->height, packing->width);
    EXPECT_GT(filled_share(sizes, *packing), 0.95) << count;
    const Packing again = packed(sizes, 8192).value();
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(again.corners[i].x, packing->corners[i].x);
      EXPECT_EQ(again.corners[i].y, packing->corners[i].y);
    }
  }
}

TEST(Packing, TheSheetIsTheNarrowestOrThereIsNone) {
  EXPECT_EQ(packed(std::vector<RectangleSize>{{90, 90}}, 100).value().width, 100);
  EXPECT_EQ(packed(std::vector<RectangleSize>{{60, 60}, {4, 4}}, 100).value().width, 64);
  EXPECT_FALSE(packed(made_sizes(300, 50), 128).has_value());
  EXPECT_FALSE(packed(std::vector<RectangleSize>{{70, 1}}, 64).has_value());
  EXPECT_FALSE(packed(std::vector<RectangleSize>{{1, 70}}, 64).has_value());
}

}  // namespace
}  // namespace gnbv
