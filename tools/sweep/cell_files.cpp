#include "tools/sweep/cell_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "sim/core/error.hpp"
#include "tools/run_files/summary_json.hpp"

namespace gnbv {

namespace fs = std::filesystem;

CellFiles cell_files(const fs::path& folder, const std::string& id) {
  const fs::path cells = folder / kCellsFolder;
  return {cells / id, cells / (id + ".part"), cells / (id + ".log"), cells / (id + ".lock"),
          cells / (id + ".failed.json")};
}

std::optional<CellLock> CellLock::take(const fs::path& path) {
  CellLock lock(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (lock.descriptor_ < 0) {
    throw BadInput(fmt::format("{}: {}", path.string(), std::strerror(errno)));
  }
  // is_locked() of another process holds it for a moment: that is no reason to give up
  for (int attempt = 0; attempt < 5; ++attempt) {
    if (flock(lock.descriptor_, LOCK_EX | LOCK_NB) == 0) return lock;
    if (errno != EWOULDBLOCK && errno != EINTR) {
      throw BadInput(fmt::format("{}: cannot lock: {}", path.string(), std::strerror(errno)));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return std::nullopt;
}

CellLock::~CellLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool is_locked(const fs::path& path) {
  const int descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool is_free = flock(descriptor, LOCK_SH | LOCK_NB) == 0;
  close(descriptor);
  return !is_free;
}

std::optional<std::string> termination_of(const fs::path& run) {
  try {
    return read_summary(run).termination;
  } catch (const BadInput&) {  // none, or one that a killed process left
    return std::nullopt;
  }
}

}  // namespace gnbv
