#include <filesystem>

#include "scenarios/problems.hpp"

namespace gnbv {
namespace {

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
      require(std::filesystem::is_regular_file(path, ignored), out, {mesh.key + ".path"}, "{}",
              std::filesystem::is_directory(path, ignored) ? "is a folder, not a mesh file"
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

}  // namespace

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

void check_world(const Scenario& s, Problems& out) {
  check_mesh_files(s, out);
  check_obstacles(s, out);
  check_no_fly(s, out);
  const std::string region = "score.region_m";
  if (!check_box(s.score.region_m, region, out)) return;
  require(s.score.region_m.intersects(s.workspace_m), out,
          {region + ".max", region + ".min", "workspace_m.max", "workspace_m.min"},
          "score.region_m has nothing of the workspace in it");
}

}  // namespace gnbv
