// Parts of the program that are loaded only when they are needed, because the libraries they link
// would slow down every start.
#pragma once

#include <string>

namespace gnbv {

/// A library of our own build.
struct ModulePlace {
  std::string file;      // its name, looked for beside the program
  std::string as_built;  // its path in the build folder
  std::string needs;     // what it does not work without: "PCL, Debian package libpcl-dev"
};

/// A function of the module, by its name with C linkage. The module stays loaded. Throws BadInput,
/// saying why, when it cannot be loaded or lacks the function.
void* function_in_module(const ModulePlace& place, const char* name);

}  // namespace gnbv
