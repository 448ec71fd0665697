#include "sim/core/module.hpp"

#include <dlfcn.h>

#include "sim/core/error.hpp"

namespace gnbv {

void* function_in_module(const ModulePlace& place, const char* name) {
  void* library = nullptr;  // opened twice, it is the same one
  std::string reasons;
  for (const std::string& path : {"$ORIGIN/" + place.file, place.as_built}) {
    library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) break;
    const char* const reason = ::dlerror();
    reasons += fmt::format("\n  {}", reason == nullptr ? path : reason);
  }
  if (library == nullptr) {
    throw BadInput(fmt::format("this needs {} beside the program, and {}:{}", place.file,
                               place.needs, reasons));
  }
  void* const function = ::dlsym(library, name);
  if (function == nullptr) {
    throw BadInput(
        fmt::format("{} lacks {}: it belongs to another version of the program", place.file, name));
  }
  return function;
}

}  // namespace gnbv
