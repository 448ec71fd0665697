// The numbers that all shaders of a picture share; no GL here.
#pragma once

#include <Eigen/Core>

#include "tools/render/geometry.hpp"

namespace gnbv {

constexpr int kShadowSide_px = 2048;

/// The std140 block `Frame` of shaders.hpp, where each field's meaning stands.
struct FrameBlock {
  Eigen::Matrix4f clip_from_world, shadow_from_world;
  Eigen::Vector4f eye, to_light, to_fill, camera_right, camera_up, ground, grid, lens, hollow;
};
static_assert(sizeof(FrameBlock) == 4 * (2 * 16 + 9 * 4));

FrameBlock make_frame_block(const RenderScene& scene, const RenderView& view,
                            const DrawLists& lists);

}  // namespace gnbv
