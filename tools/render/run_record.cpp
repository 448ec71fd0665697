#include "tools/render/run_record.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

std::string read_run_file(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    throw BadInput(fmt::format(
        "{}: no such file; `gnbv run` writes it, so name the directory of a run", path.string()));
  }
  return read_file(path);
}

// Cuts off and returns the part before the next `separator`.
std::string_view next_part(std::string_view& rest, char separator) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return part;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

double to_number(std::string_view text, const std::filesystem::path& path, int line,
                 std::string_view what) {
  const std::string_view t = trimmed(text);
  double value = 0.0;
  const auto [end, error] = std::from_chars(t.data(), t.data() + t.size(), value);
  if (error != std::errc{} || end != t.data() + t.size() || !std::isfinite(value)) {
    throw BadInput(fmt::format("{}:{}: {} `{}` is not a number", path.string(), line, what, t));
  }
  return value;
}

std::vector<PathSample> read_path(const std::filesystem::path& path) {
  const std::string text = read_run_file(path);
  std::string_view rest = text;
  std::vector<PathSample> samples;
  for (int line = 1; !rest.empty(); ++line) {
    std::string_view row = trimmed(next_part(rest, '\n'));
    if (row.empty() || row.front() == '#') continue;
    std::array<double, 8> values{};  // time x y z qx qy qz qw
    for (double& value : values) {
      value = to_number(next_part(row, ' '), path, line, "one of the 8 values");
      row = trimmed(row);
    }
    if (!row.empty()) {
      throw BadInput(fmt::format("{}:{}: more than 8 values", path.string(), line));
    }
    if (!samples.empty() && values[0] < samples.back().time_s) {
      throw BadInput(fmt::format("{}:{}: time {} s goes back", path.string(), line, values[0]));
    }
    samples.push_back({values[0], Vec3(values[1], values[2], values[3])});
  }
  if (samples.empty()) throw BadInput(fmt::format("{}: holds no pose", path.string()));
  return samples;
}

std::vector<ViewPose> read_views(const std::filesystem::path& path) {
  const std::string text = read_run_file(path);
  std::string_view rest = text;
  constexpr std::array<std::string_view, 4> kWanted = {"x", "y", "z", "yaw"};
  std::array<int, 4> columns = {-1, -1, -1, -1};
  std::string_view header = next_part(rest, '\n');
  for (int column = 0; !header.empty(); ++column) {
    const std::string_view name = trimmed(next_part(header, ','));
    for (std::size_t k = 0; k < 4; ++k) {
      if (name == kWanted[k]) columns[k] = column;
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (columns[k] < 0) {
      throw BadInput(fmt::format("{}:1: no column `{}`", path.string(), kWanted[k]));
    }
  }
  std::vector<ViewPose> views;
  for (int line = 2; !rest.empty(); ++line) {
    std::string_view row = trimmed(next_part(rest, '\n'));
    if (row.empty()) continue;
    std::vector<std::string_view> cells;
    while (!row.empty()) cells.push_back(next_part(row, ','));
    std::array<double, 4> values{};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto column = static_cast<std::size_t>(columns[k]);
      values[k] = to_number(column < cells.size() ? cells[column] : "", path, line, kWanted[k]);
    }
    views.push_back({Vec3(values[0], values[1], values[2]), values[3]});
  }
  return views;
}

void read_summary(const std::filesystem::path& path, RunRecord& record) {
  if (!std::filesystem::exists(path)) return;
  try {
    const nlohmann::json summary = nlohmann::json::parse(read_file(path));
    if (summary.contains("views_begin_s")) {
      record.views_begin_s = summary.at("views_begin_s").get<double>();
    }
    for (const char* key : {"scenario", "utility"}) {
      if (!summary.contains(key)) continue;
      record.title += (record.title.empty() ? "" : ", ") + summary.at(key).get<std::string>();
    }
    std::vector<std::string> figures;
    if (summary.contains("iterations")) {
      figures.push_back(fmt::format("{} views", summary.at("iterations").get<int>()));
    }
    if (summary.contains("distance_m") && summary.at("distance_m").contains("flown")) {
      figures.push_back(
          fmt::format("{:.1f} m", summary.at("distance_m").at("flown").get<double>()));
    }
    const auto coverage = nlohmann::json::json_pointer("/coverage/final/0.05");
    if (summary.contains(coverage)) {
      figures.push_back(
          fmt::format("coverage {:.1f} % at 0.05 m", 100.0 * summary.at(coverage).get<double>()));
    }
    record.detail = fmt::format("{}", fmt::join(figures, ", "));
  } catch (const nlohmann::json::exception& error) {
    throw BadInput(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace

RunRecord read_run(const std::filesystem::path& run_dir) {
  RunRecord record;
  record.path = read_path(run_dir / "trajectory.tum");
  record.views = read_views(run_dir / "iterations.csv");
  read_summary(run_dir / "summary.json", record);
  return record;
}

}  // namespace gnbv
