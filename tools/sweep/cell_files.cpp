#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/sources/source_ids.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/sweep/run_cells.hpp"

namespace gnbv {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLastLines = 10;

std::vector<std::string> last_lines(const fs::path& log, std::uintmax_t begin) {
  std::error_code none;
  if (!fs::exists(log, none)) return {};
  const std::string text = read_file(log);
  std::istringstream stream(text.substr(std::min<std::size_t>(begin, text.size())));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty()) continue;
    if (lines.size() == kLastLines) lines.erase(lines.begin());
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

CellFiles cell_files(const fs::path& folder, const std::string& id) {
  const fs::path cells = folder / kCellsFolder;
  return {cells / id, cells / (id + ".part"), cells / (id + ".log"), cells / (id + ".lock"),
          cells / (id + ".failed.json")};
}

std::optional<std::string> termination_of(const fs::path& run) {
  try {
    return read_summary(run).termination;
  } catch (const BadInput&) {  // none, or one that a killed process left
    return std::nullopt;
  }
}

std::string record_failure(const Cell& cell, const CellFiles& files, const ChildEnd& end,
                           const std::vector<std::string>& command, std::uintmax_t log_begin) {
  const bool killed = end.signal != 0;
  const std::vector<std::string> lines = last_lines(files.log, log_begin);
  std::string line = end.text();
  if (!lines.empty()) line += ": " + lines.back();
  const Json record = {{"id", cell.id},
                       {"scenario", cell.scenario},
                       {"method", cell.method},
                       {"seed", cell.seed},
                       {"failure", line},
                       {"exit_code", killed ? Json(nullptr) : Json(end.exit_code)},
                       {"signal", killed ? Json(end.signal) : Json(nullptr)},
                       {"last_lines", lines},
                       {"command", command},
                       {"host", host_name()},
                       {"version", GNBV_VERSION},
                       {"source_id", flying_source_id()}};
  // what a program prints need not be UTF-8
  write_file_atomically(files.failed,
                        record.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return line;
}

std::optional<std::string> failure_of(const fs::path& failed) {
  std::string text;
  try {
    text = read_file(failed);
  } catch (const BadInput&) {
    std::error_code ignored;
    if (fs::exists(failed, ignored)) throw;
    return std::nullopt;
  }
  const auto record = Json::parse(text, nullptr, false);
  const auto line = record.is_object() ? record.find("failure") : record.end();
  if (line == record.end() || !line->is_string()) return "unreadable " + failed.string();
  return line->get<std::string>();
}

}  // namespace gnbv
