// Functions of the user's own as the command line names them, [NAME=]FILE.py[:FUNCTION], beside the
// utilities of the program, [NAME=]UTILITY.
#pragma once

#include <string>
#include <vector>

#include "scenarios/load.hpp"

namespace gnbv {

/// KEY=VALUE each, as `--set` gives them.
std::vector<Override> overrides_of(const std::vector<std::string>& sets);

/// A utility, a planner, or other settings, by a name of its own.
struct NamedMethod {
  std::string name = {};  // the NAME, the FUNCTION, or the utility's own
  std::vector<Override> overrides = {};
  /// What to call it instead where others have its name, the shortest first; none with a NAME.
  std::vector<std::string> longer_names = {};
};

/// The settings that `OPTION TEXT` stands for; a relative FILE begins at `folder`. A file is read.
/// A function of two parameters without defaults is a planner. Throws BadInput naming a file that
/// cannot be read or defines no such function, and, without a FUNCTION, one that defines several.
NamedMethod named_method(const std::string& text, const std::string& option = "--utility",
                         const std::filesystem::path& folder = {});

/// Gives longer names to those that share one.
void tell_apart(std::vector<NamedMethod>& methods);

/// Each of them, named as shortly as tells them apart.
std::vector<NamedMethod> named_methods(const std::vector<std::string>& texts,
                                       const std::string& option);

}  // namespace gnbv
