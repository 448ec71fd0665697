// OSMesa and GL, opened at run time, so that programs which draw nothing do not pay for loading
// them (32 ms) nor need them installed. For render.cpp only.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>

#include <array>
#include <cstdint>
#include <initializer_list>

namespace gnbv {

// clang-format off
#define GNBV_OSMESA_FUNCTIONS(X) \
  X(CreateContextAttribs) X(DestroyContext) X(MakeCurrent) X(GetProcAddress)
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

/// A context that draws into textures only, and the functions of GL 3.3 core.
class GlContext {
 public:
  /// Throws BadInput when the OSMesa library is missing or too old, naming the Debian package.
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  void make_current();
  /// A program whose shaders begin with kCommon of shaders.hpp and share its block `Frame`. Its
  /// samplers shadow_map, picture, depths, distances, shade and paint are texture units 0 to 5.
  GLuint make_program(std::initializer_list<const char*> vertex,
                      std::initializer_list<const char*> fragment) const;

  Gl gl;

 private:
  OsMesa mesa_;
  OSMesaContext context_ = nullptr;
  std::array<std::uint8_t, 4 * 4 * 4> window_{};  // OSMesa wants one; all drawing goes elsewhere
};

}  // namespace gnbv
