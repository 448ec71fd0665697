#include "tools/sweep/cell_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {

namespace fs = std::filesystem;

CellFiles cell_files(const fs::path& folder, const std::string& id) {
  const fs::path cells = folder / "cells";
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
  std::error_code ignored;
  if (!fs::exists(run / "summary.json", ignored)) return std::nullopt;
  const auto summary = nlohmann::json::parse(read_file(run / "summary.json"), nullptr, false);
  const auto value = summary.is_object() ? summary.find("termination") : summary.end();
  if (value == summary.end() || !value->is_string()) return std::nullopt;
  return value->get<std::string>();
}

}  // namespace gnbv
