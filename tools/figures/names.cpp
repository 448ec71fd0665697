#include "tools/figures/names.hpp"

#include <fmt/format.h>

#include <set>

namespace gnbv {
namespace {

std::string name_of_folder(const std::filesystem::path& folder) {
  if (folder.empty()) return "";  // absolute() throws; read_run() will say what is wrong
  // the end of "x/run/" is an empty name, that of "." is no name
  return (std::filesystem::absolute(folder) / ".").lexically_normal().parent_path().filename();
}

}  // namespace

std::vector<std::string> run_names(std::span<const std::filesystem::path> folders) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const std::filesystem::path& folder : folders) {
    const std::string name = name_of_folder(folder);
    std::string free = name;
    for (int i = 2; !taken.insert(free).second; ++i) free = fmt::format("{}-{}", name, i);
    names.push_back(free);
  }
  return names;
}

}  // namespace gnbv
