// Units and up axes of mesh files.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

namespace gnbv {

/// What a file says about its coordinates; nothing where it and its format are silent.
struct DeclaredAxes {
  std::optional<double> unit_m;
  std::optional<char> up_axis;  // x, y or z
};

/// Of a COLLADA text, which by specification is in metres with y up where it is silent.
DeclaredAxes declared_by_collada(std::string_view content);

/// Turns the axis `up` (x, y or z) to z; the right-handed turns of COLLADA 1.4's up_axis table.
Eigen::Matrix3d R_z_up(char up);

/// Turns about z, counter-clockwise seen from above.
Eigen::Matrix3d R_yaw(double yaw_rad);

}  // namespace gnbv
