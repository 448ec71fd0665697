#include "tools/mission/auto_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "bench/score/surface_samples.hpp"
#include "planner/motion/config.hpp"
#include "sim/core/error.hpp"
#include "sim/mesh/mesh_lint.hpp"

namespace gnbv {
namespace {

constexpr double kShareOfRange = 5.0 / 8.0;
constexpr double kRounding_m = 1e-3;  // as load_world() allows a mesh outside the workspace
constexpr double kClearance_m = 2.0;  // between the collision sphere and the workspace's face

double floor_of_m(const Scenario& scenario, double lowest_m, double margin_m) {
  const bool stands = has_flat_ground(scenario) && lowest_m <= margin_m;
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

/// What is before a camera that looks north, its yaw left aside, at any pitch of its gimbal.
struct NorthernView {
  explicit NorthernView(const CameraConfig& camera)
      : range_m(return_end_m(camera)),
        tan_side(0.5 * make_camera_model(camera).sight.sizes().x()),
        tan_up(steep_tan(-make_camera_model(camera).sight_rad.min().y() -
                         (camera.gimbal ? camera.gimbal->min_rad : camera.pitch_rad))),
        tan_down(steep_tan(make_camera_model(camera).sight_rad.max().y() +
                           (camera.gimbal ? camera.gimbal->max_rad : camera.pitch_rad))) {}

  bool has(const Vec3& to_m) const {
    return to_m.y() > 0.0 && to_m.norm() <= range_m && std::abs(to_m.x()) <= tan_side * to_m.y() &&
           to_m.z() <= tan_up * to_m.y() && -to_m.z() <= tan_down * to_m.y();
  }

  double range_m, tan_side, tan_up, tan_down;
};

/// How much of the surface some camera sees from there.
std::size_t in_view(std::span<const NorthernView> views, const Vec3& p_m,
                    std::span<const Vec3f> surface_m) {
  const auto is_in_view = [&](const Vec3f& at_m) {
    const Vec3 to_m = at_m.cast<double>() - p_m;
    return std::any_of(views.begin(), views.end(),
                       [&](const NorthernView& view) { return view.has(to_m); });
  };
  return static_cast<std::size_t>(std::count_if(surface_m.begin(), surface_m.end(), is_in_view));
}

bool is_room_at(const Scenario& scenario, const StructureExtent& structure, const Vec3& p_m) {
  const double radius_m = scenario.planner.validity.collision_radius_m;
  return no_fly_of(scenario).allows(p_m) &&
         (!structure.around || structure.around->clearance_m(p_m, radius_m) >= radius_m);
}

/// On the navigation box's south face, on a lattice that begins at its middle.
Vec3 start_on_south_face(const Scenario& scenario, const StructureExtent& structure) {
  constexpr int kSteps = 12;         // to either side, before the structure
  constexpr int kMost = 6 * kSteps;  // beside it, where all places before it are taken
  const Box3 navigation_m = navigation_box_m(scenario.planner.validity, scenario.workspace_m);
  const Vec3 low_m = structure.box_m.min().cwiseMax(navigation_m.min());
  const Vec3 high_m = structure.box_m.max().cwiseMin(navigation_m.max());
  const Vec3 middle_m =
      (0.5 * (low_m + high_m)).cwiseMax(navigation_m.min()).cwiseMin(navigation_m.max());
  const Vec3 step_m = ((high_m - low_m) / (2.0 * kSteps)).cwiseMax(0.0);
  const std::vector<CameraConfig> sights = sights_of(scenario);
  const std::vector<NorthernView> views(sights.begin(), sights.end());
  Vec3 best_m(middle_m.x(), navigation_m.min().y(), middle_m.z());
  std::size_t most = in_view(views, best_m, structure.surface_world_m);
  bool is_room = is_room_at(scenario, structure, best_m);
  for (int ring = 1; ring <= (is_room ? kSteps : kMost); ++ring) {
    for (int i = -ring; i <= ring; ++i) {
      for (int k = -ring; k <= ring; ++k) {
        if (std::max(std::abs(i), std::abs(k)) != ring) continue;
        // steps to the box's face may pass it by a rounding, which would be outside
        const Vec3 p_m = Vec3(middle_m.x() + i * step_m.x(), navigation_m.min().y(),
                              middle_m.z() + k * step_m.z())
                             .cwiseMax(navigation_m.min())
                             .cwiseMin(navigation_m.max());
        if (!is_room && !is_room_at(scenario, structure, p_m)) continue;
        const std::size_t seen = in_view(views, p_m, structure.surface_world_m);
        if (is_room && (seen <= most || !is_room_at(scenario, structure, p_m))) continue;
        most = seen;
        best_m = p_m;
        is_room = true;
      }
    }
  }
  return best_m;
}

}  // namespace

double flight_margin_m(const Scenario& scenario) {
  double range_m = 0.0;
  constexpr double kNoFarther_m = 16.0;  // LIDARs see farther than anybody has to fly
  for (const CameraConfig& camera : scenario.cameras) {
    range_m = std::max(range_m, return_end_m(camera));
  }
  for (const LidarConfig& lidar : scenario.lidars) {
    if (!looks_at_views(lidar, !scenario.cameras.empty())) continue;
    range_m = std::max(range_m, std::min(lidar.range_max_m, kNoFarther_m));
  }
  return std::max(kShareOfRange * range_m,
                  scenario.planner.validity.collision_radius_m + kClearance_m);
}

StructureExtent extent_of(const TriangleMesh& structure) {
  constexpr double kSamples = 2000.0;
  constexpr std::size_t kMost = 100000;  // of a sample a face
  StructureExtent extent{.box_m = bounds_m(structure), .surface_world_m = {}};
  const std::vector<SurfaceSample> samples = sample_about(structure, kSamples);
  const std::size_t one_in = samples.size() / kMost + 1;
  for (std::size_t i = 0; i < samples.size(); i += one_in) {
    extent.surface_world_m.push_back(samples[i].p_world_m);
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
  if (!given.object_bounds) out.planner.object_bounds_m = kEverywhere_m;
  if (!given.position) out.start.pose.p_world_m = start_on_south_face(out, structure);
  if (!given.yaw) {
    const Vec3 to_m = structure_m.center() - out.start.pose.p_world_m;
    const bool is_north = !given.position;
    out.start.pose.yaw_rad = is_north ? 0.5 * kPi : std::atan2(to_m.y(), to_m.x());
  }
  return out;
}

}  // namespace gnbv
