// Content as a file, for readers that take paths.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "sim/core/error.hpp"

namespace gnbv {

/// A folder in memory where the system has one; one a process, which goes with it.
class FuzzFolder {
 public:
  FuzzFolder() {
    const std::filesystem::path memory = "/dev/shm";
    path_ = (std::filesystem::exists(memory) ? memory : std::filesystem::temp_directory_path()) /
            ("gnbv_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directories(path_);
  }
  ~FuzzFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FuzzFolder(const FuzzFolder&) = delete;
  FuzzFolder& operator=(const FuzzFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::filesystem::path written(std::string_view content, const std::string& name) {
  static const FuzzFolder folder;
  const std::filesystem::path path = folder.path() / name;
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  GNBV_CHECK(file != nullptr, "{}", path.string());
  std::fwrite(content.data(), 1, content.size(), file);
  std::fclose(file);
  return path;
}

}  // namespace gnbv
