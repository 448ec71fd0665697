# cmake -DOUT=builtin.cpp -DYAML="a.yaml;b.yaml" -P embed.cmake: files as string literals.
list(SORT YAML)
set(entries "")
foreach(file IN LISTS YAML)
  get_filename_component(name "${file}" NAME_WE)
  get_filename_component(folder "${file}" DIRECTORY)
  get_filename_component(folder "${folder}" NAME)
  file(READ "${file}" text)
  string(APPEND entries "    {\"${folder}\", \"${name}\", R\"gnbv_yaml(${text})gnbv_yaml\"},\n")
endforeach()
file(WRITE "${OUT}" "// made by scenarios/embed.cmake
#include \"scenarios/builtin.hpp\"

namespace gnbv {
namespace {
constexpr BuiltinFile kFiles[] = {
${entries}};
}  // namespace

std::vector<BuiltinFile> builtin_files(std::string_view folder) {
  std::vector<BuiltinFile> files;
  for (const BuiltinFile& file : kFiles) {
    if (file.folder == folder) files.push_back(file);
  }
  return files;
}

std::vector<std::string_view> builtin_names(std::string_view folder) {
  std::vector<std::string_view> names;
  for (const BuiltinFile& file : builtin_files(folder)) names.push_back(file.name);
  return names;
}

}  // namespace gnbv
")
