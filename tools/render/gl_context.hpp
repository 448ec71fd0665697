// GL, opened at run time, so that programs which draw nothing do not pay for loading Mesa (32 ms)
// nor need it installed. For renderer.cpp only.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>

#include <initializer_list>
#include <memory>

namespace gnbv {

// clang-format off
#define GNBV_GL_FUNCTIONS(X)                                                                    \
  X(ActiveTexture) X(AttachShader) X(BindBuffer) X(BindBufferBase) X(BindFramebuffer)           \
  X(BindTexture) X(BindVertexArray) X(BlendFunc) X(BufferData) X(CheckFramebufferStatus)        \
  X(Clear) X(ColorMask) X(CompileShader) X(CreateProgram) X(CreateShader) X(DepthFunc)          \
  X(DepthMask) X(Disable) X(DrawArrays) X(DrawBuffer) X(DrawElements) X(Enable)                 \
  X(EnableVertexAttribArray) X(FramebufferTexture2D) X(GenBuffers) X(GenFramebuffers)           \
  X(GenTextures) X(GenVertexArrays) X(GetError) X(GetProgramInfoLog) X(GetProgramiv)            \
  X(GetUniformBlockIndex) X(GetUniformLocation) X(LinkProgram) X(PixelStorei) X(PolygonOffset) X(ReadBuffer)     \
  X(ReadPixels) X(Scissor) X(ShaderSource) X(TexImage2D) X(TexParameteri) X(Uniform1i)                     \
  X(UniformBlockBinding) X(UseProgram) X(VertexAttribPointer) X(Viewport)
// clang-format on

struct Gl {
#define X(name) decltype(&::gl##name) name = nullptr;
  GNBV_GL_FUNCTIONS(X)
#undef X
};

/// A context without a window, of GL 3.3 core.
class GlLibrary {
 public:
  using Function = void();
  virtual ~GlLibrary() = default;
  virtual bool has_context() const = 0;
  virtual void make_current() = 0;
  virtual Function* function(const char* name) const = 0;
};

/// A context that draws into textures only, and the functions of GL 3.3 core.
class GlContext {
 public:
  /// By OSMesa, or without it (Mesa has none since 25.1) by EGL on the device that draws on the
  /// CPU: the same code draws. The variable GNBV_GL, "osmesa" or "egl", asks for one. Throws
  /// BadInput when neither is there or new enough, naming the Debian packages.
  GlContext();

  void make_current() { library_->make_current(); }
  /// A program whose shaders begin with kCommon of shaders.hpp and share its block `Frame`. Its
  /// samplers shadow_map, picture, depths, distances, shade and paint are texture units 0 to 5.
  GLuint make_program(std::initializer_list<const char*> vertex,
                      std::initializer_list<const char*> fragment) const;

  Gl gl;

 private:
  std::unique_ptr<GlLibrary> library_;
};

}  // namespace gnbv
