// Where a cell lies in the folder of a sweep, and who has it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

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

/// An exclusive lock on a file, that the kernel releases when the last process that has it open
/// ends: a mission whose sweep was killed keeps its cell.
class CellLock {
 public:
  /// Makes the file if need be. Nothing when another process holds it; throws BadInput when the
  /// file cannot be made, or its file system knows no locks.
  static std::optional<CellLock> take(const std::filesystem::path& path);

  CellLock(CellLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  CellLock& operator=(CellLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~CellLock();

  /// Closed in processes that are started, unless they are told to keep it.
  int descriptor() const { return descriptor_; }

 private:
  explicit CellLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

/// Whether another process holds the lock now.
bool is_locked(const std::filesystem::path& path);

/// The mission's termination as its summary.json has it; nothing when there is none.
std::optional<std::string> termination_of(const std::filesystem::path& run);

}  // namespace gnbv
