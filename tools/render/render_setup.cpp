// Programs, arrays, textures and buffers of a renderer.
#include <cstddef>

#include "sim/core/error.hpp"
#include "sim/core/module.hpp"
#include "tools/render/renderer_impl.hpp"
#include "tools/render/screen_shaders.hpp"
#include "tools/render/shaders.hpp"

namespace gnbv {
namespace {

// Of the widest format, twice, and room for what is compiled and binned while it is drawn to.
std::size_t texture_bytes(int width, int height) {
  constexpr std::size_t kWidest_bytes = 16;
  constexpr std::size_t kRoom_bytes = 64U << 20U;
  return 2 * kWidest_bytes * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) +
         kRoom_bytes;
}

}  // namespace

Renderer::Impl::Impl() {
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

void Renderer::Impl::make_arrays() {
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
  attribute(0, 4, sizeof(DrawBall), offsetof(DrawBall, centre_m));
  attribute(1, 3, sizeof(DrawBall), offsetof(DrawBall, rgb));
  gl.BindVertexArray(dots);
  gl.BindBuffer(GL_ARRAY_BUFFER, dot_data);
  attribute(0, 4, sizeof(DrawDot), offsetof(DrawDot, p_world_m));
  attribute(1, 3, sizeof(DrawDot), offsetof(DrawDot, n_world));
  attribute(2, 3, sizeof(DrawDot), offsetof(DrawDot, rgb));
}

// Leaves the texture bound to its unit; one that has its size keeps what was drawn to it.
void Renderer::Impl::make_texture(RenderUnit unit, const TextureFormat& format, int width,
                                  int height) {
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
void Renderer::Impl::begin_target(RenderUnit unit, const TextureFormat& format, int width,
                                  int height) {
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

void Renderer::Impl::draw_only_in(const PixelBox& box) {
  gl.Enable(GL_SCISSOR_TEST);
  if (box.isEmpty()) return gl.Scissor(0, 0, 0, 0);
  gl.Scissor(box.min().x(), box.min().y(), box.sizes().x() + 1, box.sizes().y() + 1);
}

void Renderer::Impl::upload(const DrawLists& lists, const Indices& all, const FrameBlock& frame) {
  const auto fill = [&](GLenum target, GLuint name, const void* data, std::size_t bytes) {
    gl.BindBuffer(target, name);
    gl.BufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
  };
  gl.BindVertexArray(solids);  // the index buffer belongs to it
  fill(GL_ARRAY_BUFFER, vertices, lists.vertices.data(),
       lists.vertices.size() * sizeof(DrawVertex));
  fill(GL_ELEMENT_ARRAY_BUFFER, indices, all.data(), all.size() * sizeof(std::uint32_t));
  fill(GL_ARRAY_BUFFER, ball_data, lists.balls.data(), lists.balls.size() * sizeof(DrawBall));
  fill(GL_UNIFORM_BUFFER, frame_data, &frame, sizeof(frame));
}

void Renderer::Impl::upload_paint(const PaintItem& paint, const RenderView& view) {
  GNBV_CHECK(paint.width_px == 2 * view.width_px && paint.height_px == 2 * view.height_px,
             "paint of {} x {} px on a picture of {} x {}", paint.width_px, paint.height_px,
             view.width_px, view.height_px);
  make_texture(kPaint, kSrgb, paint.width_px, paint.height_px);
  gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(kPaint));
  gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(kSrgb.internal), paint.width_px,
                paint.height_px, 0, kSrgb.format, kSrgb.type, paint.rgba.data());
}

void Renderer::Impl::upload_dots(std::span<const DrawDot> dots_to_draw) {
  gl.BindBuffer(GL_ARRAY_BUFFER, dot_data);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(dots_to_draw.size_bytes()),
                dots_to_draw.data(), GL_STREAM_DRAW);
}

}  // namespace gnbv
