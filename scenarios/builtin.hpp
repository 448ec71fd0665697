// The YAML files of this folder, compiled in: the program runs without them.
#pragma once

#include <string_view>
#include <vector>

namespace gnbv {

struct BuiltinFile {
  std::string_view folder;  // "scenarios", or a folder of presets: "vehicles", "cameras", "lidars"
  std::string_view name;    // the file's, without .yaml
  std::string_view yaml;
};

/// Those of a folder, sorted by name.
std::vector<BuiltinFile> builtin_files(std::string_view folder);
std::vector<std::string_view> builtin_names(std::string_view folder);

}  // namespace gnbv
