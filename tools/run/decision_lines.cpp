#include "tools/run/decision_lines.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::size_t iteration_of(const Json& json) {
  if (json.is_object() && json.contains("iteration") && json["iteration"].is_number_unsigned()) {
    return json["iteration"].get<std::size_t>();
  }
  throw BadInput("is of no decision: iteration is no whole number from 0 on");
}

}  // namespace

LinesBefore lines_before(std::size_t iteration, const fs::path& run, const char* name) {
  LinesBefore kept;
  std::size_t last = 0;
  std::size_t chosen = 0;  // views of the last one
  read_decision_lines(run, name, iteration, "",
                      [&](std::size_t of, const Json& json, std::string_view row) {
                        kept.text.append(row) += '\n';
                        if (std::exchange(last, of) != of) chosen = 0;
                        chosen += json.value("chosen", false) ? 1 : 0;
                        kept.next_iteration = of + std::max<std::size_t>(chosen, 1);
                      });
  return kept;
}

bool read_decision_lines(const fs::path& run, const char* name, std::size_t end,
                         std::string_view beginning, const TakeDecision& take) {
  const auto file = RunFiles(run).find(name);
  if (!file) return false;
  const std::string text = whole_lines(*file);
  for_each_line(text, *file, [&](std::string_view row, const TextPlace& place) {
    if (!row.starts_with(beginning)) return;
    try {
      const Json json = Json::parse(row);
      const std::size_t iteration = iteration_of(json);
      if (iteration < end) take(iteration, json, row);
    } catch (const std::exception& error) {
      throw BadInput("{}: {}; {} writes it anew", to_string(place), json_reason(error),
                     command_to_fly_again(run, "--candidates"));
    }
  });
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
