// Views that a user gives: read line by line from a file or a pipe, and what became of them.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/run/mission_result.hpp"

namespace gnbv {

/// Reads body poses in world ENU, one a line, in one of two forms; the first line says which:
/// - CSV with a header: x, y, z (m) and either yaw_deg (0 = east, 90 = north) or qx, qy, qz, qw;
///   pitch_deg of the gimbal if wanted. Columns of views.csv beside these are passed over.
/// - TUM: `t x y z qx qy qz qw` with blanks between. The time is passed over.
/// A vehicle takes views level: of a quaternion only the heading is flown, and one that tilts the
/// body by more than 45 degrees is refused, since it will be that of a camera. Empty lines and
/// those that begin with # are none.
class ViewLines {
 public:
  /// `source` is what faults name.
  explicit ViewLines(std::filesystem::path source) : source_(std::move(source)) {}

  /// The view of the next line; nothing for a line that holds none. Throws BadInput naming source,
  /// line and value.
  std::optional<ViewPose> read(std::string_view line);

 private:
  enum class Form { unknown, csv, tum };
  ViewPose read_row(std::string_view row);

  std::filesystem::path source_;
  int line_ = 0;
  Form form_ = Form::unknown;
  std::vector<std::string> columns_;
};

/// All views of a file. Throws BadInput naming file, line and value, and for a file without a view.
std::vector<ViewPose> read_user_views(const std::filesystem::path& file);

/// Views as ViewLines reads them back, bit for bit: the header, and the rows.
constexpr std::string_view kGivenHeader = "x,y,z,yaw_deg,pitch_deg\n";
std::string given_rows(std::span<const ViewPose> views);

/// The views that a mission was given one by one (`--views -`, a planner of the user's own) before
/// its scenario.yaml had them: views.csv.part of a run that flies, or was killed; else none.
std::vector<ViewPose> views_on_the_way(const std::filesystem::path& run);

/// views.csv of a run: every given view in its order, and what became of it: `flown` as which
/// iteration, `refused` for which reason, or `left` when the mission ended before it.
std::string user_views_csv(std::span<const UserView> views);

}  // namespace gnbv
