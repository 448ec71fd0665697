#include "tools/sweep/cell_files.hpp"

#include "sim/core/error.hpp"
#include "tools/run/summary_json.hpp"

namespace gnbv {

namespace fs = std::filesystem;

CellFiles cell_files(const fs::path& folder, const std::string& id) {
  const fs::path cells = folder / kCellsFolder;
  return {cells / id, cells / (id + ".part"), cells / (id + ".log"), cells / (id + ".lock"),
          cells / (id + ".failed.json")};
}

std::optional<std::string> termination_of(const fs::path& run) {
  try {
    return read_summary(run).termination;
  } catch (const BadInput&) {  // none, or one that a killed process left
    return std::nullopt;
  }
}

}  // namespace gnbv
