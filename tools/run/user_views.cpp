#include "tools/run/user_views.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scenarios/values.hpp"
#include "sim/core/error.hpp"
#include "tools/run/run_files.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxTilt_rad = deg_to_rad(45.0);
const std::vector<std::string> kTumColumns = {"t", "x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr std::array<std::string_view, 5> kPassedOver = {"t", "view", "result", "reason",
                                                         "iteration"};
/// What a view is made of, and how far from 0 each may be: x, y, z as planner.routes.views allows.
const std::map<std::string, double, std::less<>> kLimits = {
    {"x", 1e6},  {"y", 1e6},  {"z", 1e6},  {"yaw_deg", 360.0}, {"pitch_deg", 90.0},
    {"qx", 1e9}, {"qy", 1e9}, {"qz", 1e9}, {"qw", 1e9}};

bool is_passed_over(std::string_view name) {
  return std::ranges::find(kPassedOver, name) != kPassedOver.end();
}

std::vector<std::string> cells_of(std::string_view row, bool is_csv) {
  std::vector<std::string> cells;
  for (const std::string_view part : split(row, is_csv ? ',' : ' ')) {
    const std::string_view cell = trimmed(part);
    if (is_csv || !cell.empty()) cells.emplace_back(cell);
  }
  return cells;
}

/// Throws BadInput for a header that does not say where each view is and where it looks.
void need_columns(const std::vector<std::string>& columns, const TextPlace& place) {
  const auto fail = [&](const std::string& what) {
    throw BadInput(
        "{}: {}; a header is x,y,z,yaw_deg or x,y,z,qx,qy,qz,qw, in any order, with pitch_deg "
        "where the cameras hang on a gimbal",
        to_string(place), what);
  };
  const auto count = [&](std::string_view name) {
    return std::count(columns.begin(), columns.end(), name);
  };
  for (const std::string& column : columns) {
    if (!kLimits.contains(column) && !is_passed_over(column)) {
      fail(fmt::format("column `{}` is not known", column));
    }
    if (count(column) > 1) fail(fmt::format("column `{}` stands twice", column));
  }
  for (const std::string_view name : {"x", "y", "z"}) {
    if (count(name) == 0) fail(fmt::format("has no column `{}`", name));
  }
  const auto turns = count("qx") + count("qy") + count("qz") + count("qw");
  if (count("yaw_deg") + turns == 0) fail("says nowhere where a view looks");
  if (count("yaw_deg") == 1 && turns > 0) fail("has yaw_deg and a quaternion");
  if (count("yaw_deg") == 0 && turns != 4) fail("has only a part of qx,qy,qz,qw");
}

double to_number_within(std::string_view text, const TextPlace& place, const std::string& name) {
  const double value = to_number(text, place, name);
  const double limit = kLimits.at(name);
  if (std::abs(value) <= limit) return value;
  throw BadInput("{}: {} `{}` is out of range (allowed: from {} to {})", to_string(place), name,
                 trimmed(text), -limit, limit);
}

/// As scenario.yaml will hold it, so that the same bits come back from there.
double heading_rad(const Isometry& T_world_body, const TextPlace& place) {
  const double tilt_rad = std::acos(std::clamp(T_world_body.linear()(2, 2), -1.0, 1.0));
  if (tilt_rad > kMaxTilt_rad) {
    throw BadInput(
        "{}: qx qy qz qw tilt the body by {:.0f} degrees, and views are taken level: a pose has to "
        "be that of the body (x forward, y left, z up), not of a camera (z forward)",
        to_string(place), rad_to_deg(tilt_rad));
  }
  return written_angle_rad(yaw_of(T_world_body));
}

}  // namespace

std::optional<ViewPose> ViewLines::read(std::string_view line) {
  ++line_;
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (line_ == 1 && line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
  const std::string_view row = trimmed(line);
  if (row.empty() || row.front() == '#') return std::nullopt;
  if (form_ != Form::unknown) return read_row(row);
  const bool is_header = row.find(',') != std::string_view::npos;
  if (!is_header) {
    columns_ = kTumColumns;
    form_ = Form::tum;
    try {
      return read_row(row);
    } catch (const BadInput&) {
      form_ = Form::unknown;  // a first line that is no view says nothing of those to come
      throw;
    }
  }
  columns_ = cells_of(row, true);
  need_columns(columns_, {source_, line_});
  form_ = Form::csv;
  return std::nullopt;
}

ViewPose ViewLines::read_row(std::string_view row) {
  const TextPlace place{source_, line_};
  const std::vector<std::string> cells = cells_of(row, form_ == Form::csv);
  if (cells.size() != columns_.size()) {
    throw BadInput("{}: `{}` has {} values, not {}: {}", to_string(place), row, cells.size(),
                   columns_.size(), fmt::join(columns_, form_ == Form::csv ? "," : " "));
  }
  std::map<std::string, double> of;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string& name = columns_[i];
    if (kLimits.contains(name)) {
      of[name] = to_number_within(cells[i], place, name);
    } else if (form_ == Form::tum) {
      to_number(cells[i], place, name);
    }
  }
  ViewPose view{.p_world_m = Vec3(of["x"], of["y"], of["z"])};
  view.gimbal_pitch_rad = deg_to_rad(of["pitch_deg"]);
  if (of.contains("qx")) {
    const std::array<double, 7> pose = {of["x"],  of["y"],  of["z"], of["qx"],
                                        of["qy"], of["qz"], of["qw"]};
    view.yaw_rad = heading_rad(to_pose(pose, place), place);
  } else {
    view.yaw_rad = deg_to_rad(of["yaw_deg"]);
  }
  return view;
}

std::vector<ViewPose> read_user_views(const fs::path& file) {
  ViewLines lines(file);
  std::vector<ViewPose> views;
  for_each_line(whole_lines(file), file, [&](std::string_view line, const TextPlace&) {
    if (const auto view = lines.read(line)) views.push_back(*view);
  });
  if (views.empty()) throw BadInput("{}: holds no view", file.string());
  return views;
}

std::string given_rows(std::span<const ViewPose> views) {
  std::string rows;
  for (const ViewPose& view : views) {
    const Vec3& p = view.p_world_m;
    rows += fmt::format("{},{},{},{},{}\n", p.x(), p.y(), p.z(), degrees_of(view.yaw_rad),
                        degrees_of(view.gimbal_pitch_rad));
  }
  return rows;
}

std::vector<ViewPose> views_on_the_way(const fs::path& run) {
  const fs::path part = part_of(run / kViewsFile);
  return fs::exists(part) ? read_user_views(part) : std::vector<ViewPose>{};
}

std::string user_views_csv(std::span<const UserView> views) {
  std::string csv = "view,x,y,z,yaw_deg,pitch_deg,result,reason,iteration\n";
  for (std::size_t i = 0; i < views.size(); ++i) {
    const UserView& given = views[i];
    std::string pose = given_rows({&given.view, 1});
    pose.pop_back();
    csv += fmt::format("{},{},{},{},{}\n", i, pose,
                       given.rejected    ? "refused"
                       : given.iteration ? "flown"
                                         : "left",
                       given.rejected ? name_of(*given.rejected) : "",
                       given.iteration ? fmt::format("{}", *given.iteration) : "");
  }
  return csv;
}

}  // namespace gnbv
