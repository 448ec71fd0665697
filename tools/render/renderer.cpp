#include "tools/render/renderer.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/core/module.hpp"
#include "tools/render/geometry.hpp"
#include "tools/render/gl_context.hpp"
#include "tools/render/shaders.hpp"

namespace gnbv {
namespace {

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

// Of the widest format, twice, and room for what is compiled and binned while it is drawn to.
std::size_t texture_bytes(int width, int height) {
  constexpr std::size_t kWidest_bytes = 16;
  constexpr std::size_t kRoom_bytes = 64U << 20U;
  return 2 * kWidest_bytes * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) +
         kRoom_bytes;
}

// kHollowFragment looks no farther than this share of the height, kResolveFragment two pixels.
int hollow_reach_px(int height) { return height * 12 / 100 + 2; }

// Rows from the bottom as rows from the top.
PixelBox upside_down(PixelBox box, int height) {
  if (box.isEmpty()) return box;
  const int low = box.min().y();
  box.min().y() = height - 1 - box.max().y();
  box.max().y() = height - 1 - low;
  return box;
}

}  // namespace

/// What a renderer keeps on the side of GL.
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
  std::optional<std::pair<FrameBlock, DrawLists>> last;  // picture of a series

  Impl() {
    using namespace shaders;
    solid = context.make_program({kSolidVertex}, {kLighting, kSolidFragment});
    ball = context.make_program({kBallVertex}, {kLighting, kBallFragment});
    dot = context.make_program({kLighting, kDotVertex}, {kDotFragment});
    solid_shadow = context.make_program({kSolidShadowVertex}, {kSolidShadowFragment});
    ball_shadow = context.make_program({kBallShadowVertex}, {kBallShadowFragment});
    ground = context.make_program({kGroundVertex}, {kLighting, kGroundFragment});
    background = context.make_program({kScreenVertex}, {kBackgroundFragment});
    distance = context.make_program({kScreenVertex}, {kDistanceFragment});
    hollow = context.make_program({kScreenVertex}, {kHollowFragment});
    resolve = context.make_program({kScreenVertex}, {kResolveFragment});
    make_arrays();
    gl.GenTextures(kRenderUnits, textures.data());
    gl.GenFramebuffers(kRenderUnits, targets.data());
    begin_target(kShadow, kDepth, kShadowSide_px, kShadowSide_px);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  }

  void make_arrays() {
    for (GLuint* array : {&solids, &balls, &dots, &nothing}) gl.GenVertexArrays(1, array);
    for (GLuint* buffer : {&vertices, &indices, &ball_data, &dot_data, &frame_data}) {
      gl.GenBuffers(1, buffer);
    }
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_data);
    const auto attribute = [&](GLuint index, int count, std::size_t stride, std::size_t offset) {
      gl.EnableVertexAttribArray(index);
      gl.VertexAttribPointer(index, count, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                             reinterpret_cast<const void*>(offset));
    };
    gl.BindVertexArray(solids);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    attribute(0, 3, sizeof(DrawVertex), offsetof(DrawVertex, p_world_m));
    attribute(1, 3, sizeof(DrawVertex), offsetof(DrawVertex, n_world));
    attribute(2, 4, sizeof(DrawVertex), offsetof(DrawVertex, rgba));
    gl.BindVertexArray(balls);
    gl.BindBuffer(GL_ARRAY_BUFFER, ball_data);
    attribute(0, 4, sizeof(DrawBall), offsetof(DrawBall, p_world_m));
    attribute(1, 3, sizeof(DrawBall), offsetof(DrawBall, rgb));
    gl.BindVertexArray(dots);
    gl.BindBuffer(GL_ARRAY_BUFFER, dot_data);
    attribute(0, 4, sizeof(DrawDot), offsetof(DrawDot, p_world_m));
    attribute(1, 3, sizeof(DrawDot), offsetof(DrawDot, n_world));
    attribute(2, 3, sizeof(DrawDot), offsetof(DrawDot, rgb));
  }

  // Leaves the texture bound to its unit; one that has its size keeps what was drawn to it.
  void make_texture(RenderUnit unit, const TextureFormat& format, int width, int height) {
    if (sizes_px[unit] == std::array{width, height}) return;
    need_address_space(texture_bytes(width, height));
    sizes_px[unit] = {width, height};
    gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl.BindTexture(GL_TEXTURE_2D, textures[unit]);
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal), width, height, 0,
                  format.format, format.type, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }

  // What is drawn next goes to that unit's texture; the picture comes with its depths.
  void begin_target(RenderUnit unit, const TextureFormat& format, int width, int height) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, targets[unit]);
    const auto attach = [&](GLenum point, RenderUnit to) {
      gl.FramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, textures[to], 0);
    };
    make_texture(unit, format, width, height);
    if (unit == kShadow) {
      attach(GL_DEPTH_ATTACHMENT, unit);
      gl.DrawBuffer(GL_NONE);
      gl.ReadBuffer(GL_NONE);
    } else {
      attach(GL_COLOR_ATTACHMENT0, unit);
    }
    if (unit == kPicture) {
      make_texture(kDepths, kDepth, width, height);
      attach(GL_DEPTH_ATTACHMENT, kDepths);
    }
    GNBV_CHECK(gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE,
               "framebuffer of {} x {} px", width, height);
    gl.Viewport(0, 0, width, height);
  }

  void draw_only_in(const PixelBox& box) {
    gl.Enable(GL_SCISSOR_TEST);
    if (box.isEmpty()) return gl.Scissor(0, 0, 0, 0);
    gl.Scissor(box.min().x(), box.min().y(), box.sizes().x() + 1, box.sizes().y() + 1);
  }

  template <typename Items>
  void fill(GLenum target, GLuint buffer, const Items& items) {
    const auto bytes = std::as_bytes(std::span(items));
    gl.BindBuffer(target, buffer);
    gl.BufferData(target, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STREAM_DRAW);
  }

  void upload(const DrawLists& lists, const FrameBlock& frame) {
    std::vector<std::uint32_t> all;
    for (const auto* const list :
         {&lists.casting, &lists.plain, &lists.ghost, &lists.translucent}) {
      all.insert(all.end(), list->begin(), list->end());
    }
    gl.BindVertexArray(solids);  // the index buffer belongs to it
    fill(GL_ARRAY_BUFFER, vertices, lists.vertices);
    fill(GL_ELEMENT_ARRAY_BUFFER, indices, all);
    fill(GL_ARRAY_BUFFER, ball_data, lists.balls);
    fill(GL_UNIFORM_BUFFER, frame_data, std::array{frame});
  }

  void upload_paint(const PaintItem& paint, const RenderView& view) {
    GNBV_CHECK(paint.width_px == 2 * view.width_px && paint.height_px == 2 * view.height_px,
               "paint of {} x {} px on a picture of {} x {}", paint.width_px, paint.height_px,
               view.width_px, view.height_px);
    make_texture(kPaint, kSrgb, paint.width_px, paint.height_px);
    gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(kPaint));
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(kSrgb.internal), paint.width_px,
                  paint.height_px, 0, kSrgb.format, kSrgb.type, paint.rgba.data());
  }

  // `first` and `count` are in indices.
  void draw_solids(GLuint program, std::size_t first, std::size_t count) {
    gl.UseProgram(program);
    gl.BindVertexArray(solids);
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
  }

  void draw_arrays(GLuint program, GLuint array, GLenum shape, std::size_t count) {
    gl.UseProgram(program);
    gl.BindVertexArray(array);
    gl.DrawArrays(shape, 0, static_cast<GLsizei>(count));
  }
  void draw_points(GLuint program, GLuint array, std::size_t count) {
    draw_arrays(program, array, GL_POINTS, count);
  }
  void draw_screen(GLuint program) { draw_arrays(program, nothing, GL_TRIANGLES, 3); }

  // What the key light sees.
  void draw_shadows(const DrawLists& lists, const FrameBlock& frame, const PixelBox& box) {
    const std::vector<DrawDot> casting = dots_in_shadow_map(lists.dots, frame, box);
    fill(GL_ARRAY_BUFFER, dot_data, casting);
    gl.BindFramebuffer(GL_FRAMEBUFFER, targets[kShadow]);
    gl.Viewport(0, 0, kShadowSide_px, kShadowSide_px);
    draw_only_in(box);
    gl.Enable(GL_DEPTH_TEST);
    gl.Enable(GL_PROGRAM_POINT_SIZE);
    gl.DepthMask(GL_TRUE);
    gl.DepthFunc(GL_LESS);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    draw_solids(solid_shadow, 0, lists.casting.size());
    draw_points(ball_shadow, balls, lists.casting_balls);
    draw_points(ball_shadow, dots, casting.size());
  }

  // The picture: solids and clouds, then ground, ghosts and translucent faces over them.
  void draw_things(const RenderScene& scene, const RenderView& view, const DrawLists& lists,
                   std::size_t dot_count) {
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    gl.DepthMask(GL_FALSE);
    gl.Disable(GL_DEPTH_TEST);
    draw_screen(background);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthMask(GL_TRUE);
    const std::size_t ghosts = lists.casting.size() + lists.plain.size();
    draw_solids(solid, 0, ghosts);
    draw_points(ball, balls, lists.balls.size());
    draw_points(dot, dots, dot_count);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl.DepthMask(GL_FALSE);
    if (scene.ground && view.T_world_camera.translation().z() > scene.ground->z_m) {
      draw_arrays(ground, nothing, GL_TRIANGLE_STRIP, 4);
    }
    // the nearest layer of the ghosts: first where it is, then how it looks
    // ghosts lie a little farther away, so that dots on them show whole
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(4.0F, 4.0F);
    gl.DepthMask(GL_TRUE);
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_solids(solid, ghosts, lists.ghost.size());
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthFunc(GL_LEQUAL);
    draw_solids(solid, ghosts, lists.ghost.size());
    gl.Disable(GL_POLYGON_OFFSET_FILL);
    gl.DepthMask(GL_FALSE);
    draw_solids(solid, ghosts + lists.ghost.size(), lists.translucent.size());
    gl.Disable(GL_BLEND);
    gl.Disable(GL_FRAMEBUFFER_SRGB);
    gl.Disable(GL_DEPTH_TEST);
  }

  // All of it, or of a series what differs from the picture before; remembers this one.
  ChangedArea area_to_draw(const RenderScene& scene, const RenderView& view, const DrawLists& lists,
                           const FrameBlock& frame) {
    const ChangedArea all{whole_px(view.width_px, view.height_px),
                          whole_px(kShadowSide_px, kShadowSide_px)};
    if (!scene.series_box_m) {
      last.reset();
      return all;
    }
    std::optional before{std::pair{frame, lists}};
    std::swap(before, last);
    const bool is_same_view = before && std::memcmp(&before->first, &frame, sizeof(frame)) == 0 &&
                              sizes_px[kFinal] == std::array{view.width_px, view.height_px};
    if (!is_same_view) return all;
    const auto lowest_m = static_cast<float>(scene.series_box_m->min().z());
    return changed_area(before->second, lists, frame, std::min(lowest_m, frame.ground.z()),
                        view.width_px, view.height_px)
        .value_or(all);
  }

  Image read_picture(int width, int height) {
    Image image{width, height, {}};
    image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
    const GLenum error = gl.GetError();
    if (error == GL_OUT_OF_MEMORY) {
      throw BadInput(
          "picture size {} x {} px: too little memory; ask for less with --width and --height",
          width, height);
    }
    GNBV_CHECK(error == GL_NO_ERROR, "OpenGL error {:#x} at {} x {} px", error, width, height);
    return image;
  }

  Image render(const RenderScene& scene, const RenderView& view) {
    const int width = view.width_px;
    const int height = view.height_px;
    if (std::min(width, height) < 1 || std::max(width, height) > kMaxSide_px) {
      throw BadInput("picture size {} x {} px: both must be from 1 to {}", width, height,
                     kMaxSide_px);
    }
    if (std::int64_t{width} * height > kMaxArea_px) {
      throw BadInput(
          "picture size {} x {} px: more than {} pixels; ask for less with --width and --height",
          width, height, kMaxArea_px);
    }
    context.make_current();
    const DrawLists lists = make_draw_lists(scene);
    const FrameBlock frame = make_frame_block(scene, view, lists);
    const auto [box, shadow_box] = area_to_draw(scene, view, lists, frame);
    const PixelBox hollow_box = widened(box, hollow_reach_px(height), width, height);
    const PixelBox end_box = widened(hollow_box, 2, width, height);
    upload(lists, frame);
    if (scene.paint) upload_paint(*scene.paint, view);
    draw_shadows(lists, frame, shadow_box);
    begin_target(kPicture, kSrgb, 2 * width, 2 * height);
    draw_only_in(box.isEmpty() ? box : PixelBox(2 * box.min(), (2 * box.max()).array() + 1));
    const std::vector<DrawDot> near = dots_in_picture(lists.dots, frame, box, width, height);
    fill(GL_ARRAY_BUFFER, dot_data, near);
    draw_things(scene, view, lists, near.size());
    begin_target(kDistances, kFloat, width, height);
    draw_only_in(box);
    draw_screen(distance);
    begin_target(kShade, kByte, width, height);
    draw_only_in(hollow_box);
    draw_screen(hollow);
    begin_target(kFinal, kRgb, width, height);
    draw_only_in(upside_down(end_box, height));
    draw_screen(resolve);
    return read_picture(width, height);
  }
};

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}
Renderer::~Renderer() = default;
Image Renderer::render(const RenderScene& scene, const RenderView& view) {
  return impl_->render(scene, view);
}

Image render(const RenderScene& scene, const RenderView& view) {
  Renderer renderer;
  return renderer.render(scene, view);
}

}  // namespace gnbv
