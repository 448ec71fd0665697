#include "tools/render/gl_context.hpp"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <future>
#include <span>
#include <string_view>
#include <thread>
#include <type_traits>
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

// The function of a library, or nothing. Libraries are never closed: Mesa's threads and LLVM
// outlive a context. The Python wheel brings its own.
template <typename Function>
void find(std::initializer_list<const char*> libraries, const char* name, Function& function) {
  for (const char* library : libraries) {
    void* const opened = ::dlopen(library, RTLD_LAZY | RTLD_LOCAL);
    if (opened == nullptr) continue;
    function = reinterpret_cast<Function>(::dlsym(opened, name));
    return;
  }
}

// Mesa drew by it until 25.0. Its header goes with it, so what we use of it stands here.
class OsMesa final : public GlLibrary {
 public:
  OsMesa() {
    const auto find_here = [](const char* name, auto& function) {
      find({"$ORIGIN/libOSMesa.so.8", "libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}, name,
           function);
    };
    find_here("OSMesaCreateContextAttribs", create_);
    find_here("OSMesaDestroyContext", destroy_);
    find_here("OSMesaMakeCurrent", make_current_);
    find_here("OSMesaGetProcAddress", function_);
    if (create_ == nullptr) return;
    // no depth or stencil of its own: all drawing goes to textures
    constexpr int kProfile = 0x33, kCore = 0x34, kMajor = 0x36, kMinor = 0x37;
    constexpr std::array kAttributes = {kProfile, kCore, kMajor, 3, kMinor, 3, 0};
    context_ = create_(kAttributes.data(), nullptr);
  }
  ~OsMesa() override {
    if (context_ != nullptr) destroy_(context_);
  }
  OsMesa(const OsMesa&) = delete;
  OsMesa& operator=(const OsMesa&) = delete;

  bool has_context() const override { return context_ != nullptr; }
  void make_current() override {
    GNBV_CHECK(make_current_(context_, window_.data(), GL_UNSIGNED_BYTE, 4, 4) == GL_TRUE,
               "OSMesaMakeCurrent failed");
  }
  Function* function(const char* name) const override { return function_(name); }

 private:
  void* (*create_)(const int* attributes, void* shares) = nullptr;
  void (*destroy_)(void* context) = nullptr;
  GLboolean (*make_current_)(void* context, void* pixels, GLenum type, int width,
                             int height) = nullptr;
  Function* (*function_)(const char* name) = nullptr;
  void* context_ = nullptr;
  std::array<std::uint8_t, 4 * 4 * 4> window_{};  // it wants one; all drawing goes elsewhere
};

// Without a surface, on the device that Mesa names as its software: no GPU draws, and no display.
class Egl final : public GlLibrary {
 public:
  Egl() {
    find({"libEGL.so.1"}, "eglGetProcAddress", function_);
    if (function_ == nullptr) return;
    const auto find_here = [&](const char* name, auto& function) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(function_(name));
    };
    find_here("eglMakeCurrent", make_current_);
    find_here("eglDestroyContext", destroy_);
    decltype(&::eglGetPlatformDisplay) get_display = nullptr;
    decltype(&::eglInitialize) initialize = nullptr;
    decltype(&::eglBindAPI) bind_api = nullptr;
    decltype(&::eglCreateContext) create = nullptr;
    find_here("eglGetPlatformDisplay", get_display);
    find_here("eglInitialize", initialize);
    find_here("eglBindAPI", bind_api);
    find_here("eglCreateContext", create);
    const EGLDeviceEXT device = software_device();
    if (device == EGL_NO_DEVICE_EXT || get_display == nullptr) return;
    display_ = get_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    if (initialize(display_, nullptr, nullptr) != EGL_TRUE) return;
    constexpr std::array kAttributes = {EGL_CONTEXT_MAJOR_VERSION,
                                        3,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        3,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_NONE};
    bind_api(EGL_OPENGL_API);
    context_ = create(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes.data());
  }
  ~Egl() override {  // its display is the process's
    if (context_ == EGL_NO_CONTEXT) return;
    make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    destroy_(display_, context_);
  }
  Egl(const Egl&) = delete;
  Egl& operator=(const Egl&) = delete;

  bool has_context() const override { return context_ != EGL_NO_CONTEXT; }
  void make_current() override {
    GNBV_CHECK(make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE,
               "eglMakeCurrent failed");
  }
  Function* function(const char* name) const override { return function_(name); }

 private:
  EGLDeviceEXT software_device() const {
    const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(function_("eglQueryDevicesEXT"));
    const auto text =
        reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(function_("eglQueryDeviceStringEXT"));
    std::array<EGLDeviceEXT, 64> devices{};
    EGLint count = 0;
    if (query == nullptr || text == nullptr ||
        query(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE) {
      return EGL_NO_DEVICE_EXT;
    }
    for (const EGLDeviceEXT device : std::span(devices).first(static_cast<std::size_t>(count))) {
      const char* const extensions = text(device, EGL_EXTENSIONS);
      if (extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr) {
        return device;
      }
    }
    return EGL_NO_DEVICE_EXT;
  }

  Function* (*function_)(const char* name) = nullptr;
  decltype(&::eglMakeCurrent) make_current_ = nullptr;
  decltype(&::eglDestroyContext) destroy_ = nullptr;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

std::unique_ptr<GlLibrary> open_library() {
  need_address_space(kDrawing_bytes);
  need_threads(std::thread::hardware_concurrency() + 2);
  const char* const asked = std::getenv("GNBV_GL");
  const std::string_view wanted = asked == nullptr ? "" : asked;
  if (wanted != "egl") {
    if (auto library = std::make_unique<OsMesa>(); library->has_context()) return library;
  }
  if (wanted != "osmesa") {
    if (auto library = std::make_unique<Egl>(); library->has_context()) return library;
  }
  throw BadInput(
      "pictures need Mesa 20 or later, with OpenGL 3.3: Debian package libosmesa6, or where there "
      "is none libegl1 with libegl-mesa0");
}

}  // namespace

GlContext::GlContext() : library_(open_library()) {
  make_current();
#define X(name) gl.name = reinterpret_cast<decltype(gl.name)>(library_->function("gl" #name));
  GNBV_GL_FUNCTIONS(X)
#undef X
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
