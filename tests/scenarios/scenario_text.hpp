// Scenarios from a text at hand, and what loading them complains about.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scenarios/load.hpp"
#include "tests/support/fault.hpp"

namespace gnbv {

/// A file in a folder of its own, gone when the object is.
class ScenarioFile {
 public:
  explicit ScenarioFile(const std::string& text) {
    static int count = 0;
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("gnbv_scenario_{}_{}", getpid(), count++);
    std::filesystem::create_directories(folder_);
    std::ofstream(path()) << text;
  }
  ~ScenarioFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  ScenarioFile(const ScenarioFile&) = delete;
  ScenarioFile& operator=(const ScenarioFile&) = delete;

  std::filesystem::path path() const { return folder_ / "s.yaml"; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// The smallest scenario that loads: everything else is at its default.
inline const std::string kMinimal = "cameras: [{}]\n";

inline Scenario load_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const ScenarioFile file(text);
  return load_scenario(file.path().string(), overrides);
}

/// The complaint, with the file's path cut down to "s.yaml"; empty when it loads.
inline std::string complaint(const std::string& text,
                             const std::vector<std::string>& overrides = {}) {
  const ScenarioFile file(text);
  std::string message = test::fault_of([&] { load_scenario(file.path().string(), overrides); });
  const std::string folder = file.folder().string() + '/';
  for (std::size_t at = message.find(folder); at != std::string::npos; at = message.find(folder)) {
    message.erase(at, folder.size());
  }
  return message;
}

}  // namespace gnbv
