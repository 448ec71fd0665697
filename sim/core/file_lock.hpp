// A lock that processes hold on a file.
#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace gnbv {

/// An exclusive lock on a file, that the kernel releases when the last process that has it open
/// ends: a mission whose sweep was killed keeps its cell.
class FileLock {
 public:
  /// Makes the file if need be. Nothing when another holder has it; throws BadInput when the file
  /// cannot be made, or its file system knows no locks.
  static std::optional<FileLock> take(const std::filesystem::path& path);

  FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileLock();

  /// Closed in processes that are started, unless they are told to keep it.
  int descriptor() const { return descriptor_; }

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

/// Whether somebody holds the lock now.
bool is_locked(const std::filesystem::path& path);

}  // namespace gnbv
