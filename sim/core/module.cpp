#include "sim/core/module.hpp"

#include <dlfcn.h>
#include <linux/limits.h>
#include <sys/mman.h>

#include <array>
#include <new>
#include <string_view>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// More than any module and its libraries map. The loader does not say when it lacks memory, so we
/// ask for this much before we report its error.
constexpr std::size_t kModule_bytes = 256U << 20U;

std::string path_of(void* library, const std::string& file) {
  std::array<char, PATH_MAX> folder{};
  if (::dlinfo(library, RTLD_DI_ORIGIN, folder.data()) != 0) return file;
  return fmt::format("{}/{}", folder.data(), file);
}

}  // namespace

void* function_in_module(const ModulePlace& place, const char* name) {
  void* library = nullptr;
  std::string reasons;
  for (const std::string& path :
       {"$ORIGIN/" + place.file, "$ORIGIN/../lib/gnbv/" + place.file, place.file, place.as_built}) {
    library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) break;
    const char* const reason = ::dlerror();
    reasons += fmt::format("\n  {}", reason == nullptr ? path : reason);
  }
  if (library == nullptr) {
    need_address_space(kModule_bytes);
    throw BadInput(fmt::format("this needs {} beside the program, and {}:{}", place.file,
                               place.needs, reasons));
  }
  using Version = const char*();
  auto* const version = reinterpret_cast<Version*>(::dlsym(library, "gnbv_module_version"));
  if (version == nullptr || std::string_view(version()) != GNBV_VERSION) {
    throw BadInput(fmt::format("{} is of version {}, the program of " GNBV_VERSION
                               ": two versions are installed in one place",
                               path_of(library, place.file),
                               version == nullptr ? "0.1.0 or older" : version()));
  }
  void* const function = ::dlsym(library, name);
  if (function == nullptr) {
    throw BadInput(
        fmt::format("{} lacks {}: it belongs to another version of the program", place.file, name));
  }
  return function;
}

void need_address_space(std::size_t bytes) {
  void* const memory = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  ::munmap(memory, bytes);
}

}  // namespace gnbv
