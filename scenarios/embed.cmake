# cmake -DOUT=builtin.cpp -DYAML="a.yaml;b.yaml" -P embed.cmake: files as string literals.
list(SORT YAML)
set(entries "")
foreach(file IN LISTS YAML)
  get_filename_component(name "${file}" NAME_WE)
  file(READ "${file}" text)
  string(APPEND entries "    {\"${name}\", R\"gnbv_yaml(${text})gnbv_yaml\"},\n")
endforeach()
file(WRITE "${OUT}" "// made by scenarios/embed.cmake
#include \"scenarios/builtin.hpp\"

namespace gnbv {
namespace {
constexpr BuiltinScenario kScenarios[] = {
${entries}};
}  // namespace

std::span<const BuiltinScenario> builtin_scenarios() { return kScenarios; }

}  // namespace gnbv
")
