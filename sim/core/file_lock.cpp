#include "sim/core/file_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

/// Whether the path still names the open file: who held the lock may have removed it.
bool is_still_there(int descriptor, const std::filesystem::path& path) {
  struct stat open_file {};
  struct stat named_file {};
  return fstat(descriptor, &open_file) == 0 && stat(path.c_str(), &named_file) == 0 &&
         open_file.st_dev == named_file.st_dev && open_file.st_ino == named_file.st_ino;
}

}  // namespace

std::optional<FileLock> FileLock::take(const std::filesystem::path& path) {
  // is_locked() of another process holds it for a moment: that is no reason to give up
  for (int attempt = 0; attempt < 5; ++attempt) {
    FileLock lock(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (lock.descriptor_ < 0) refuse_to_write(path, errno);
    if (flock(lock.descriptor_, LOCK_EX | LOCK_NB) == 0) {
      if (is_still_there(lock.descriptor_, path)) return lock;
      continue;
    }
    if (errno != EWOULDBLOCK && errno != EINTR) {
      throw BadInput(fmt::format("{}: cannot lock: {}", path.string(), std::strerror(errno)));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return std::nullopt;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool is_locked(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool is_free = flock(descriptor, LOCK_SH | LOCK_NB) == 0;
  close(descriptor);
  return !is_free;
}

}  // namespace gnbv
