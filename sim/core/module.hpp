// Parts of the program that it loads only when it needs them: the libraries that they link would
// slow down every start.
#pragma once

#include <cstddef>
#include <string>

namespace gnbv {

/// A library of our own build.
struct ModulePlace {
  std::string file;      // looked for beside the program, in ../lib/gnbv, and on the run path
  std::string as_built;  // its path in the build folder
  std::string needs;     // what it links: "PCL, Debian package libpcl-dev"
};

/// A function of the module, by its name with C linkage. The module stays loaded. Throws BadInput
/// with the reason when the module cannot be loaded, has another version or lacks the function;
/// std::bad_alloc when there is no memory to load it.
void* function_in_module(const ModulePlace& place, const char* name);

/// Throws std::bad_alloc when this process cannot have so many more bytes (`ulimit -v`). Ask before
/// a call of a library that crashes, or blames something else, without memory.
void need_address_space(std::size_t bytes);

}  // namespace gnbv

/// Stands once in each module, outside of namespaces: the version that function_in_module() checks.
#define GNBV_MODULE(version)                                                            \
  extern "C" __attribute__((visibility("default"))) const char* gnbv_module_version() { \
    return version;                                                                     \
  }
