// Whose a run directory is while a mission flies into it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/file.hpp"

namespace gnbv {

/// A run directory that is this process's alone: whoever makes a folder or gets its lock owns it.
class RunClaim {
 public:
  /// Makes the folder if need be. Throws BadInput naming it when another process has it, and as
  /// make_folder().
  explicit RunClaim(std::filesystem::path folder);

  /// runs/NAME, or runs/NAME-2 and so on: the first that did not exist.
  static RunClaim of_free_folder(const std::string& name);

  RunClaim(RunClaim&&) = default;
  RunClaim& operator=(RunClaim&&) = delete;
  /// Removes the folders that it made, as far as nothing came into them.
  ~RunClaim();

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> made_;  // deepest first
  std::optional<FileLock> lock_;
};

}  // namespace gnbv
