// Where a picture differs from the one before it, of the same view; no GL here.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tools/render/frame_block.hpp"

namespace gnbv {

/// A triangle, ball or dot, as far as it takes to tell where it shows.
struct DrawnThing {
  std::uint64_t hash = 0;
  Eigen::AlignedBox3f box_m;
  bool casts_shadow = false;
};
/// What one of the pictures has and the other has not.
std::vector<DrawnThing> changed_things(const DrawLists& before, const DrawLists& now);

/// Pixels, each box with both its corners; empty where nothing changed.
struct ChangedArea {
  Eigen::AlignedBox2i picture_px;  // in a picture of the final size, rows from the bottom
  Eigen::AlignedBox2i shadow_px;   // of the shadow map
};

/// Of things that came or went, and of the shadows that they throw on what is as low as `lowest_m`
/// or higher; none when one of them reaches behind the camera.
std::optional<ChangedArea> changed_area(const std::vector<DrawnThing>& changed,
                                        const FrameBlock& frame, float lowest_m, int width_px,
                                        int height_px);

/// The dots that may reach into the box of that picture, and those whose shadows may reach into
/// that of the shadow map, in their order: no other is worth its light, which is reckoned a dot.
std::vector<DrawDot> dots_in_picture(std::span<const DrawDot> dots, const FrameBlock& frame,
                                     const Eigen::AlignedBox2i& box_px, int width_px,
                                     int height_px);
std::vector<DrawDot> dots_in_shadow_map(std::span<const DrawDot> dots, const FrameBlock& frame,
                                        const Eigen::AlignedBox2i& box_px);

/// Where vertices land, in pixels of that picture; none behind the camera.
std::vector<std::optional<Eigen::Vector2f>> places_px(const std::vector<DrawVertex>& vertices,
                                                      const FrameBlock& frame, int width_px,
                                                      int height_px);
/// Those of the triangles that may reach into the box, in their order.
std::vector<std::uint32_t> triangles_in_picture(
    const std::vector<std::optional<Eigen::Vector2f>>& places_px,
    const std::vector<std::uint32_t>& indices, const Eigen::AlignedBox2i& box_px);

/// The box with so many pixels more on each side, but none outside the picture.
Eigen::AlignedBox2i widened(const Eigen::AlignedBox2i& box_px, int by_px, int width_px,
                            int height_px);

}  // namespace gnbv
