// A scene as a renderer wants it: triangles ready to be drawn, and the numbers that all shaders of
// a picture share; no GL here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tools/scene/scene.hpp"

namespace gnbv {

/// Instead of an opacity: opaque, and coloured by the scene's paint.
constexpr float kPainted = 2.0F;

struct DrawVertex {
  Vec3f p_world_m;
  Vec3f n_world;
  std::array<float, 4> rgba;
};

struct DrawBall {
  Vec3f p_world_m;
  float radius_m;
  Rgb rgb;
};

struct DrawDot {
  Vec3f p_world_m;
  float radius_m;
  Vec3f n_world;  // zero: lit from everywhere
  Rgb rgb;
};

struct DrawLists {
  std::vector<DrawVertex> vertices;
  // triples of vertices: solids that cast shadows, solids that do not, ghosts, and what is drawn
  // last
  std::vector<std::uint32_t> casting, plain, ghost, translucent;
  std::vector<DrawBall> balls;  // those that cast shadows first
  std::size_t casting_balls = 0;
  std::vector<DrawDot> dots;
  Eigen::AlignedBox3f bounds_m;  // of all of it
};

/// Unit normal of each corner of each face: the mean, weighted by corner angle, over the faces
/// around the corner's position whose normals lie within the crease of this face's; zero for faces
/// without area. Corners at equal positions belong together even where the file has not welded
/// them.
std::vector<std::array<Vec3f, 3>> corner_normals(const TriangleMesh& mesh, double crease_rad);

DrawLists make_draw_lists(const RenderScene& scene);

constexpr int kShadowSide_px = 2048;

/// The std140 block `Frame` of shaders.hpp, where each field's meaning stands.
struct FrameBlock {
  Eigen::Matrix4f clip_from_world, shadow_from_world;
  Eigen::Vector4f eye, to_light, to_fill, camera_right, camera_up, ground, grid, lens, hollow;
};
static_assert(sizeof(FrameBlock) == 4 * (2 * 16 + 9 * 4));

FrameBlock make_frame_block(const RenderScene& scene, const RenderView& view,
                            const DrawLists& lists);

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
