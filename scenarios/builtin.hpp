// The *.yaml files of this folder, compiled in: the program runs without them.
#pragma once

#include <span>
#include <string_view>

namespace gnbv {

struct BuiltinScenario {
  std::string_view name;  // the file's, without .yaml
  std::string_view yaml;
};

/// Sorted by name.
std::span<const BuiltinScenario> builtin_scenarios();

}  // namespace gnbv
