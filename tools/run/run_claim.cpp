#include "tools/run/run_claim.hpp"

#include "sim/core/error.hpp"
#include "tools/run/file_names.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// The folder and those above it that are not there, deepest first.
std::vector<fs::path> missing_folders(fs::path folder) {
  std::error_code ignored;
  std::vector<fs::path> missing;
  for (; !folder.empty() && !fs::exists(fs::symlink_status(folder, ignored));
       folder = folder.parent_path()) {
    missing.push_back(folder);
  }
  return missing;
}

}  // namespace

RunClaim::RunClaim(fs::path folder) : folder_(std::move(folder)), made_(missing_folders(folder_)) {
  make_folder(folder_);
  lock_ = FileLock::take(folder_ / kLockFile);
  if (lock_) return;
  throw BadInput("{}: another gnbv flies into it now: wait for it, or choose another --out",
                 folder_.string());
}

RunClaim RunClaim::of_free_folder(const std::string& name) {
  const fs::path runs = "runs";
  const bool has_made_runs = make_folder(runs);
  for (int n = 1;; ++n) {
    const fs::path folder = runs / (n == 1 ? name : fmt::format("{}-{}", name, n));
    std::error_code error;
    const bool is_new = fs::create_directory(folder, error);
    if (error && !fs::exists(fs::symlink_status(folder))) refuse_to_write(folder, error.value());
    if (!is_new) continue;
    RunClaim claim(folder);
    claim.made_.push_back(folder);
    if (has_made_runs) claim.made_.push_back(runs);
    return claim;
  }
}

RunClaim::~RunClaim() {
  if (!lock_) return;
  std::error_code ignored;
  fs::remove(folder_ / kLockFile, ignored);
  for (const fs::path& folder : made_) {
    if (fs::is_directory(fs::symlink_status(folder, ignored))) fs::remove(folder, ignored);
  }
}

}  // namespace gnbv
