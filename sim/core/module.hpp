// Parts of the program that are loaded only when they are needed, because the libraries they link
// would slow down every start.
#pragma once

#include <string>

namespace gnbv {

/// A library of our own build.
struct ModulePlace {
  // its name, looked for beside the program, in ../lib/gnbv from there, and on the run path
  std::string file;
  std::string as_built;  // its path in the build folder
  std::string needs;     // what it does not work without: "PCL, Debian package libpcl-dev"
};

/// A function of the module, by its name with C linkage. The module stays loaded. Throws BadInput,
/// saying why, when it cannot be loaded, is of another version or lacks the function;
/// std::bad_alloc when there is no memory to load it.
void* function_in_module(const ModulePlace& place, const char* name);

}  // namespace gnbv

/// Stands once in each module, outside of namespaces: what function_in_module() checks.
#define GNBV_MODULE(version)                                                            \
  extern "C" __attribute__((visibility("default"))) const char* gnbv_module_version() { \
    return version;                                                                     \
  }
