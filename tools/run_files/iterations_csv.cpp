#include "tools/run_files/iterations_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/shell_word.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kHeader =
    "iteration,x,y,z,yaw,sampler,scale,candidates,valid,utility,information,density_term,"
    "prediction,distance_factor,entropy_nat,density_points_per_voxel,cloud_points,straight_m,"
    "flown_m,time_s,wall_sense_s,wall_map_s,wall_plan_s,wall_fly_s,via";
constexpr std::size_t kColumns = 25;

/// The samplers a row may name, with storage that outlives every Decision.
constexpr std::array<std::string_view, 5> kSamplers = {"start", "agvs", "fvs", "route", "oracle"};

/// One row's cells, read left to right.
class Row {
 public:
  Row(const std::filesystem::path& csv, std::size_t line, const std::string& text)
      : csv_(csv), line_(line) {
    std::istringstream in(text);
    for (std::string cell; std::getline(in, cell, ',');) cells_.push_back(cell);
    if (text.ends_with(',')) cells_.emplace_back();
    if (cells_.size() != kColumns) fail(text, fmt::format("must have {} columns", kColumns));
  }

  const std::string& text() { return cells_[next_++]; }
  double number() { return number_in(text()); }
  int count() {
    const double value = number();
    if (value < 0.0 || value > 1e9 || value != std::floor(value)) {
      fail(fmt::format("{}", value), "is not a count");
    }
    return static_cast<int>(value);
  }
  void skip(std::size_t cells) { next_ += cells; }
  /// Points as "x:y:z;x:y:z"; none when the cell is empty.
  std::vector<Vec3> points() {
    const std::string& cell = text();
    std::vector<Vec3> points;
    std::istringstream in(cell);
    for (std::string point; std::getline(in, point, ';');) {
      std::istringstream coordinates(point);
      std::vector<double> values;
      for (std::string value; std::getline(coordinates, value, ':');) {
        values.push_back(number_in(value));
      }
      if (values.size() != 3) fail(cell, "is no list of x:y:z");
      points.emplace_back(values[0], values[1], values[2]);
    }
    return points;
  }
  void expect_iteration(std::size_t expected) {
    const int iteration = count();
    if (static_cast<std::size_t>(iteration) != expected) {
      fail(fmt::format("{}", iteration), fmt::format("must be iteration {}", expected));
    }
  }
  std::string_view sampler() {
    const std::string& cell = text();
    const auto* const known = std::find(kSamplers.begin(), kSamplers.end(), cell);
    if (known == kSamplers.end()) fail(cell, "is no sampler");
    return *known;
  }

 private:
  double number_in(const std::string& cell) const {
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    if (cell.empty() || *end != '\0' || !std::isfinite(value)) fail(cell, "is not a number");
    return value;
  }
  [[noreturn]] void fail(const std::string& value, const std::string& what) const {
    throw BadInput(fmt::format("{}:{}: '{}' {}", csv_.string(), line_, value, what));
  }

  const std::filesystem::path& csv_;
  std::size_t line_;
  std::vector<std::string> cells_;
  std::size_t next_ = 0;
};

ViewRecord record_of(Row row, std::size_t iteration) {
  row.expect_iteration(iteration);
  ViewRecord view{.iteration = static_cast<int>(iteration)};
  Decision& d = view.decision;
  d.view.p_world_m.x() = row.number();
  d.view.p_world_m.y() = row.number();
  d.view.p_world_m.z() = row.number();
  d.view.yaw_rad = row.number();
  d.sampler = row.sampler();
  d.scale = row.number();
  d.candidates = row.count();
  d.valid = row.count();
  d.score.value = row.number();
  d.score.information = row.number();
  d.score.density = row.number();
  d.score.prediction = row.number();
  d.score.distance = row.number();
  view.entropy_nat = row.number();
  view.density_points_per_voxel = row.number();
  view.cloud_points = static_cast<std::size_t>(row.count());
  view.straight_m = row.number();
  view.flown_m = row.number();
  view.time_s = row.number();
  constexpr std::size_t kWallTimes = 4;
  row.skip(kWallTimes);
  d.via_world_m = row.points();
  return view;
}

}  // namespace

std::string iterations_csv_header() { return fmt::format("{}\n", kHeader); }

std::string iterations_csv_row(const ViewRecord& view) {
  const Decision& d = view.decision;
  const Vec3& p = d.view.p_world_m;
  std::string via;
  for (const Vec3& via_m : d.via_world_m) {
    via += fmt::format("{}{}:{}:{}", via.empty() ? "" : ";", via_m.x(), via_m.y(), via_m.z());
  }
  return fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{:.6f},{:.6f},"
      "{:.6f},{:.6f},{}\n",
      view.iteration, p.x(), p.y(), p.z(), d.view.yaw_rad, d.sampler, d.scale, d.candidates,
      d.valid, d.score.value, d.score.information, d.score.density, d.score.prediction,
      d.score.distance, view.entropy_nat, view.density_points_per_voxel, view.cloud_points,
      view.straight_m, view.flown_m, view.time_s, view.wall.sense_s, view.wall.map_s,
      view.wall.plan_s, view.wall.fly_s, via);
}

std::vector<ViewRecord> read_view_records(const std::filesystem::path& csv) {
  const std::string content = read_file(csv);
  std::vector<ViewRecord> views;
  std::size_t line = 0;
  for (std::size_t begin = 0; begin < content.size();) {
    const std::size_t end = content.find('\n', begin);
    if (end == std::string::npos) break;
    const std::string text = content.substr(begin, end - begin);
    begin = end + 1;
    if (++line > 1) {
      views.push_back(record_of(Row(csv, line, text), line - 2));
    } else if (text != kHeader) {
      throw BadInput(
          fmt::format("{}:1: is not the header that this version writes: of another version, and "
                      "`gnbv run {} --out NEW` flies its mission again",
                      csv.string(), shell_word((csv.parent_path() / "scenario.yaml").string())));
    }
  }
  return views;
}

std::vector<Decision> read_decisions(const std::filesystem::path& csv) {
  std::vector<Decision> decisions;
  for (ViewRecord& view : read_view_records(csv)) decisions.push_back(std::move(view.decision));
  return decisions;
}

std::vector<ViewMark> read_view_marks(const std::filesystem::path& csv) {
  std::vector<ViewMark> marks;
  for (const ViewRecord& view : read_view_records(csv)) {
    marks.push_back({view.cloud_points, view.straight_m, view.time_s});
  }
  return marks;
}

}  // namespace gnbv
