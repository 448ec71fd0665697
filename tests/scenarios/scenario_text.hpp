// Scenarios from a text at hand, and what loading them complains about.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/load.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {

/// A file in a folder of its own, gone when the object is.
class ScenarioFile {
 public:
  explicit ScenarioFile(const std::string& text) { folder_.write("s.yaml", text); }
  std::filesystem::path path() const { return folder_.path() / "s.yaml"; }
  const TempFolder& folder() const { return folder_; }

 private:
  TempFolder folder_;
};

/// The smallest scenario that loads: everything else is at its default.
inline const std::string kMinimal = "cameras: [{}]\n";

inline Scenario load_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const ScenarioFile file(text);
  return load_scenario(file.path().string(), overrides);
}

/// Whether it reads back from its own text as the same.
inline bool repeats(const Scenario& scenario) {
  const std::string yaml = to_yaml(scenario);
  return to_yaml(load_text(yaml)) == yaml;
}

/// The complaint, with the file's path cut down to "s.yaml"; empty when it loads.
inline std::string complaint(const std::string& text,
                             const std::vector<std::string>& overrides = {}) {
  const ScenarioFile file(text);
  return file.folder().without_path(
      test::fault_of([&] { load_scenario(file.path().string(), overrides); }));
}

}  // namespace gnbv
