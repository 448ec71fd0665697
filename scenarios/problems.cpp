#include "scenarios/problems.hpp"

#include <cmath>
#include <filesystem>

#include "planner/map/grid_geometry.hpp"
#include "planner/planners.hpp"
#include "scenarios/values.hpp"

namespace gnbv {
namespace {

std::string point_text(const Vec3& p_m) {
  return fmt::format("[{}, {}, {}]", p_m.x(), p_m.y(), p_m.z());
}

/// Whether the box of that key has a length along each axis.
bool check_box(const Box3& box_m, const std::string& key, Problems& out) {
  bool is_box = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double low_m = box_m.min()[axis];
    const double high_m = box_m.max()[axis];
    is_box &= require(low_m < high_m, out, {key + ".max", key + ".min"},
                      "min {0} = {1} has to be below max {0} = {2}", "xyz"[axis], low_m, high_m);
  }
  return is_box;
}

/// Every path that is given names a file; those of lists have to be given.
void check_mesh_files(const Scenario& s, Problems& out) {
  Scenario copy = s;  // mesh_files() hands out what can be changed
  for (const MeshFileKey& mesh : mesh_files(copy)) {
    const std::filesystem::path path = mesh.file->path;
    const bool has_to_be_given = mesh.key.starts_with("structure.files.");
    std::error_code ignored;
    if (path.empty()) {
      require(!has_to_be_given, out, {mesh.key + ".path"}, "names no mesh file");
    } else {
      const bool is_folder = std::filesystem::is_directory(path, ignored);
      const bool is_model = is_folder && (std::filesystem::exists(path / "model.config", ignored) ||
                                          std::filesystem::exists(path / "model.sdf", ignored));
      require(is_model || std::filesystem::is_regular_file(path, ignored), out,
              {mesh.key + ".path"}, "{}",
              is_folder
                  ? "is a folder, neither a mesh file nor a model with model.config or model.sdf"
                  : "there is no such file");
    }
  }
}

void check_obstacles(const Scenario& s, Problems& out) {
  for (std::size_t i = 0; i < s.obstacles.size(); ++i) {
    const std::string key = fmt::format("obstacles.{}", i);
    const std::vector<std::string> both = {key + ".box_m", key + ".file.path"};
    const Box3& box_m = s.obstacles[i].box_m;
    const bool is_mesh = !s.obstacles[i].file.path.empty();
    const bool is_box = box_m.min() != Vec3::Zero() || box_m.max() != Vec3::Zero();
    require(!is_mesh || !is_box, out, both, "is a mesh or a box, not both");
    require(is_mesh || is_box, out, {key, both[1], both[0]},
            "names neither a mesh (file.path) nor a box (box_m)");
    if (is_box && !is_mesh) check_box(box_m, both[0], out);
    const MotionConfig& motion = s.obstacles[i].motion;
    require(motion.waypoints.empty() || motion_of(motion).length_m() > 0.0, out,
            {key + ".motion.waypoints"}, "lead nowhere: all are where the body stands");
  }
}

void check_no_fly(const Scenario& s, Problems& out) {
  const double radius_m = s.planner.validity.collision_radius_m;
  const Vec3& start_m = s.start.pose.p_world_m;
  for (std::size_t i = 0; i < s.no_fly.size(); ++i) {
    const std::string key = fmt::format("no_fly.{}", i);
    const Box3& box_m = s.no_fly[i].box_m;
    if (!check_box(box_m, key, out)) continue;
    const double away_m = box_m.exteriorDistance(start_m);
    const std::string where =
        away_m == 0.0
            ? "in"
            : fmt::format("{:.2f} m, less than collision_radius_m = {}, from", away_m, radius_m);
    require(away_m >= radius_m, out,
            {key, "start.position_m", "planner.validity.collision_radius_m"},
            "the start {} is {} the box from {} to {}", point_text(start_m), where,
            point_text(box_m.min()), point_text(box_m.max()));
  }
}

/// Of structure.file, structure.files, terrain, obstacles, no_fly and score.region_m.
void check_world(const Scenario& s, Problems& out) {
  check_mesh_files(s, out);
  check_obstacles(s, out);
  check_no_fly(s, out);
  const auto check_meets_workspace = [&](const std::string& key, const Box3& box_m) {
    if (!check_box(box_m, key, out)) return;
    require(box_m.intersects(s.workspace_m), out,
            {key + ".max", key + ".min", "workspace_m.max", "workspace_m.min"},
            "{} has nothing of the workspace in it", key);
  };
  check_meets_workspace("score.region_m", s.score.region_m);
  check_meets_workspace("planner.object_bounds_m", s.planner.object_bounds_m);
}

/// Size and place of the map; only for a workspace that is a box.
void check_map_size(const Scenario& s, Problems& out) {
  constexpr double kGiB = 1024.0 * 1024 * 1024;
  constexpr double kMaxKey = 32767.0;     // OctoMap's are 16 bits wide, the origin in the middle
  constexpr double kFarthest_m = 1000.0;  // float32 is exact to 0.06 mm there
  const std::vector<std::string> keys = {"planner.map.resolution_m", "workspace_m"};
  const double resolution_m = s.planner.map.resolution_m;
  const Vec3 size_m = s.workspace_m.sizes();
  const Vec3 voxels = (size_m / resolution_m - Vec3::Constant(1e-6)).array().ceil();
  const double bytes = planning_bytes(s.planner, s.workspace_m, 1, s.cameras.size());
  require(bytes <= kMapBudget_bytes, out, keys,
          "a map of {} x {} x {} m at {} m needs {:.3g} voxels and {:.1f} GiB, the budget is "
          "{:.0f} GiB; about {:.2g} m fits",
          size_m.x(), size_m.y(), size_m.z(), resolution_m, voxels.prod(), bytes / kGiB,
          kMapBudget_bytes / kGiB, resolution_m * std::cbrt(bytes / kMapBudget_bytes));
  const double farthest_m =
      s.workspace_m.min().cwiseAbs().cwiseMax(s.workspace_m.max().cwiseAbs()).maxCoeff();
  require(farthest_m / resolution_m <= kMaxKey, out, keys,
          "a workspace up to {} m from the origin at {} m is beyond the {} voxels that OctoMap's "
          "keys reach",
          farthest_m, resolution_m, kMaxKey);
  require(farthest_m <= kFarthest_m, out, {"workspace_m.max", "workspace_m.min"},
          "a workspace up to {} m from the origin: distances are right up to {} m; "
          "structure.file.offset_m moves a mesh there",
          farthest_m, kFarthest_m);
}

void check_workspace(const Scenario& s, Problems& out) {
  if (!check_box(s.workspace_m, "workspace_m", out)) return;
  check_map_size(s, out);
  const ValidityConfig& validity = s.planner.validity;
  const double top_m = s.workspace_m.max().z();
  if (!require(validity.z_min_m < top_m, out, {"planner.validity.z_min_m", "workspace_m.max"},
               "the navigation box is empty: z_min_m = {} has to be below the top of the "
               "workspace, {}",
               validity.z_min_m, top_m)) {
    return;
  }
  const Box3 navigation_m = navigation_box_m(validity, s.workspace_m);
  const Vec3& start_m = s.start.pose.p_world_m;
  require(navigation_m.contains(start_m), out,
          {"start.position_m", "planner.validity.z_min_m", "workspace_m.min", "workspace_m.max"},
          "the start {} lies outside the navigation box from {} to {}", point_text(start_m),
          point_text(navigation_m.min()), point_text(navigation_m.max()));
}

/// Lengths that have to fit the voxels of the map.
void check_lengths(const PlannerConfig& planner, Problems& out) {
  // SurfaceCloud keeps a bit a leaf in buckets of one voxel
  constexpr double kLeavesPerVoxel = 64.0;
  const std::string resolution = "planner.map.resolution_m";
  const double resolution_m = planner.map.resolution_m;
  const double extent_m = planner.fvs.frontier.max_extent_m;
  const double shadow_m = planner.utility.shadow.shadow_depth_m;
  const double finest_m = resolution_m / kLeavesPerVoxel;
  for (const auto& [key, leaf_m] : {std::pair("leaf_m", planner.cloud.leaf_m),
                                    std::pair("profile_leaf_m", planner.cloud.profile_leaf_m)}) {
    require(leaf_m >= finest_m, out, {fmt::format("planner.cloud.{}", key), resolution},
            "{} = {} has to be at least a 64th of planner.map.resolution_m = {}, that is {}", key,
            leaf_m, resolution_m, finest_m);
  }
  require(extent_m == 0.0 || extent_m >= resolution_m, out,
          {"planner.fvs.frontier.max_extent_m", resolution},
          "max_extent_m = {} is neither 0 nor at least a voxel, {} m", extent_m, resolution_m);
  require(shadow_m <= kMaxShadow_voxels * resolution_m, out,
          {"planner.utility.shadow.shadow_depth_m", resolution},
          "shadow_depth_m = {} is more than {} voxels of {} m", shadow_m, kMaxShadow_voxels,
          resolution_m);
}

/// The lattice of candidate rays at maximum range, one a voxel.
void check_view_rays(const Scenario& s, Problems& out) {
  constexpr double kMaxRays = 1e6;
  for (std::size_t i = 0; i < s.cameras.size(); ++i) {
    const CameraConfig& c = s.cameras[i];
    const double resolution_m = s.planner.map.resolution_m;
    const double rays = 3.0 * frustum_m3(c) / (c.range_max_m * resolution_m * resolution_m);
    require(rays <= kMaxRays, out,
            {fmt::format("cameras.{}.range_max_m", i), "planner.map.resolution_m"},
            "a view would be {:.2g} rays, one a voxel at maximum range; at most "
            "{:.0g} can be walked for every candidate",
            rays, kMaxRays);
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
  require(places <= kMostPlaces, out, {"planner.tour.lattice_step_m", "workspace_m"},
          "a lattice of {:.2g} places, one every {} m of the workspace; at most {:.0g} can be "
          "planned over",
          places, between_m, kMostPlaces);
}

void check_map_thresholds(const OccupancyConfig& map, Problems& out) {
  const std::string key = "planner.map.";
  require_below(out, key, "free_max", map.free_max, "occupied_min", map.occupied_min);
  require(map.clamp_max >= map.occupied_min, out, {key + "occupied_min", key + "clamp_max"},
          "nothing could become occupied: clamp_max = {} is below occupied_min = {}", map.clamp_max,
          map.occupied_min);
  require(map.clamp_min <= map.free_max, out, {key + "free_max", key + "clamp_min"},
          "nothing could become free: clamp_min = {} is above free_max = {}", map.clamp_min,
          map.free_max);
}

void check_utility(const UtilityConfig& utility, Problems& out) {
  require(!is_user_utility(utility.name) ||
              (!utility.python.function.empty() && !utility.python.source.empty()),
          out, {"planner.utility.python", "planner.utility.name"},
          "the utility python is a function of yours; --utility FILE.py:FUNCTION names it");
  require(!utility_traits(utility.name).eq2 || utility.beta + utility.gamma > 0.0, out,
          {"planner.utility.beta", "planner.utility.gamma"},
          "beta and gamma are both 0; Eq. (2) divides by their sum");
}

}  // namespace

Problems problems(const Scenario& scenario) {
  Problems out;
  check_workspace(scenario, out);
  check_world(scenario, out);
  check_sensors(scenario, out);
  check_vehicle(scenario, out);
  check_lengths(scenario.planner, out);
  check_view_rays(scenario, out);
  check_tour(scenario, out);
  check_map_thresholds(scenario.planner.map, out);
  check_utility(scenario.planner.utility, out);
  return out;
}

std::string clearing_note(const Scenario& scenario) {
  if (scenario.planner.map.no_return != NoReturn::free) return "";
  std::string where;
  for (const CameraConfig& camera : scenario.cameras) {
    const double end_m = return_end_m(camera);
    if (end_m >= camera.range_max_m) continue;
    where += fmt::format("{} {} from {} to {} m", where.empty() ? "" : ",", camera.name, end_m,
                         camera.range_max_m);
  }
  if (where.empty()) return "";
  return "rays clear surface that is too deep for a return, as planner.map.no_return is free:" +
         where;
}

}  // namespace gnbv
