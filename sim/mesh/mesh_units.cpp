#include "sim/mesh/mesh_units.hpp"

#include <cstdlib>
#include <regex>

namespace gnbv {

DeclaredAxes declared_by_collada(const std::string& content) {
  const std::string asset = content.substr(0, content.find("</asset>"));
  static const std::regex kUnit(R"re(<unit\s[^>]*meter\s*=\s*["']\s*([^"']+)["'])re");
  static const std::regex kUp(R"(<up_axis>\s*([XYZ])_UP)");
  DeclaredAxes declared = {1.0, 'y'};  // COLLADA 1.4.1: the defaults of unit and up_axis
  std::smatch match;
  if (std::regex_search(asset, match, kUnit)) {
    const double unit_m = std::strtod(match[1].str().c_str(), nullptr);
    if (unit_m > 0.0) declared.unit_m = unit_m;
  }
  if (std::regex_search(asset, match, kUp)) {
    declared.up_axis = static_cast<char>(match[1].str()[0] - 'X' + 'x');
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

}  // namespace gnbv
