#include "bench/compare/table_groups.hpp"

#include <algorithm>
#include <map>

#include "sim/core/error.hpp"

namespace gnbv {

std::vector<TableGroup> table_groups(std::span<const RunFigures> runs,
                                     std::span<const std::string> settings) {
  GNBV_CHECK(settings.empty() || settings.size() == runs.size(), "{} settings of {} runs",
             settings.size(), runs.size());
  std::vector<TableGroup> groups;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string setting = settings.empty() ? "" : settings[i];
    auto group = std::find_if(groups.begin(), groups.end(), [&](const TableGroup& g) {
      return g.utility == runs[i].utility && g.setting == setting;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), {runs[i].utility, setting});
    group->runs.push_back(&runs[i]);
  }
  return groups;
}

std::string name_in_table(const PaperTable& paper, const std::string& utility) {
  if (const PaperRow* const row = find_row(paper, utility)) return std::string(row->label);
  static const std::map<std::string, std::string> labels = {
      {"tour", "Tour"},
      {"oracle_views", "Oracle, few views"},
      {"oracle_metres", "Oracle, few metres"}};
  const auto label = labels.find(utility);
  return label == labels.end() ? utility : label->second;
}

}  // namespace gnbv
