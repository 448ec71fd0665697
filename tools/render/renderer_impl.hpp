// What a renderer keeps on the side of GL. For render.cpp and render_setup.cpp only.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tools/render/changed_area.hpp"
#include "tools/render/gl_context.hpp"
#include "tools/render/scene.hpp"

namespace gnbv {

using PixelBox = Eigen::AlignedBox2i;  // with both its corners

/// Texture units, in the order of GlContext::make_program(); the last one is only drawn to.
enum RenderUnit : std::size_t {
  kShadow,
  kPicture,
  kDepths,
  kDistances,
  kShade,
  kPaint,  // never drawn to
  kFinal,
  kRenderUnits
};

struct TextureFormat {
  GLenum internal, format, type;
};
constexpr TextureFormat kSrgb = {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE};
constexpr TextureFormat kRgb = {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
constexpr TextureFormat kFloat = {GL_R32F, GL_RED, GL_FLOAT};
constexpr TextureFormat kByte = {GL_R8, GL_RED, GL_UNSIGNED_BYTE};
constexpr TextureFormat kDepth = {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT};

/// The last picture of a series.
struct RememberedPicture {
  FrameBlock frame;
  DrawLists lists;
};

using Indices = std::vector<std::uint32_t>;

/// What reaches into the part of a picture that is drawn; triangles in their order in the buffer,
/// behind those that throw shadows.
struct ThingsToDraw {
  std::size_t first = 0;
  std::size_t opaque = 0, ghost = 0, translucent = 0;  // indices
  std::vector<DrawDot> dots;
};

struct Renderer::Impl {
  GlContext context;
  const Gl& gl = context.gl;
  GLuint solid = 0, ball = 0, dot = 0, solid_shadow = 0, ball_shadow = 0, ground = 0,
         background = 0, distance = 0, hollow = 0, resolve = 0;
  GLuint solids = 0, balls = 0, dots = 0, nothing = 0;                            // vertex arrays
  GLuint vertices = 0, indices = 0, ball_data = 0, dot_data = 0, frame_data = 0;  // buffers
  std::array<GLuint, kRenderUnits> textures = {};
  std::array<GLuint, kRenderUnits> targets = {};  // framebuffers, by the texture they draw to
  std::array<std::array<int, 2>, kRenderUnits> sizes_px = {};
  std::optional<RememberedPicture> last;

  Impl();
  void make_arrays();
  void make_texture(RenderUnit unit, const TextureFormat& format, int width, int height);
  void begin_target(RenderUnit unit, const TextureFormat& format, int width, int height);
  void draw_only_in(const PixelBox& box);
  void upload(const DrawLists& lists, const Indices& all, const FrameBlock& frame);
  void upload_paint(const PaintItem& paint, const RenderView& view);
  void upload_dots(std::span<const DrawDot> dots_to_draw);
  void draw_solids(GLuint program, std::size_t first, std::size_t count);
  void draw_points(GLuint program, GLuint array, std::size_t count);
  void draw_screen(GLuint program);
  void draw_shadows(const DrawLists& lists, const FrameBlock& frame, const PixelBox& box);
  void draw_things(const RenderScene& scene, const RenderView& view, const DrawLists& lists,
                   const ThingsToDraw& seen);
  ChangedArea area_to_draw(const RenderScene& scene, const RenderView& view, const DrawLists& lists,
                           const FrameBlock& frame);
  Image read_picture(int width, int height);
  Image render(const RenderScene& scene, const RenderView& view);
};

}  // namespace gnbv
