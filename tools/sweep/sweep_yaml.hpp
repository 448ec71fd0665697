// What the parts of a sweep file have in common.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/document.hpp"
#include "tools/sweep/sweep.hpp"

namespace gnbv {

/// Reads values and keeps what is wrong with them.
class SweepYaml {
 public:
  explicit SweepYaml(std::string file) : file_(std::move(file)) {}

  ValidationErrors& errors() { return errors_; }
  void fault(const YamlNode& node, const std::string& path, const std::string& what);

  /// Whether it is a map; keys that are not known are named.
  bool require_map(const YamlNode& node, const std::string& path,
                   std::initializer_list<std::string_view> known);

  /// The items of a list, which has some; a single value is a list of one; none without a node.
  std::vector<const YamlNode*> items_of(const YamlNode* node, const std::string& path);

  /// The text of a scalar; empty where there is no node, and, with a fault, where it is none.
  std::string text_of(const YamlNode* node, const std::string& path, const std::string& what);

  /// A map of scenario keys as overrides; none where there is no node.
  std::vector<Override> settings_of(const YamlNode* node, const std::string& path);

 private:
  std::string file_;
  ValidationErrors errors_;
};

/// The methods of a sweep file: utilities, presets and variants side by side, each at every point
/// of the grid, whose last key changes fastest; "default" where there is neither. A utility may be
/// a function of the user's own, [NAME=]FILE.py[:FUNCTION], beside `folder`.
std::vector<SweepMethod> read_methods(const YamlNode& root, const std::filesystem::path& folder,
                                      SweepYaml& yaml);

/// ValidationErrors of many locations, one a line: each once, those of a file together and in its
/// order.
std::string in_order_of_lines(const std::string& faults);

}  // namespace gnbv
