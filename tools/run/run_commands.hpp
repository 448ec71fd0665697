// The commands that make what a run directory lacks, as a shell takes them.
#pragma once

#include <filesystem>
#include <string>

namespace gnbv {

/// `gnbv run FOLDER/scenario.yaml OPTIONS --resume --out FOLDER`, keeping what the run in the
/// folder keeps.
std::string command_to_resume(const std::filesystem::path& folder, const std::string& options = "");

/// `gnbv run FOLDER/scenario.yaml OPTIONS --out NEW`: flies the same mission once more.
std::string command_to_fly_again(const std::filesystem::path& folder,
                                 const std::string& options = "");

}  // namespace gnbv
