#include "tools/run/decision_lines.hpp"

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {

namespace fs = std::filesystem;

LinesBefore lines_before(std::size_t iteration, const fs::path& file) {
  const fs::path path = fs::exists(part_of(file)) ? part_of(file) : file;
  LinesBefore kept;
  if (!fs::exists(path)) return kept;
  const std::string content = read_file(path);
  std::string_view rest(content.data(), content.rfind('\n') + 1);  // npos + 1: none
  for (int line = 1; !rest.empty(); ++line) {
    const std::string_view row = next_part(rest, '\n');
    const auto json = nlohmann::json::parse(row, nullptr, false);
    const bool is_ours =
        json.is_object() && json.contains("iteration") && json["iteration"].is_number_unsigned();
    if (!is_ours) {
      throw BadInput(fmt::format("{}: is of no decision", to_string(TextPlace{path, line})));
    }
    const auto of = json["iteration"].get<std::size_t>();
    if (of >= iteration) continue;
    kept.text.append(row) += '\n';
    kept.last_iteration = std::max(kept.last_iteration, of);
  }
  return kept;
}

DecisionLines::DecisionLines(const fs::path& file, const std::string& kept) : path_(file) {
  write_file_atomically(part_of(path_), kept);
  part_.open(part_of(path_), std::ios::binary | std::ios::app);
  if (!part_) refuse_to_write(part_of(path_), errno);
}

void DecisionLines::write(const std::string& lines) {
  part_ << lines;
  part_.flush();
  if (!part_) refuse_to_write(part_of(path_), errno);
}

void DecisionLines::finish() {
  part_.close();
  std::error_code error;
  sync_to_disk(part_of(path_));
  fs::rename(part_of(path_), path_, error);
  if (error) refuse_to_write(path_, error.value());
  sync_to_disk(path_.parent_path());
}

}  // namespace gnbv
