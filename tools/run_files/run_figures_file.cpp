#include "tools/run_files/run_figures_file.hpp"

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/shell_word.hpp"
#include "tools/run_files/summary_file.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// A file of JSON whose values are named by pointers: "/coverage/final/0.05".
class Summary {
 public:
  Summary(const fs::path& path, const std::string& text)
      : path_(path), json_(Json::parse(text, nullptr, false)) {
    if (!json_.is_object()) throw BadInput(fmt::format("{}: is no JSON object", path.string()));
  }

  double number(const std::string& pointer) const {
    const Json& value = at(pointer);
    if (!value.is_number()) refuse(pointer, value, "is no number");
    return value.get<double>();
  }
  std::uint64_t count(const std::string& pointer) const {
    const Json& value = at(pointer);
    if (!value.is_number_unsigned()) refuse(pointer, value, "is no count");
    return value.get<std::uint64_t>();
  }
  std::string text(const std::string& pointer) const {
    const Json& value = at(pointer);
    if (!value.is_string()) refuse(pointer, value, "is no text");
    return value.get<std::string>();
  }
  std::array<double, 3> by_size(const std::string& pointer) const {
    return {number(pointer + "/0.05"), number(pointer + "/0.10"), number(pointer + "/0.50")};
  }

 private:
  const Json& at(const std::string& pointer) const {
    const Json::json_pointer where(pointer);
    if (!json_.contains(where)) {
      throw BadInput(fmt::format("{}: {}: is missing", path_.string(), pointer));
    }
    return json_.at(where);
  }
  [[noreturn]] void refuse(const std::string& pointer, const Json& value, const char* what) const {
    throw BadInput(fmt::format("{}: {}: {} {}", path_.string(), pointer, value.dump(), what));
  }

  fs::path path_;
  Json json_;
};

CloudDistances distances_of(const Summary& summary) {
  CloudDistances distances;
  for (std::size_t i = 0; i < distances.at.size(); ++i) {
    const std::string entry = fmt::format("/precision_recall/{}", i);
    distances.at[i] = {summary.number(entry + "/distance_m"), summary.number(entry + "/precision"),
                       summary.number(entry + "/recall"), summary.number(entry + "/f")};
  }
  distances.accuracy_m = summary.number("/accuracy_m");
  distances.completeness_m = summary.number("/completeness_m");
  distances.chamfer_m = summary.number("/chamfer_m");
  return distances;
}

/// The row's numbers after its view.
std::array<double, 5> row_of(const std::string& text, std::size_t view, const std::string& where) {
  std::array<double, 6> values{};
  const char* next = text.c_str();
  for (std::size_t i = 0; i < values.size(); ++i) {
    char* end = nullptr;
    values[i] = std::strtod(next, &end);
    const char expected = i + 1 < values.size() ? ',' : '\0';
    if (end == next || *end != expected || !std::isfinite(values[i])) {
      throw BadInput(fmt::format("{}: '{}' is no row of 6 numbers", where, text));
    }
    next = end + 1;
  }
  if (values[0] != static_cast<double>(view)) {
    throw BadInput(fmt::format("{}: view {} must be {}", where, values[0], view));
  }
  return {values[1], values[2], values[3], values[4], values[5]};
}

CoverageCurve read_curve(const fs::path& path) {
  const std::string content = read_file(path);
  CoverageCurve curve;
  std::size_t line = 0;
  for (std::size_t begin = 0; begin < content.size();) {
    const std::size_t end = std::min(content.find('\n', begin), content.size());
    const std::string text = content.substr(begin, end - begin);
    begin = end + 1;
    const std::string where = fmt::format("{}:{}", path.string(), ++line);
    if (line == 1) {
      if (text != kCoverageCsvHeader) {
        throw BadInput(fmt::format("{}: is not the header that this version writes", where));
      }
      continue;
    }
    const auto [metres, seconds, fine, middle, coarse] = row_of(text, line - 2, where);
    curve.metres.push_back(metres);
    curve.seconds.push_back(seconds);
    curve.coverage.push_back({fine, middle, coarse});
  }
  return curve;
}

}  // namespace

RunFigures read_run_figures(const fs::path& run) {
  const fs::path path = run / "summary.json";
  const Summary summary(path, read_summary(run));
  const std::uint64_t schema = summary.count("/schema");
  if (schema != kSummarySchema) {
    throw BadInput(
        fmt::format("{}: schema {} of another version; `gnbv score {} --update` scores "
                    "the run anew and makes it {}",
                    path.string(), schema, shell_word(run.string()), kSummarySchema));
  }
  RunFigures figures{
      .scenario = summary.text("/scenario"),
      .structure = summary.text("/structure"),
      .utility = summary.text("/utility"),
      .preset = summary.text("/preset"),
      .seed = summary.count("/seed"),
      .version = summary.text("/version"),
      .termination = summary.text("/termination"),
      .result_sha256 = summary.text("/result_sha256"),
      .iterations = static_cast<int>(summary.count("/iterations")),
      .entropy_reduction_nat = summary.number("/entropy_nat/reduction"),
      .straight_m = summary.number("/distance_m/straight"),
      .flown_m = summary.number("/distance_m/flown"),
      .profile_m = summary.number("/distance_m/profile"),
      .flight_time_s = summary.number("/flight_time_s"),
      .energy_wh = summary.number("/energy_wh"),
      .coverage_final = summary.by_size("/coverage/final"),
      .coverage_profile = summary.by_size("/coverage/profile"),
      .coverage_final_raw = summary.by_size("/coverage/final_raw_reference"),
      .coverage_profile_raw = summary.by_size("/coverage/profile_raw_reference"),
      .density_points_per_voxel = summary.number("/density_points_per_voxel"),
      .distances = distances_of(summary),
      .density = {.voxel_m = summary.number("/density/voxel_m"),
                  .mean_points = summary.number("/density/mean_points"),
                  .variation = summary.number("/density/variation")},
      .curve = read_curve(run / "coverage.csv"),
      .wall_s = summary.number("/wall_s/total"),
  };
  if (figures.curve.coverage.size() != static_cast<std::size_t>(figures.iterations) + 1) {
    throw BadInput(fmt::format("{}: {} rows for the profile and {} views",
                               (run / "coverage.csv").string(), figures.curve.coverage.size(),
                               figures.iterations));
  }
  return figures;
}

}  // namespace gnbv
