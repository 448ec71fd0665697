// Names by which people tell runs apart.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace gnbv {

/// A name for each run directory, in their order: that of the folder, however its path is written
/// ("x/run/" and "." have names, too). A number follows where two are named alike: run, run-2.
std::vector<std::string> run_names(std::span<const std::filesystem::path> folders);

}  // namespace gnbv
