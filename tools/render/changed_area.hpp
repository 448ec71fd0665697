// Where a picture differs from the one before it, of the same view; no GL here.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tools/render/frame_block.hpp"

namespace gnbv {

/// What was drawn, as far as it takes to tell what is new: a hash of each triangle, ball and dot,
/// with the box around it, sorted by hash.
struct DrawnThing {
  std::uint64_t hash = 0;
  Eigen::AlignedBox3f box_m;
  bool casts_shadow = false;
};
std::vector<DrawnThing> drawn_things(const DrawLists& lists);

/// Pixels, each box with both its corners; empty where nothing changed.
struct ChangedArea {
  Eigen::AlignedBox2i picture_px;  // in a picture of the final size, rows from the bottom
  Eigen::AlignedBox2i shadow_px;   // of the shadow map
};

/// Of things that came or went, and of the shadows that they throw on what is as low as `lowest_m`
/// or higher; none when one of them reaches behind the camera.
std::optional<ChangedArea> changed_area(const std::vector<DrawnThing>& before,
                                        const std::vector<DrawnThing>& now, const FrameBlock& frame,
                                        float lowest_m, int width_px, int height_px);

/// The box with so many pixels more on each side, but none outside the picture.
Eigen::AlignedBox2i widened(const Eigen::AlignedBox2i& box_px, int by_px, int width_px,
                            int height_px);

}  // namespace gnbv
