#include "scenarios/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/map/memory.hpp"
#include "planner/planners.hpp"
#include "scenarios/values.hpp"

namespace gnbv {
namespace {

constexpr double kGiB = 1024.0 * 1024 * 1024;

/// A vehicle has one gimbal; several cameras may hang on it.
void check_gimbal(const std::vector<CameraConfig>& cameras, Problems& out) {
  const std::optional<GimbalConfig> gimbal = gimbal_of(cameras);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::string key = fmt::format("cameras.{}.pitch_deg", i);
    const std::optional<GimbalConfig>& own = cameras[i].gimbal;
    if (!own) continue;
    require_below(degrees_of(own->min_rad), degrees_of(own->max_rad), key + ".min", key + ".max",
                  out);
    if (own->min_rad == gimbal->min_rad && own->max_rad == gimbal->max_rad &&
        own->step_rad == gimbal->step_rad) {
      continue;
    }
    out.push_back({{key},
                   "another gimbal than that of the camera before: cameras that are not fixed hang "
                   "on one gimbal, with the same min, max and step"});
  }
}

/// Files and messages tell sensors of a list apart by their names.
template <typename Sensor>
void check_names(const std::vector<Sensor>& sensors, const std::string& list, Problems& out) {
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (sensors[i].name != sensors[j].name) continue;
      out.push_back(
          {{fmt::format("{}.{}.name", list, i), fmt::format("{}.{}.name", list, j)},
           fmt::format("two {}, {} and {}, are named '{}'", list, j, i, sensors[i].name)});
      break;
    }
  }
}

void check_sensors(const Scenario& s, Problems& out) {
  if (s.cameras.empty()) out.push_back({{"cameras"}, "names no camera; at least one has to look"});
  for (std::size_t i = 0; i < s.cameras.size(); ++i) {
    const std::string key = fmt::format("cameras.{}.", i);
    require_below(s.cameras[i].range_min_m, s.cameras[i].range_max_m, key + "range_min_m",
                  key + "range_max_m", out);
  }
  check_names(s.cameras, "cameras", out);
  check_gimbal(s.cameras, out);
  for (std::size_t i = 0; i < s.lidars.size(); ++i) {
    const std::string key = fmt::format("lidars.{}.", i);
    require_below(s.lidars[i].range_min_m, s.lidars[i].range_max_m, key + "range_min_m",
                  key + "range_max_m", out);
  }
  check_names(s.lidars, "lidars", out);
  const ProfilingMethod profiling = s.planner.profiling.method;
  if (s.lidars.empty() && flies_a_profile(s)) {
    out.push_back({{"lidars", "planner.profiling.method"}, "the profile needs a LIDAR to scan it"});
  }
  if (profiling == ProfilingMethod::saved && s.planner.profiling.file.empty()) {
    out.push_back({{"planner.profiling.file", "planner.profiling.method"},
                   "saved: names no file; an earlier run's profile.map has to be named"});
  }
}

/// Size and place of the map; only for a workspace that is a box.
void check_map_size(const Scenario& s, Problems& out) {
  const double resolution_m = s.planner.map.resolution_m;
  const Vec3 size_m = s.workspace_m.sizes();
  const Vec3 voxels = (size_m / resolution_m - Vec3::Constant(1e-6)).array().ceil();
  const double bytes = planning_bytes(s.planner, s.workspace_m, 1, s.cameras.size());
  if (bytes > kMapBudget_bytes) {
    const double fitting_m = resolution_m * std::cbrt(bytes / kMapBudget_bytes);
    out.push_back(
        {{"planner.map.resolution_m", "workspace_m"},
         fmt::format("a map of {} x {} x {} m at {} m needs {:.3g} voxels and {:.1f} GiB, "
                     "the budget is {:.0f} GiB; about {:.2g} m fits",
                     size_m.x(), size_m.y(), size_m.z(), resolution_m, voxels.prod(), bytes / kGiB,
                     kMapBudget_bytes / kGiB, fitting_m)});
  }
  // OctoMap's keys are 16 bits wide, with the origin in their middle
  constexpr double kMaxKey = 32767.0;
  const double farthest_m =
      s.workspace_m.min().cwiseAbs().cwiseMax(s.workspace_m.max().cwiseAbs()).maxCoeff();
  if (farthest_m / resolution_m > kMaxKey) {
    out.push_back({{"planner.map.resolution_m", "workspace_m"},
                   fmt::format("a workspace up to {} m from the origin at {} m is beyond the {} "
                               "voxels that OctoMap's keys reach",
                               farthest_m, resolution_m, kMaxKey)});
  }
  // what is traced and seen is float32, exact to 0.06 mm there; and the ground goes no farther
  constexpr double kFarthest_m = 1000.0;
  if (farthest_m > kFarthest_m) {
    out.push_back({{"workspace_m.max", "workspace_m.min"},
                   fmt::format("a workspace up to {} m from the origin: distances are right up to "
                               "{} m; structure.file.offset_m moves a mesh there",
                               farthest_m, kFarthest_m)});
  }
}

void check_workspace(const Scenario& s, Problems& out) {
  if (!check_box(s.workspace_m, "workspace_m", out)) return;
  check_map_size(s, out);

  const double top_m = s.workspace_m.max().z();
  const double z_min_m = s.planner.validity.z_min_m;
  if (z_min_m >= top_m) {
    out.push_back({{"planner.validity.z_min_m", "workspace_m.max"},
                   fmt::format("the navigation box is empty: z_min_m = {} has to be below the top "
                               "of the workspace, {}",
                               z_min_m, top_m)});
    return;
  }
  const Box3 navigation_m = navigation_box_m(s.planner.validity, s.workspace_m);
  const Vec3& start_m = s.start.pose.p_world_m;
  if (!navigation_m.contains(start_m)) {
    out.push_back(
        {{"start.position_m", "planner.validity.z_min_m", "workspace_m.min", "workspace_m.max"},
         fmt::format("the start {} lies outside the navigation box from {} to {}", text_of(start_m),
                     text_of(navigation_m.min()), text_of(navigation_m.max()))});
  }
}

/// Lengths that have to fit the voxels of the map.
void check_lengths(const PlannerConfig& planner, Problems& out) {
  const double resolution_m = planner.map.resolution_m;
  const double extent_m = planner.fvs.frontier.max_extent_m;
  if (extent_m != 0.0 && extent_m < resolution_m) {
    out.push_back({{"planner.fvs.frontier.max_extent_m", "planner.map.resolution_m"},
                   fmt::format("max_extent_m = {} is neither 0 nor at least a voxel, {} m",
                               extent_m, resolution_m)});
  }
  const double shadow_m = planner.utility.shadow.shadow_depth_m;
  if (shadow_m > kMaxShadow_voxels * resolution_m) {
    out.push_back({{"planner.utility.shadow.shadow_depth_m", "planner.map.resolution_m"},
                   fmt::format("shadow_depth_m = {} is more than {} voxels of {} m", shadow_m,
                               kMaxShadow_voxels, resolution_m)});
  }
}

void check_cloud(const PlannerConfig& planner, Problems& out) {
  // SurfaceCloud keeps a bit a leaf in buckets of one voxel
  constexpr double kLeavesPerVoxel = 64.0;
  const double finest_m = planner.map.resolution_m / kLeavesPerVoxel;
  if (planner.cloud.leaf_m >= finest_m) return;
  out.push_back({{"planner.cloud.leaf_m", "planner.map.resolution_m"},
                 fmt::format("leaf_m = {} has to be at least a 64th of planner.map.resolution_m = "
                             "{}, that is {}",
                             planner.cloud.leaf_m, planner.map.resolution_m, finest_m)});
}

/// The lattice of candidate rays on the plane at maximum range, one a voxel.
void check_view_rays(const Scenario& s, Problems& out) {
  constexpr double kMaxRays = 1e6;
  for (std::size_t i = 0; i < s.cameras.size(); ++i) {
    const CameraConfig& c = s.cameras[i];
    const double plane_m = 2.0 * c.range_max_m / s.planner.map.resolution_m;
    const double rays =
        plane_m * std::tan(0.5 * c.fov_x_rad) * plane_m * std::tan(0.5 * c.fov_y_rad);
    if (rays <= kMaxRays) continue;
    out.push_back({{fmt::format("cameras.{}.range_max_m", i), "planner.map.resolution_m"},
                   fmt::format("a view would be {:.2g} rays, one a voxel of the plane at maximum "
                               "range; at most {:.0g} can be walked for every candidate",
                               rays, kMaxRays)});
  }
}

/// What a tour plans over all ways between.
void check_tour(const Scenario& s, Problems& out) {
  constexpr double kMostPlaces = 5e5;
  const double step_m = s.planner.tour.lattice_step_m;
  if (step_m == 0.0) return;
  // places are middles of voxels
  const double between_m = std::max(step_m, s.planner.map.resolution_m);
  const double places = (s.workspace_m.sizes() / between_m + Vec3::Ones()).array().floor().prod();
  if (places <= kMostPlaces) return;
  out.push_back({{"planner.tour.lattice_step_m", "workspace_m"},
                 fmt::format("a lattice of {:.2g} places, one every {} m of the workspace; at most "
                             "{:.0g} can be planned over",
                             places, between_m, kMostPlaces)});
}

void check_map_thresholds(const OccupancyConfig& map, Problems& out) {
  const std::string key = "planner.map.";
  require_below(map.free_max, map.occupied_min, key + "free_max", key + "occupied_min", out);
  if (map.clamp_max < map.occupied_min) {
    out.push_back({{key + "occupied_min", key + "clamp_max"},
                   fmt::format("nothing could become occupied: clamp_max = {} is below "
                               "occupied_min = {}",
                               map.clamp_max, map.occupied_min)});
  }
  if (map.clamp_min > map.free_max) {
    out.push_back({{key + "free_max", key + "clamp_min"},
                   fmt::format("nothing could become free: clamp_min = {} is above free_max = {}",
                               map.clamp_min, map.free_max)});
  }
}

void check_utility(const UtilityConfig& utility, Problems& out) {
  if (is_user_utility(utility.name) &&
      (utility.python.function.empty() || utility.python.source.empty())) {
    out.push_back(
        {{"planner.utility.python", "planner.utility.name"},
         "the utility python is a function of yours; --utility FILE.py:FUNCTION names it"});
  }
  if (utility.name != "proposed" || utility.beta + utility.gamma > 0.0) return;
  out.push_back({{"planner.utility.beta", "planner.utility.gamma"},
                 "beta and gamma are both 0; Eq. (2) divides by their sum"});
}

}  // namespace

Problems problems(const Scenario& scenario) {
  Problems out;
  check_workspace(scenario, out);
  check_world(scenario, out);
  check_sensors(scenario, out);
  check_vehicle(scenario, out);
  check_disturbances(scenario, out);
  check_cloud(scenario.planner, out);
  check_lengths(scenario.planner, out);
  check_view_rays(scenario, out);
  check_tour(scenario, out);
  check_map_thresholds(scenario.planner.map, out);
  check_utility(scenario.planner.utility, out);
  return out;
}

}  // namespace gnbv
