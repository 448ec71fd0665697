// Whatever stands in a sweep file: its methods and settings are read or faults, in bounded numbers.
#include <cstddef>
#include <cstdint>
#include <string>

#include "sim/core/error.hpp"
#include "tools/sweep/sweep_yaml.hpp"

namespace gnbv {
namespace {

void check_sweep(const std::string& text) {
  SweepYaml yaml("fuzz.yaml");
  const auto root = parse_document(text, {"fuzz.yaml", 1, 0}, yaml.errors());
  if (!root) return;
  yaml.require_map(*root, "",
                   {"scenarios", "utilities", "presets", "variants", "grid", "set", "seeds"});
  for (const Override& set : yaml.settings_of(root->find("set"), "set")) {
    GNBV_CHECK(!set.source.empty(), "a setting of no place");
  }
  for (const YamlNode* const one : yaml.items_of(root->find("scenarios"), "scenarios")) {
    yaml.text_of(one, "scenarios", "a name");
  }
  const std::vector<SweepMethod> methods = read_methods(*root, "/nowhere", yaml);
  GNBV_CHECK(methods.size() <= kMaxCells, "{} methods", methods.size());
  std::set<std::string> names;
  for (const SweepMethod& method : methods) {
    GNBV_CHECK(!method.name.empty(), "a method without a name");
    GNBV_CHECK(names.insert(method.name).second || !yaml.errors().empty(), "two are '{}'",
               method.name);
  }
  try {
    yaml.errors().throw_if_any();
  } catch (const BadInput& faults) {
    GNBV_CHECK(!in_order_of_lines(faults.what()).empty(), "faults of no line");
  }
}

}  // namespace
}  // namespace gnbv

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gnbv::check_sweep(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
