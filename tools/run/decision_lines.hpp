// Files with a JSON object a line, each of a decision, that grow while the mission flies.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "tools/run/run_files.hpp"

namespace gnbv {

/// The whole lines of decisions whose first view comes before one.
struct LinesBefore {
  std::string text;
  std::size_t next_iteration = 1;  // of the decision after them, as far as lines of candidates tell
};

/// As an interrupted run left them. Throws as read_decision_lines().
LinesBefore lines_before(std::size_t iteration, const std::filesystem::path& run, const char* name);

using TakeDecision =
    std::function<void(std::size_t iteration, const nlohmann::ordered_json&, std::string_view row)>;

/// Hands over what each line of a run's file holds, of iterations before `end`; those alone that
/// begin with `beginning`. Returns whether there is any line. Throws BadInput naming file, line and
/// the command that writes it anew for whatever is damaged, or `take` refuses.
bool read_decision_lines(const std::filesystem::path& run, const char* name, std::size_t end,
                         std::string_view beginning, const TakeDecision& take);

/// Appends to part_of() a file, which finish() renames.
class DecisionLines {
 public:
  /// Begins with `kept`. Throws as refuse_to_write(), as all of it does.
  DecisionLines(const std::filesystem::path& file, const std::string& kept)
      : path_(file), part_(part_of(file), kept) {}
  void finish() const;

 protected:
  /// `lines` end with a line feed.
  void write_lines(const std::string& lines) { part_.write(lines); }

 private:
  std::filesystem::path path_;
  GrowingFile part_;
};

}  // namespace gnbv
