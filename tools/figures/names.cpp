#include "tools/figures/names.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "sim/core/sha256.hpp"
#include "tools/run/run_record.hpp"

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

std::string source_mark(const std::string& source) {
  constexpr std::size_t kDigits = 6;
  Sha256 hash;
  hash.add(source);
  return hash.hex().substr(0, kDigits);
}

std::vector<std::string> method_names(std::span<const PlannerConfig* const> planners) {
  std::map<std::string, std::set<std::string>> sources;
  for (const PlannerConfig* const planner : planners) {
    sources[utility_title(planner->utility)].insert(planner->utility.python.source);
  }
  std::vector<std::string> names;
  for (const PlannerConfig* const planner : planners) {
    names.push_back(utility_title(planner->utility));
    if (!is_user_utility(planner->utility.name) || sources[names.back()].size() < 2) continue;
    names.back() += fmt::format(" ({})", source_mark(planner->utility.python.source));
  }
  return names;
}

}  // namespace gnbv
