#include "tools/render/gl_context.hpp"

#include <dlfcn.h>

#include <exception>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/core/module.hpp"
#include "tools/render/shaders.hpp"

#ifdef __SANITIZE_ADDRESS__
// Mesa 22 never frees its record of a context's window: 160 bytes a context
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa.so"; }
// nor a table of them among what the program says
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif

#ifdef __SANITIZE_THREAD__
// Mesa 22 destroys a fence when it has waited for it, while the thread that signalled it returns
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() { return "race:libOSMesa.so"; }
#endif

namespace gnbv {
namespace {

// What Mesa, LLVM, their threads and the smallest picture take. Refused it, they crash.
constexpr std::size_t kDrawing_bytes = 640U << 20U;

// Mesa waits for ever for threads of its own that it could not start. Throws what std::async does
// when the system starts no more so many.
void need_threads(unsigned count) {
  std::promise<void> all_started;
  const std::shared_future<void> end = all_started.get_future().share();
  std::vector<std::future<void>> threads;
  threads.reserve(count);
  std::exception_ptr refused;
  try {
    for (unsigned i = 0; i < count; ++i) {
      threads.push_back(std::async(std::launch::async, [end] { end.wait(); }));
    }
  } catch (...) {  // before those that wait are joined
    refused = std::current_exception();
  }
  all_started.set_value();
  threads.clear();
  if (refused) std::rethrow_exception(refused);
}

// Never closed: Mesa's threads and LLVM outlive a context. The Python wheel brings its own.
OsMesa open_osmesa() {
  need_address_space(kDrawing_bytes);
  need_threads(std::thread::hardware_concurrency() + 2);
  void* library = nullptr;
  for (const char* name :
       {"$ORIGIN/libOSMesa.so.8", "libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
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

GlContext::GlContext() : mesa_(open_osmesa()) {
  // no depth or stencil of its own: all drawing goes to textures
  constexpr std::array kAttributes = {OSMESA_PROFILE,
                                      OSMESA_CORE_PROFILE,
                                      OSMESA_CONTEXT_MAJOR_VERSION,
                                      3,
                                      OSMESA_CONTEXT_MINOR_VERSION,
                                      3,
                                      0};
  context_ = mesa_.CreateContextAttribs(kAttributes.data(), nullptr);
  if (context_ == nullptr)
    throw BadInput("libOSMesa offers no OpenGL 3.3 core: Mesa 20 or later is needed");
  make_current();
#define X(name) gl.name = reinterpret_cast<decltype(gl.name)>(mesa_.GetProcAddress("gl" #name));
  GNBV_GL_FUNCTIONS(X)
#undef X
}

GlContext::~GlContext() {
  if (context_ != nullptr) mesa_.DestroyContext(context_);
}

void GlContext::make_current() {
  GNBV_CHECK(mesa_.MakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, 4, 4) == GL_TRUE,
             "OSMesaMakeCurrent failed");
}

GLuint GlContext::make_program(std::initializer_list<const char*> vertex,
                               std::initializer_list<const char*> fragment) const {
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
  gl.UseProgram(program);
  GLint unit = 0;
  for (const char* sampler : {"shadow_map", "picture", "depths", "distances", "shade", "paint"}) {
    const GLint location = gl.GetUniformLocation(program, sampler);
    if (location >= 0) gl.Uniform1i(location, unit);
    ++unit;
  }
  return program;
}

}  // namespace gnbv
