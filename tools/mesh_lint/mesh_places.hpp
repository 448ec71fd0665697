// Sizes and places of meshes that the findings and the advice agree on.
#pragma once

#include <array>
#include <string_view>

#include "tools/mesh_lint/mesh_report.hpp"

namespace gnbv {

struct Unit {
  std::string_view name;
  double unit_m;
};
constexpr std::array kUnits = {Unit{"millimetres", 0.001}, Unit{"centimetres", 0.01},
                               Unit{"inches", 0.0254}, Unit{"feet", 0.3048}, Unit{"metres", 1.0}};

/// Neither a toy nor a town.
constexpr double kSmallest_m = 0.2;
constexpr double kLargest_m = 500.0;
inline bool is_likely_size(double largest_m) {
  return largest_m >= kSmallest_m && largest_m <= kLargest_m;
}

/// The ground that the sensors see ends there.
constexpr double kGroundReach_m = 1000.0;
/// OctoMap's keys end there.
double reach_m(const Scenario& scenario);
double farthest_m(const Box3& box_m);

/// How far it may sink below the ground, or float above it, without remark.
double may_sink_m(const Box3& box_m);
double may_float_m(const Box3& box_m);
inline bool stands_on_ground(const Box3& box_m) {
  return box_m.min().z() >= -may_sink_m(box_m) && box_m.min().z() <= may_float_m(box_m);
}

/// Share of the sound faces' area that lies below z_m.
double share_below(const MeshLint& lint, const TriangleMesh& mesh, double z_m);

/// The mesh in the axes of its file, metres.
TriangleMesh in_file_axes(const MeshReport& report, const Scenario& scenario);

/// The sound faces alone, which is what a mission flies around.
TriangleMesh sound_part(const TriangleMesh& mesh, const MeshLint& lint);

}  // namespace gnbv
