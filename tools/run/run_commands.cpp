#include "tools/run/run_commands.hpp"

#include <fmt/format.h>

#include "sim/core/text.hpp"
#include "tools/run/file_names.hpp"

namespace gnbv {

namespace fs = std::filesystem;

std::string command_to_resume(const fs::path& folder, const std::string& options) {
  std::error_code ignored;
  const auto keeps = [&](const fs::path& name) { return fs::exists(folder / name, ignored); };
  const bool has_candidates = keeps(kCandidatesFile) || keeps(part_of(kCandidatesFile));
  return fmt::format(
      "`gnbv run {} {}--resume --out {}{}{}`", shell_word((folder / kScenarioFile).string()),
      options.empty() ? "" : options + " ", shell_word(folder.string()),
      keeps(kFramesFolder) ? " --frames" : "", has_candidates ? " --candidates" : "");
}

std::string command_to_fly_again(const fs::path& folder, const std::string& options) {
  return fmt::format("`gnbv run {} {}--out NEW`", shell_word((folder / kScenarioFile).string()),
                     options.empty() ? "" : options + " ");
}

}  // namespace gnbv
