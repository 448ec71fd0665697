// Content as a file, for readers that take paths.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "sim/core/error.hpp"

namespace gnbv {

/// A folder in memory where the system has one; one a process.
inline std::filesystem::path fuzz_folder() {
  const std::filesystem::path memory = "/dev/shm";
  const std::filesystem::path folder =
      (std::filesystem::exists(memory) ? memory : std::filesystem::temp_directory_path()) /
      ("gnbv_fuzz_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::filesystem::path written(std::string_view content, const std::string& name) {
  static const std::filesystem::path folder = fuzz_folder();
  const std::filesystem::path path = folder / name;
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  GNBV_CHECK(file != nullptr, "{}", path.string());
  std::fwrite(content.data(), 1, content.size(), file);
  std::fclose(file);
  return path;
}

}  // namespace gnbv
