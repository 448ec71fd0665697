// The only file that knows OSMesa and GL. The library is opened at run time, so that programs which
// draw nothing do not pay for loading it (32 ms) nor need it installed.
#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>

#include "sim/core/error.hpp"
#include "tools/render/frame_block.hpp"
#include "tools/render/geometry.hpp"
#include "tools/render/scene.hpp"
#include "tools/render/shaders.hpp"

#ifdef __SANITIZE_ADDRESS__
// Mesa 22 never frees its record of a context's window: 160 bytes a context
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa.so"; }
#endif

namespace gnbv {
namespace {

// clang-format off
#define GNBV_OSMESA_FUNCTIONS(X) \
  X(CreateContextAttribs) X(DestroyContext) X(MakeCurrent) X(GetProcAddress)
#define GNBV_GL_FUNCTIONS(X)                                                                    \
  X(AttachShader) X(BindBuffer) X(BindBufferBase) X(BindFramebuffer) X(BindTexture)             \
  X(BindVertexArray) X(BlendFunc) X(BufferData) X(CheckFramebufferStatus) X(Clear)              \
  X(CompileShader) X(CreateProgram) X(CreateShader) X(DepthFunc) X(DepthMask) X(Disable)        \
  X(DrawArrays) X(DrawBuffer) X(DrawElements) X(Enable) X(EnableVertexAttribArray)              \
  X(FramebufferTexture2D) X(GenBuffers) X(GenFramebuffers) X(GenTextures) X(GenVertexArrays)    \
  X(GetError) X(GetProgramInfoLog) X(GetProgramiv) X(GetUniformBlockIndex) X(LinkProgram)       \
  X(PixelStorei) X(ReadBuffer) X(ReadPixels) X(ShaderSource) X(TexImage2D) X(TexParameteri)     \
  X(UniformBlockBinding) X(UseProgram) X(VertexAttribPointer) X(Viewport)
// clang-format on

struct OsMesa {
#define X(name) decltype(&::OSMesa##name) name = nullptr;
  GNBV_OSMESA_FUNCTIONS(X)
#undef X
};

struct Gl {
#define X(name) decltype(&::gl##name) name = nullptr;
  GNBV_GL_FUNCTIONS(X)
#undef X
};

// Never closed: Mesa's threads and LLVM outlive a context.
OsMesa open_osmesa() {
  void* library = nullptr;
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
    library = ::dlopen(name, RTLD_LAZY | RTLD_LOCAL);
    if (library != nullptr) break;
  }
  if (library == nullptr) {
    const char* reason = ::dlerror();
    throw BadInput(fmt::format("pictures need OSMesa, Debian package libosmesa6: {}",
                               reason == nullptr ? "cannot be loaded" : reason));
  }
  OsMesa mesa;
#define X(name)                                                                        \
  mesa.name = reinterpret_cast<decltype(mesa.name)>(::dlsym(library, "OSMesa" #name)); \
  if (mesa.name == nullptr) {                                                          \
    throw BadInput("libOSMesa lacks OSMesa" #name ": Mesa 11 or later is needed");     \
  }
  GNBV_OSMESA_FUNCTIONS(X)
#undef X
  return mesa;
}

}  // namespace

struct Renderer::Impl {
  OsMesa mesa = open_osmesa();
  OSMesaContext context = nullptr;
  std::array<std::uint8_t, 4 * 4 * 4> window{};  // OSMesa wants one; all drawing goes elsewhere
  Gl gl;
  GLuint solid = 0, ball = 0, solid_shadow = 0, ball_shadow = 0, ground = 0, background = 0,
         resolve = 0;
  GLuint vertex_array[3] = {};                  // solids, balls, nothing
  GLuint buffer[4] = {};                        // vertices, indices, balls, FrameBlock
  GLuint texture[4] = {}, framebuffer[3] = {};  // shadow; colour, depth; resolved

  Impl();
  ~Impl() {
    if (context != nullptr) mesa.DestroyContext(context);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void make_current();
  GLuint make_program(std::initializer_list<const char*> vertex,
                      std::initializer_list<const char*> fragment);
  void make_target(GLuint name, GLuint colour, GLenum colour_format, GLuint depth, int width,
                   int height);
  void upload(const DrawLists& lists, const FrameBlock& frame);
  void draw(GLuint program, GLuint array, GLenum mode, std::size_t first, std::size_t count);
  Image render(const RenderScene& scene, const RenderView& view);
};

void Renderer::Impl::make_current() {
  GNBV_CHECK(mesa.MakeCurrent(context, window.data(), GL_UNSIGNED_BYTE, 4, 4) == GL_TRUE,
             "OSMesaMakeCurrent failed");
}

Renderer::Impl::Impl() {
  const std::array<int, 15> attributes = {OSMESA_FORMAT,
                                          OSMESA_RGBA,
                                          OSMESA_DEPTH_BITS,
                                          0,
                                          OSMESA_STENCIL_BITS,
                                          0,
                                          OSMESA_PROFILE,
                                          OSMESA_CORE_PROFILE,
                                          OSMESA_CONTEXT_MAJOR_VERSION,
                                          3,
                                          OSMESA_CONTEXT_MINOR_VERSION,
                                          3,
                                          0,
                                          0,
                                          0};
  context = mesa.CreateContextAttribs(attributes.data(), nullptr);
  if (context == nullptr)
    throw BadInput("libOSMesa offers no OpenGL 3.3 core: Mesa 20 or later is needed");
  make_current();
#define X(name) gl.name = reinterpret_cast<decltype(gl.name)>(mesa.GetProcAddress("gl" #name));
  GNBV_GL_FUNCTIONS(X)
#undef X
  using namespace shaders;
  solid = make_program({kSolidVertex}, {kLighting, kSolidFragment});
  ball = make_program({kBallVertex}, {kLighting, kBallFragment});
  solid_shadow = make_program({kSolidShadowVertex}, {kSolidShadowFragment});
  ball_shadow = make_program({kBallShadowVertex}, {kBallShadowFragment});
  ground = make_program({kGroundVertex}, {kLighting, kGroundFragment});
  background = make_program({kScreenVertex}, {kBackgroundFragment});
  resolve = make_program({kScreenVertex}, {kResolveFragment});

  gl.GenVertexArrays(3, vertex_array);
  gl.GenBuffers(4, buffer);
  gl.GenTextures(4, texture);
  gl.GenFramebuffers(3, framebuffer);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, buffer[3]);
  const auto attribute = [&](GLuint index, int count, std::size_t stride, std::size_t offset) {
    gl.EnableVertexAttribArray(index);
    gl.VertexAttribPointer(index, count, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                           reinterpret_cast<const void*>(offset));
  };
  gl.BindVertexArray(vertex_array[0]);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer[0]);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer[1]);
  attribute(0, 3, sizeof(DrawVertex), offsetof(DrawVertex, p_world_m));
  attribute(1, 3, sizeof(DrawVertex), offsetof(DrawVertex, n_world));
  attribute(2, 4, sizeof(DrawVertex), offsetof(DrawVertex, rgba));
  gl.BindVertexArray(vertex_array[1]);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer[2]);
  attribute(0, 4, sizeof(DrawBall), offsetof(DrawBall, centre_m));
  attribute(1, 3, sizeof(DrawBall), offsetof(DrawBall, rgb));

  make_target(framebuffer[0], 0, 0, texture[0], kShadowSide_px, kShadowSide_px);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

GLuint Renderer::Impl::make_program(std::initializer_list<const char*> vertex,
                                    std::initializer_list<const char*> fragment) {
  const GLuint program = gl.CreateProgram();
  const auto attach = [&](GLenum stage, std::initializer_list<const char*> parts) {
    std::vector<const char*> sources = {shaders::kCommon};
    sources.insert(sources.end(), parts.begin(), parts.end());
    const GLuint shader = gl.CreateShader(stage);
    gl.ShaderSource(shader, static_cast<GLsizei>(sources.size()), sources.data(), nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(program, shader);
  };
  attach(GL_VERTEX_SHADER, vertex);
  attach(GL_FRAGMENT_SHADER, fragment);
  gl.LinkProgram(program);
  GLint is_linked = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &is_linked);
  std::array<char, 2000> log{};
  gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  GNBV_CHECK(is_linked == GL_TRUE, "shader: {}", log.data());
  const GLuint block = gl.GetUniformBlockIndex(program, "Frame");
  if (block != GL_INVALID_INDEX) gl.UniformBlockBinding(program, block, 0);
  return program;
}

// (Re)allocates the textures behind a framebuffer; leaves the depth texture bound, else the colour.
void Renderer::Impl::make_target(GLuint name, GLuint colour, GLenum colour_format, GLuint depth,
                                 int width, int height) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, name);
  const auto attach = [&](GLuint id, GLenum point, GLenum internal, GLenum format, GLenum type,
                          GLint wrap) {
    gl.BindTexture(GL_TEXTURE_2D, id);
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internal), width, height, 0, format, type,
                  nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, id, 0);
  };
  if (colour != 0) {
    attach(colour, GL_COLOR_ATTACHMENT0, colour_format, GL_RGBA, GL_UNSIGNED_BYTE,
           GL_CLAMP_TO_EDGE);
  } else {
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
  }
  if (depth != 0) {
    attach(depth, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
           GL_CLAMP_TO_EDGE);
  }
  GNBV_CHECK(gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE,
             "framebuffer of {} x {} px", width, height);
}

void Renderer::Impl::upload(const DrawLists& lists, const FrameBlock& frame) {
  const auto fill = [&](GLenum target, GLuint name, const void* data, std::size_t bytes) {
    gl.BindBuffer(target, name);
    gl.BufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
  };
  std::vector<std::uint32_t> indices = lists.casting;
  indices.insert(indices.end(), lists.plain.begin(), lists.plain.end());
  indices.insert(indices.end(), lists.translucent.begin(), lists.translucent.end());
  gl.BindVertexArray(vertex_array[0]);  // the index buffer belongs to it
  fill(GL_ARRAY_BUFFER, buffer[0], lists.vertices.data(),
       lists.vertices.size() * sizeof(DrawVertex));
  fill(GL_ELEMENT_ARRAY_BUFFER, buffer[1], indices.data(), indices.size() * sizeof(std::uint32_t));
  fill(GL_ARRAY_BUFFER, buffer[2], lists.balls.data(), lists.balls.size() * sizeof(DrawBall));
  fill(GL_UNIFORM_BUFFER, buffer[3], &frame, sizeof(frame));
}

// `first` and `count` are in indices for the solids, in points or vertices otherwise.
void Renderer::Impl::draw(GLuint program, GLuint array, GLenum mode, std::size_t first,
                          std::size_t count) {
  gl.UseProgram(program);
  gl.BindVertexArray(array);
  if (array == vertex_array[0]) {
    gl.DrawElements(mode, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
  } else {
    gl.DrawArrays(mode, static_cast<GLint>(first), static_cast<GLsizei>(count));
  }
}

Image Renderer::Impl::render(const RenderScene& scene, const RenderView& view) {
  const int width = view.width_px;
  const int height = view.height_px;
  if (std::min(width, height) < 1 || std::max(width, height) > kMaxSide_px) {
    throw BadInput(fmt::format("picture size {} x {} px: both must be from 1 to {}", width, height,
                               kMaxSide_px));
  }
  make_current();
  const DrawLists lists = make_draw_lists(scene);
  const FrameBlock frame = make_frame_block(scene, view, lists);
  upload(lists, frame);

  // what the key light sees
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer[0]);
  gl.Viewport(0, 0, kShadowSide_px, kShadowSide_px);
  gl.Enable(GL_DEPTH_TEST);
  gl.Enable(GL_PROGRAM_POINT_SIZE);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LESS);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  draw(solid_shadow, vertex_array[0], GL_TRIANGLES, 0, lists.casting.size());
  draw(ball_shadow, vertex_array[1], GL_POINTS, 0, lists.casting_balls);

  // the picture, supersampled: solids, ground, translucent faces
  make_target(framebuffer[1], texture[1], GL_SRGB8_ALPHA8, texture[2], 2 * width, 2 * height);
  gl.Viewport(0, 0, 2 * width, 2 * height);
  gl.Enable(GL_FRAMEBUFFER_SRGB);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  gl.BindTexture(GL_TEXTURE_2D, texture[0]);
  gl.DepthMask(GL_FALSE);
  gl.Disable(GL_DEPTH_TEST);
  draw(background, vertex_array[2], GL_TRIANGLES, 0, 3);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthMask(GL_TRUE);
  const std::size_t solids = lists.casting.size() + lists.plain.size();
  draw(solid, vertex_array[0], GL_TRIANGLES, 0, solids);
  draw(ball, vertex_array[1], GL_POINTS, 0, lists.balls.size());
  gl.DepthMask(GL_FALSE);
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  if (scene.ground && view.T_world_camera.translation().z() > scene.ground->z_m) {
    draw(ground, vertex_array[2], GL_TRIANGLE_STRIP, 0, 4);
  }
  draw(solid, vertex_array[0], GL_TRIANGLES, solids, lists.translucent.size());
  gl.Disable(GL_BLEND);
  gl.Disable(GL_FRAMEBUFFER_SRGB);
  gl.Disable(GL_DEPTH_TEST);

  // down to the size asked for
  make_target(framebuffer[2], texture[3], GL_RGBA8, 0, width, height);
  gl.Viewport(0, 0, width, height);
  gl.BindTexture(GL_TEXTURE_2D, texture[1]);
  draw(resolve, vertex_array[2], GL_TRIANGLES, 0, 3);
  Image image{width, height, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  const GLenum error = gl.GetError();
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
