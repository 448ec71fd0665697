#include "tools/run/decision_lines.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/run_files.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

namespace {

std::size_t iteration_of(const Json& json) {
  if (json.is_object() && json.contains("iteration") && json["iteration"].is_number_unsigned()) {
    return json["iteration"].get<std::size_t>();
  }
  throw BadInput("is of no decision: iteration is no whole number from 0 on");
}

}  // namespace

LinesBefore lines_before(std::size_t iteration, const fs::path& run, const char* name) {
  LinesBefore kept;
  const auto file = RunFiles(run).find(name);
  if (!file) return kept;
  const std::string content = whole_lines(*file);
  std::string_view rest = content;
  for (int line = 1; !rest.empty(); ++line) {
    const std::string_view row = next_part(rest, '\n');
    try {
      const std::size_t of = iteration_of(Json::parse(row));
      if (of >= iteration) continue;
      kept.text.append(row) += '\n';
      kept.last_iteration = std::max(kept.last_iteration, of);
    } catch (const std::exception& error) {
      throw BadInput(fmt::format("{}: {}", to_string(TextPlace{*file, line}), json_reason(error)));
    }
  }
  return kept;
}

bool read_decision_lines(const fs::path& run, const char* name, std::size_t end,
                         std::string_view beginning,
                         const std::function<void(std::size_t, const Json&)>& take) {
  const auto file = RunFiles(run).find(name);
  if (!file) return false;
  const std::string text = whole_lines(*file);
  std::string_view rest = text;
  for (int line = 1; !rest.empty(); ++line) {
    const std::string_view row = next_part(rest, '\n');
    if (!row.starts_with(beginning)) continue;
    try {
      const Json json = Json::parse(row);
      const std::size_t iteration = iteration_of(json);
      if (iteration < end) take(iteration, json);
    } catch (const std::exception& error) {
      throw BadInput(fmt::format("{}: {}; {} writes it anew", to_string(TextPlace{*file, line}),
                                 json_reason(error), command_to_fly_again(run, "--candidates")));
    }
  }
  return !text.empty();
}

void DecisionLines::finish() const {
  std::error_code error;
  sync_to_disk(part_of(path_));
  fs::rename(part_of(path_), path_, error);
  if (error) refuse_to_write(path_, error.value());
  sync_to_disk(path_.parent_path());
}

}  // namespace gnbv
