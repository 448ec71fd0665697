// Which file of a run directory says how the run stands: the one door to them, whoever writes into
// the directory meanwhile.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "tools/run/file_names.hpp"

namespace gnbv {

/// A run directory as it stood when this was made. What a mission has so far is in files that grow
/// (iterations.csv.part, candidates.jsonl.part); where it was resumed, those of its earlier end lie
/// beside them.
class RunFiles {
 public:
  explicit RunFiles(std::filesystem::path folder);

  /// Whether it has flown views that no end of it has told of yet.
  bool goes_on() const { return goes_on_; }

  /// The file of that name, one of file_names.hpp: the one that grows rather than that of an
  /// earlier end, and nothing of what is written at the end alone while the run goes on.
  std::optional<std::filesystem::path> find(std::string_view name) const;

  /// Whether all is there of a run that ended by itself: there is nothing to resume.
  bool is_finished() const;

 private:
  std::filesystem::path folder_;
  bool goes_on_ = false;
};

/// The text of a file; of one that grows without a last line that has no end: it is being written,
/// or who wrote it was killed.
std::string whole_lines(const std::filesystem::path& file);

/// A file that grows. What is written is there at once, and stays when this process is killed.
class GrowingFile {
 public:
  /// Takes the place of any file of that name, and begins with the text. Throws as
  /// refuse_to_write(), as write() does.
  GrowingFile(std::filesystem::path path, std::string_view text);
  void write(std::string_view text);

 private:
  std::filesystem::path path_;
  std::ofstream file_;
};

/// `gnbv run FOLDER/scenario.yaml OPTIONS --resume --out FOLDER`, keeping what the run in the
/// folder keeps.
std::string command_to_resume(const std::filesystem::path& folder, const std::string& options = "");

/// `gnbv run FOLDER/scenario.yaml OPTIONS --out NEW`: flies the same mission once more.
std::string command_to_fly_again(const std::filesystem::path& folder,
                                 const std::string& options = "");

}  // namespace gnbv
