#include <fmt/format.h>

#include <filesystem>

#include "scenarios/problems.hpp"

namespace gnbv {
namespace {

/// Every path that is given names a file; those of lists have to be given.
void check_mesh_files(const Scenario& s, Problems& out) {
  Scenario copy = s;  // mesh_files() hands out what can be changed
  for (const MeshFileKey& mesh : mesh_files(copy)) {
    const std::string& path = mesh.file->path;
    std::error_code ignored;
    if (path.empty()) {
      if (!mesh.key.starts_with("structure.files.")) continue;
      out.push_back({{mesh.key + ".path"}, "names no mesh file"});
    } else if (!std::filesystem::is_regular_file(path, ignored)) {
      out.push_back({{mesh.key + ".path"},
                     std::filesystem::is_directory(path, ignored) ? "is a folder, not a mesh file"
                                                                  : "there is no such file"});
    }
  }
}

void check_obstacles(const Scenario& s, Problems& out) {
  for (std::size_t i = 0; i < s.obstacles.size(); ++i) {
    const std::string key = fmt::format("obstacles.{}", i);
    const Box3& box_m = s.obstacles[i].box_m;
    const bool is_mesh = !s.obstacles[i].file.path.empty();
    const bool is_box = box_m.min() != Vec3::Zero() || box_m.max() != Vec3::Zero();
    if (is_mesh && is_box) {
      out.push_back({{key + ".box_m", key + ".file.path"}, "is a mesh or a box, not both"});
    } else if (!is_mesh && !is_box) {
      out.push_back({{key, key + ".file.path", key + ".box_m"},
                     "names neither a mesh (file.path) nor a box (box_m)"});
    } else if (is_box) {
      check_box(box_m, key + ".box_m", out);
    }
  }
}

void check_no_fly(const Scenario& s, Problems& out) {
  for (std::size_t i = 0; i < s.no_fly.size(); ++i) {
    const std::string key = fmt::format("no_fly.{}", i);
    const Box3& box_m = s.no_fly[i].box_m;
    if (!check_box(box_m, key, out)) continue;
    const double radius_m = s.planner.validity.collision_radius_m;
    const Vec3& start_m = s.start.pose.p_world_m;
    const double away_m = box_m.exteriorDistance(start_m);
    if (away_m >= radius_m) continue;
    out.push_back({{key, "start.position_m", "planner.validity.collision_radius_m"},
                   fmt::format("the start {} is {} the box from {} to {}", text_of(start_m),
                               away_m == 0.0 ? std::string("in")
                                             : fmt::format("{:.2f} m, less than collision_radius_m "
                                                           "= {}, from",
                                                           away_m, radius_m),
                               text_of(box_m.min()), text_of(box_m.max()))});
  }
}

void check_region(const Scenario& s, Problems& out) {
  const Box3& region_m = s.score.region_m;
  const std::string key = "score.region_m";
  if (!check_box(region_m, key, out)) return;
  if (region_m.intersects(s.workspace_m)) return;
  out.push_back({{key + ".max", key + ".min", "workspace_m.max", "workspace_m.min"},
                 "score.region_m has nothing of the workspace in it"});
}

}  // namespace

std::string text_of(const Vec3& p_m) {
  return fmt::format("[{}, {}, {}]", p_m.x(), p_m.y(), p_m.z());
}

bool check_box(const Box3& box_m, const std::string& key, Problems& out) {
  bool is_box = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double low_m = box_m.min()[axis];
    const double high_m = box_m.max()[axis];
    if (low_m < high_m) continue;
    is_box = false;
    const char name = "xyz"[axis];
    out.push_back(
        {{key + ".max", key + ".min"},
         fmt::format("min {} = {} has to be below max {} = {}", name, low_m, name, high_m)});
  }
  return is_box;
}

void check_world(const Scenario& scenario, Problems& out) {
  check_mesh_files(scenario, out);
  check_obstacles(scenario, out);
  check_no_fly(scenario, out);
  check_region(scenario, out);
}

}  // namespace gnbv
