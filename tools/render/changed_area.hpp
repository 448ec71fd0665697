// Where a picture of a series differs from the one before it, of the same view; no GL here.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tools/render/geometry.hpp"

namespace gnbv {

using PixelBox = Eigen::AlignedBox2i;  // with both its corners; empty: no pixel

struct ChangedArea {
  PixelBox picture_px;  // in a picture of the final size, rows from the bottom
  PixelBox shadow_px;   // of the shadow map
};

/// Of what came or went between two lists, in their order, and of the shadows that it throws on
/// what is as low as `lowest_m` or higher; none when any of it reaches behind the camera.
std::optional<ChangedArea> changed_area(const DrawLists& before, const DrawLists& now,
                                        const FrameBlock& frame, float lowest_m, int width_px,
                                        int height_px);

/// The dots that may reach into the box of a picture of that size, and those whose shadows may
/// reach into that of the shadow map, in their order: no other is worth its light, which is
/// reckoned a dot.
std::vector<DrawDot> dots_in_picture(std::span<const DrawDot> dots, const FrameBlock& frame,
                                     const PixelBox& box_px, int width_px, int height_px);
std::vector<DrawDot> dots_in_shadow_map(std::span<const DrawDot> dots, const FrameBlock& frame,
                                        const PixelBox& box_px);

/// All of a picture of that size.
inline PixelBox whole_px(int width_px, int height_px) {
  return {Eigen::Vector2i(0, 0), Eigen::Vector2i(width_px - 1, height_px - 1)};
}

/// The box with so many pixels more on each side, but none outside the picture.
PixelBox widened(const PixelBox& box_px, int by_px, int width_px, int height_px);

}  // namespace gnbv
