// Names by which people tell runs and methods apart.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scenarios/scenario.hpp"

namespace gnbv {

/// A name for each run directory, in their order: that of the folder, however its path is written
/// ("x/run/" and "." have names, too). A number follows where two are named alike: run, run-2.
std::vector<std::string> run_names(std::span<const std::filesystem::path> folders);

/// The first digits of the SHA-256 of a user's source: what tells two functions of one name apart.
std::string source_mark(const std::string& source);

/// What legends and tables call the methods of these missions: "Proposed", "AEP", "mine" for a
/// function of the user's own. Two functions of one name are told apart by the source_mark() of
/// their files: "mine (86b82e)".
std::vector<std::string> method_names(std::span<const PlannerConfig* const> planners);

}  // namespace gnbv
