#include "tools/mission/auto_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "planner/view_validity.hpp"
#include "scenarios/problems.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr double kShareOfRange = 5.0 / 8.0;
constexpr double kRounding_m = 1e-3;  // as load_world() allows a mesh outside the workspace
constexpr double kClearance_m = 2.0;  // between the collision sphere and the workspace's face

double floor_of_m(const Scenario& scenario, double lowest_m, double margin_m) {
  const bool stands = scenario.structure.ground && lowest_m <= margin_m;
  if (!stands) return lowest_m - margin_m;
  return lowest_m < -kRounding_m ? lowest_m : 0.0;
}

/// Outwards to multiples of the resolution; what is one but for rounding stays.
Box3 rounded(const Box3& box_m, double resolution_m) {
  constexpr double kRounding = 1e-6;
  const Vec3 low = (box_m.min() / resolution_m + Vec3::Constant(kRounding)).array().floor();
  const Vec3 high = (box_m.max() / resolution_m - Vec3::Constant(kRounding)).array().ceil();
  return {low * resolution_m, high * resolution_m};
}

}  // namespace

double flight_margin_m(const Scenario& scenario) {
  double range_m = 0.0;
  for (const CameraConfig& camera : scenario.cameras) {
    range_m = std::max(range_m, camera.range_max_m);
  }
  return std::max(kShareOfRange * range_m,
                  scenario.planner.validity.collision_radius_m + kClearance_m);
}

Scenario with_bounds_around(const Scenario& scenario, const Box3& structure_m) {
  GNBV_CHECK(!structure_m.isEmpty(), "the structure has no box");
  const double margin_m = flight_margin_m(scenario);
  const ValidityConfig& validity = scenario.planner.validity;
  const double lowest_m = structure_m.min().z();
  const double floor_m = floor_of_m(scenario, lowest_m, margin_m);
  const double top_m = std::max(structure_m.max().z(), validity.z_min_m) + margin_m;
  const Vec3 sides_m(margin_m, margin_m, 0.0);
  Box3 box(Vec3(structure_m.min() - sides_m), Vec3(structure_m.max() + sides_m));
  box.min().z() = floor_m;
  box.max().z() = top_m;

  Scenario out = scenario;
  out.workspace_m = rounded(box, scenario.planner.map.resolution_m);
  const Box3 navigation_m = navigation_box_m(validity, out.workspace_m);
  const double height_m = scenario.start.pose.p_world_m.z() - scenario.workspace_m.min().z();
  out.start.pose.p_world_m = {structure_m.center().x(), out.workspace_m.min().y(),
                              std::clamp(out.workspace_m.min().z() + height_m,
                                         navigation_m.min().z(), navigation_m.max().z())};
  out.start.pose.yaw_rad = 0.5 * kPi;

  std::string faults;
  for (const Problem& problem : problems(out)) {
    faults += fmt::format("{}--bounds auto: {}: {}", faults.empty() ? "" : "\n",
                          problem.keys.front(), problem.what);
  }
  if (!faults.empty()) throw BadInput(faults);
  return out;
}

}  // namespace gnbv
