#include "planner/symmetry_module.hpp"

#include <dlfcn.h>

#include <string>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

template <typename Function>
Function* function_of(void* library, const char* name) {
  auto* function = reinterpret_cast<Function*>(::dlsym(library, name));
  if (function == nullptr) {
    throw BadInput(fmt::format("{} lacks {}: it belongs to another version of the program",
                               GNBV_SYMMETRY_MODULE, name));
  }
  return function;
}

SymmetryModule open_module() {
  void* library = nullptr;
  std::string reasons;
  for (const char* path : {"$ORIGIN/" GNBV_SYMMETRY_MODULE, GNBV_SYMMETRY_MODULE_AS_BUILT}) {
    library = ::dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) break;
    const char* reason = ::dlerror();
    reasons += fmt::format("\n  {}", reason == nullptr ? path : reason);
  }
  if (library == nullptr) {
    throw BadInput(
        fmt::format("symmetry needs {} beside the program, and PCL, Debian package libpcl-dev:{}",
                    GNBV_SYMMETRY_MODULE, reasons));
  }
  return {function_of<MatchKeypoints>(library, "gnbv_match_keypoints"),
          function_of<RefinePlanes>(library, "gnbv_refine_planes")};
}

}  // namespace

const SymmetryModule& symmetry_module() {
  static const SymmetryModule module = open_module();
  return module;
}

}  // namespace gnbv
