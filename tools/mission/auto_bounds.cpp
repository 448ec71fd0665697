#include "tools/mission/auto_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "bench/score/surface_samples.hpp"
#include "planner/view_validity.hpp"
#include "sim/core/error.hpp"
#include "sim/mesh/mesh_lint.hpp"

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

/// Of an angle that may pass the vertical.
double steep_tan(double rad) {
  constexpr double kSteepest_rad = 1.55;
  return std::tan(std::clamp(rad, -kSteepest_rad, kSteepest_rad));
}

/// How much of the surface is before a camera that looks north from there, its yaw left aside.
std::size_t in_view(const Scenario& scenario, const Vec3& p_m, std::span<const Vec3f> surface_m) {
  const auto is_in_view = [&](const Vec3f& at_m) {
    const Vec3 to_m = at_m.cast<double>() - p_m;
    return std::any_of(
        scenario.cameras.begin(), scenario.cameras.end(), [&](const CameraConfig& camera) {
          const double tan_x = std::tan(0.5 * camera.fov_x_rad);
          const double highest_rad = camera.gimbal ? camera.gimbal->min_rad : camera.pitch_rad;
          const double lowest_rad = camera.gimbal ? camera.gimbal->max_rad : camera.pitch_rad;
          const double tan_up = steep_tan(0.5 * camera.fov_y_rad - highest_rad);
          const double tan_down = steep_tan(0.5 * camera.fov_y_rad + lowest_rad);
          return to_m.y() > 0.0 && to_m.norm() <= camera.range_max_m &&
                 std::abs(to_m.x()) <= tan_x * to_m.y() && to_m.z() <= tan_up * to_m.y() &&
                 -to_m.z() <= tan_down * to_m.y();
        });
  };
  return static_cast<std::size_t>(std::count_if(surface_m.begin(), surface_m.end(), is_in_view));
}

/// On the navigation box's south face, on a lattice that begins at its middle.
Vec3 start_on_south_face(const Scenario& scenario, const StructureExtent& structure) {
  constexpr int kSteps = 12;  // to either side
  const Box3 navigation_m = navigation_box_m(scenario.planner.validity, scenario.workspace_m);
  const Vec3 low_m = structure.box_m.min().cwiseMax(navigation_m.min());
  const Vec3 high_m = structure.box_m.max().cwiseMin(navigation_m.max());
  const Vec3 middle_m =
      (0.5 * (low_m + high_m)).cwiseMax(navigation_m.min()).cwiseMin(navigation_m.max());
  const Vec3 step_m = ((high_m - low_m) / (2.0 * kSteps)).cwiseMax(0.0);
  Vec3 best_m(middle_m.x(), navigation_m.min().y(), middle_m.z());
  std::size_t most = in_view(scenario, best_m, structure.surface_world_m);
  for (int ring = 1; ring <= kSteps; ++ring) {
    for (int i = -ring; i <= ring; ++i) {
      for (int k = -ring; k <= ring; ++k) {
        if (std::max(std::abs(i), std::abs(k)) != ring) continue;
        const Vec3 p_m(middle_m.x() + i * step_m.x(), navigation_m.min().y(),
                       middle_m.z() + k * step_m.z());
        const std::size_t seen = in_view(scenario, p_m, structure.surface_world_m);
        if (seen <= most) continue;
        most = seen;
        best_m = p_m;
      }
    }
  }
  return best_m;
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

StructureExtent extent_of(const TriangleMesh& structure) {
  constexpr double kSamples = 2000.0;
  StructureExtent extent{.box_m = bounds_m(structure), .surface_world_m = {}};
  const double area_m2 = surface_area_m2(structure);
  if (area_m2 <= 0.0) return extent;
  for (const SurfaceSample& s : sample_surface(structure, std::sqrt(area_m2 / kSamples))) {
    extent.surface_world_m.push_back(s.p_world_m);
  }
  return extent;
}

Scenario with_bounds_around(const Scenario& scenario, const StructureExtent& structure,
                            const GivenBounds& given) {
  const Box3& structure_m = structure.box_m;
  GNBV_CHECK(!structure_m.isEmpty(), "the structure has no box");
  Scenario out = scenario;
  const ValidityConfig& validity = scenario.planner.validity;
  if (!given.workspace) {
    const double margin_m = flight_margin_m(scenario);
    const Vec3 sides_m(margin_m, margin_m, 0.0);
    Box3 box(Vec3(structure_m.min() - sides_m), Vec3(structure_m.max() + sides_m));
    box.min().z() = floor_of_m(scenario, structure_m.min().z(), margin_m);
    box.max().z() = std::max(structure_m.max().z(), validity.z_min_m) + margin_m;
    if (given.position) box.extend(scenario.start.pose.p_world_m);
    out.workspace_m = rounded(box, scenario.planner.map.resolution_m);
  }
  if (!given.position) out.start.pose.p_world_m = start_on_south_face(out, structure);
  if (!given.yaw) {
    const Vec3 to_m = structure_m.center() - out.start.pose.p_world_m;
    const bool is_north = !given.position;
    out.start.pose.yaw_rad = is_north ? 0.5 * kPi : std::atan2(to_m.y(), to_m.x());
  }
  return out;
}

}  // namespace gnbv
