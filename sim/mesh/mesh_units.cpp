#include "sim/mesh/mesh_units.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "sim/mesh/plain_text.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kXmlBlanks = " \t\v\f\r\n";

std::string_view without_blanks(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(kXmlBlanks), text.size()));
}

/// The number in meter="0.01"; nothing where the tag has none.
std::optional<double> meter_of(std::string_view tag) {
  constexpr std::string_view kName = "meter";
  for (auto at = tag.find(kName); at != tag.npos; at = tag.find(kName, at + 1)) {
    std::string_view rest = without_blanks(tag.substr(at + kName.size()));
    if (!rest.starts_with('=')) continue;  // it is the value of another attribute
    rest = without_blanks(rest.substr(1));
    if (!rest.starts_with('"') && !rest.starts_with('\'')) continue;
    rest = without_blanks(rest.substr(1));
    return read_decimal(rest.substr(0, rest.find_first_of(" \t\r\n\"'")));
  }
  return std::nullopt;
}

}  // namespace

DeclaredAxes declared_by_collada(std::string_view content) {
  const std::string_view asset = content.substr(0, content.find("</asset>"));
  DeclaredAxes declared = {1.0, 'y'};  // COLLADA 1.4.1: the defaults of unit and up_axis
  constexpr std::string_view kUnit = "<unit";
  if (const auto at = asset.find(kUnit); at != asset.npos) {
    const auto unit_m = meter_of(asset.substr(at, asset.find('>', at) - at));
    if (unit_m > 0.0) declared.unit_m = unit_m;
  }
  constexpr std::string_view kUp = "<up_axis>";
  if (const auto at = asset.find(kUp); at != asset.npos) {
    const std::string_view axis = without_blanks(asset.substr(at + kUp.size())).substr(0, 4);
    if (axis == "X_UP" || axis == "Y_UP" || axis == "Z_UP") {
      declared.up_axis = static_cast<char>(axis[0] - 'X' + 'x');
    }
  }
  return declared;
}

Eigen::Matrix3d R_z_up(char up) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (up == 'y') {
    R << 1, 0, 0,  //
        0, 0, -1,  //
        0, 1, 0;
  } else if (up == 'x') {
    R << 0, -1, 0,  //
        0, 0, -1,   //
        1, 0, 0;
  }
  return R;
}

Eigen::Matrix3d R_yaw(double yaw_rad) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  R.topLeftCorner<2, 2>() << c, -s, s, c;
  return R;
}

}  // namespace gnbv
