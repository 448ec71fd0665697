#include <algorithm>
#include <array>
#include <cstddef>

#include "sim/core/error.hpp"
#include "tools/render/frame_block.hpp"
#include "tools/render/geometry.hpp"
#include "tools/render/gl_context.hpp"
#include "tools/render/scene.hpp"
#include "tools/render/screen_shaders.hpp"
#include "tools/render/shaders.hpp"

namespace gnbv {
namespace {

// Texture units, in the order of GlContext::make_program(); the last one is only drawn to.
enum Unit : std::size_t { kShadow, kPicture, kDepths, kDistances, kShade, kFinal, kUnits };

struct Format {
  GLenum internal, format, type;
};
constexpr Format kSrgb = {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE};
constexpr Format kRgb = {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
constexpr Format kFloat = {GL_R32F, GL_RED, GL_FLOAT};
constexpr Format kByte = {GL_R8, GL_RED, GL_UNSIGNED_BYTE};
constexpr Format kDepth = {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT};

}  // namespace

struct Renderer::Impl {
  GlContext context;
  const Gl& gl = context.gl;
  GLuint solid = 0, ball = 0, dot = 0, solid_shadow = 0, ball_shadow = 0, ground = 0,
         background = 0, distance = 0, hollow = 0, resolve = 0;
  GLuint solids = 0, balls = 0, dots = 0, nothing = 0;                            // vertex arrays
  GLuint vertices = 0, indices = 0, ball_data = 0, dot_data = 0, frame_data = 0;  // buffers
  std::array<GLuint, kUnits> textures = {};
  std::array<GLuint, kUnits> targets = {};  // framebuffers, by the texture they draw to

  Impl();
  void make_arrays();
  void make_texture(Unit unit, const Format& format, int width, int height);
  void begin_target(Unit unit, const Format& format, int width, int height);
  void upload(const DrawLists& lists, const FrameBlock& frame);
  void draw_solids(GLuint program, std::size_t first, std::size_t count);
  void draw_points(GLuint program, GLuint array, std::size_t count);
  void draw_screen(GLuint program);
  void draw_shadows(const DrawLists& lists);
  void draw_things(const RenderScene& scene, const RenderView& view, const DrawLists& lists);
  Image render(const RenderScene& scene, const RenderView& view);
};

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
  gl.GenTextures(kUnits, textures.data());
  gl.GenFramebuffers(kUnits, targets.data());
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

// (Re)allocates the texture and leaves it bound to its unit.
void Renderer::Impl::make_texture(Unit unit, const Format& format, int width, int height) {
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
void Renderer::Impl::begin_target(Unit unit, const Format& format, int width, int height) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, targets[unit]);
  const auto attach = [&](GLenum point, Unit to) {
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

void Renderer::Impl::upload(const DrawLists& lists, const FrameBlock& frame) {
  const auto fill = [&](GLenum target, GLuint name, const void* data, std::size_t bytes) {
    gl.BindBuffer(target, name);
    gl.BufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
  };
  std::vector<std::uint32_t> all = lists.casting;
  for (const auto* more : {&lists.plain, &lists.ghost, &lists.translucent}) {
    all.insert(all.end(), more->begin(), more->end());
  }
  gl.BindVertexArray(solids);  // the index buffer belongs to it
  fill(GL_ARRAY_BUFFER, vertices, lists.vertices.data(),
       lists.vertices.size() * sizeof(DrawVertex));
  fill(GL_ELEMENT_ARRAY_BUFFER, indices, all.data(), all.size() * sizeof(std::uint32_t));
  fill(GL_ARRAY_BUFFER, ball_data, lists.balls.data(), lists.balls.size() * sizeof(DrawBall));
  fill(GL_ARRAY_BUFFER, dot_data, lists.dots.data(), lists.dots.size() * sizeof(DrawDot));
  fill(GL_UNIFORM_BUFFER, frame_data, &frame, sizeof(frame));
}

// `first` and `count` are in indices.
void Renderer::Impl::draw_solids(GLuint program, std::size_t first, std::size_t count) {
  gl.UseProgram(program);
  gl.BindVertexArray(solids);
  gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                  reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
}

void Renderer::Impl::draw_points(GLuint program, GLuint array, std::size_t count) {
  gl.UseProgram(program);
  gl.BindVertexArray(array);
  gl.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count));
}

void Renderer::Impl::draw_screen(GLuint program) {
  gl.UseProgram(program);
  gl.BindVertexArray(nothing);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

// What the key light sees.
void Renderer::Impl::draw_shadows(const DrawLists& lists) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, targets[kShadow]);
  gl.Viewport(0, 0, kShadowSide_px, kShadowSide_px);
  gl.Enable(GL_DEPTH_TEST);
  gl.Enable(GL_PROGRAM_POINT_SIZE);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LESS);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  draw_solids(solid_shadow, 0, lists.casting.size());
  draw_points(ball_shadow, balls, lists.casting_balls);
  draw_points(ball_shadow, dots, lists.casting_dots);
}

// The picture: solids and clouds, then ground, ghosts and translucent faces over them.
void Renderer::Impl::draw_things(const RenderScene& scene, const RenderView& view,
                                 const DrawLists& lists) {
  gl.Enable(GL_FRAMEBUFFER_SRGB);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  gl.DepthMask(GL_FALSE);
  gl.Disable(GL_DEPTH_TEST);
  draw_screen(background);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthMask(GL_TRUE);
  const std::size_t opaque = lists.casting.size() + lists.plain.size();
  draw_solids(solid, 0, opaque);
  draw_points(ball, balls, lists.balls.size());
  draw_points(dot, dots, lists.dots.size());
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.DepthMask(GL_FALSE);
  if (scene.ground && view.T_world_camera.translation().z() > scene.ground->z_m) {
    gl.UseProgram(ground);
    gl.BindVertexArray(nothing);
    gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  // the nearest layer of the ghosts: first where it is, then how it looks
  gl.DepthMask(GL_TRUE);
  gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_solids(solid, opaque, lists.ghost.size());
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.DepthFunc(GL_LEQUAL);
  draw_solids(solid, opaque, lists.ghost.size());
  gl.DepthMask(GL_FALSE);
  draw_solids(solid, opaque + lists.ghost.size(), lists.translucent.size());
  gl.Disable(GL_BLEND);
  gl.Disable(GL_FRAMEBUFFER_SRGB);
  gl.Disable(GL_DEPTH_TEST);
}

Image Renderer::Impl::render(const RenderScene& scene, const RenderView& view) {
  const int width = view.width_px;
  const int height = view.height_px;
  if (std::min(width, height) < 1 || std::max(width, height) > kMaxSide_px) {
    throw BadInput(fmt::format("picture size {} x {} px: both must be from 1 to {}", width, height,
                               kMaxSide_px));
  }
  if (std::int64_t{width} * height > kMaxArea_px) {
    throw BadInput(
        fmt::format("picture size {} x {} px: more than {} pixels; ask for less with "
                    "--width and --height",
                    width, height, kMaxArea_px));
  }
  context.make_current();
  const DrawLists lists = make_draw_lists(scene);
  upload(lists, make_frame_block(scene, view, lists));
  draw_shadows(lists);
  begin_target(kPicture, kSrgb, 2 * width, 2 * height);
  draw_things(scene, view, lists);
  begin_target(kDistances, kFloat, width, height);
  draw_screen(distance);
  begin_target(kShade, kByte, width, height);
  draw_screen(hollow);
  begin_target(kFinal, kRgb, width, height);
  draw_screen(resolve);
  Image image{width, height, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  const GLenum error = gl.GetError();
  if (error == GL_OUT_OF_MEMORY) {
    throw BadInput(
        fmt::format("picture size {} x {} px: too little memory; ask for less with --width and "
                    "--height",
                    width, height));
  }
  GNBV_CHECK(error == GL_NO_ERROR, "OpenGL error {:#x} at {} x {} px", error, width, height);
  return image;
}

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
