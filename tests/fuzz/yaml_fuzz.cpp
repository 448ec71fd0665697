// Whatever stands in a scenario file or an override: it is a tree or a fault, and never both
// nothing.
#include <cstddef>
#include <cstdint>
#include <string>

#include "scenarios/document.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

std::size_t nodes_of(const YamlNode& node) {
  std::size_t count = 1;
  for (const YamlNode& item : node.items) count += nodes_of(item);
  for (const YamlEntry& entry : node.entries) count += nodes_of(entry.value);
  return count;
}

void check(const std::string& text) {
  ValidationErrors faults;
  const SourceLocation file = {"fuzz.yaml", 1, 0};
  const auto tree = parse_document(text, file, faults);
  GNBV_CHECK(tree || !faults.empty(), "nothing, and no fault");
  // what stands there, and what anchors and aliases may make of it
  if (tree) GNBV_CHECK(nodes_of(*tree) <= 2 * text.size() + 100'002, "{} nodes", nodes_of(*tree));
  ValidationErrors override_faults;
  const auto picks = parse_override(text, {"--set", 0, 1}, override_faults);
  GNBV_CHECK(picks || !override_faults.empty(), "nothing, and no fault");
}

}  // namespace
}  // namespace gnbv

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gnbv::check(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
