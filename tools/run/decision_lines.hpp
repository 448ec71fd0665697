// Files with a JSON object a line, each of a decision, that grow while the mission flies.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace gnbv {

/// The whole lines of decisions before one.
struct LinesBefore {
  std::string text;
  std::size_t last_iteration = 0;  // 0: there are none
};

/// As an interrupted run left them in the file or, while it is written, in part_of() it. Throws
/// BadInput naming file and line of what has no `iteration`.
LinesBefore lines_before(std::size_t iteration, const std::filesystem::path& file);

/// Appends to part_of() a file, which finish() renames.
class DecisionLines {
 public:
  /// Begins with `kept`. Throws as refuse_to_write(), as all of it does.
  DecisionLines(const std::filesystem::path& file, const std::string& kept);

  /// `lines` end with a line feed.
  void write(const std::string& lines);
  void finish();

 private:
  std::filesystem::path path_;
  std::ofstream part_;
};

}  // namespace gnbv
