// Where a cell lies in the folder of a sweep, and who has it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace gnbv {

constexpr const char* kCellsFolder = "cells";  // of a sweep's folder

struct CellFiles {
  std::filesystem::path run;     // the run directory; there as soon as, and only when, it is done
  std::filesystem::path part;    // the run directory of a mission that is not done
  std::filesystem::path log;     // what the mission printed
  std::filesystem::path lock;    // held while it is flown
  std::filesystem::path failed;  // how it ended, when it failed
};

CellFiles cell_files(const std::filesystem::path& folder, const std::string& id);

/// The mission's termination as its summary.json has it; nothing when there is none.
std::optional<std::string> termination_of(const std::filesystem::path& run);

}  // namespace gnbv
