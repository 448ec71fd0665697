#include "scenarios/problems_world.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>

namespace gnbv {
namespace {

constexpr std::array<char, 3> kAxes = {'x', 'y', 'z'};

/// Every path that is given names a file; those of lists have to be given.
void check_mesh_files(const Scenario& s, std::vector<Problem>& out) {
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

void check_obstacles(const Scenario& s, std::vector<Problem>& out) {
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
      check_box(box_m.min(), box_m.max(), key + ".box_m.min", key + ".box_m.max", out);
    }
  }
}

void check_no_fly(const Scenario& s, std::vector<Problem>& out) {
  for (std::size_t i = 0; i < s.no_fly.size(); ++i) {
    const std::string key = fmt::format("no_fly.{}", i);
    const NoFlyConfig& box = s.no_fly[i];
    if (!check_box(box.min_m, box.max_m, key + ".min", key + ".max", out)) continue;
    const double radius_m = s.planner.validity.collision_radius_m;
    const Vec3& start_m = s.start.pose.p_world_m;
    const double away_m = Box3(box.min_m, box.max_m).exteriorDistance(start_m);
    if (away_m >= radius_m) continue;
    out.push_back({{key, "start.position_m", "planner.validity.collision_radius_m"},
                   fmt::format("the start {} is {} the box from {} to {}", text_of(start_m),
                               away_m == 0.0 ? std::string("in")
                                             : fmt::format("{:.2f} m, less than collision_radius_m "
                                                           "= {}, from",
                                                           away_m, radius_m),
                               text_of(box.min_m), text_of(box.max_m))});
  }
}

void check_region(const Scenario& s, std::vector<Problem>& out) {
  const Box3& region_m = s.score.region_m;
  const std::string key = "score.region_m";
  if (!check_box(region_m.min(), region_m.max(), key + ".min", key + ".max", out)) return;
  if (region_m.intersects(s.workspace_m)) return;
  out.push_back({{key + ".max", key + ".min", "workspace_m.max", "workspace_m.min"},
                 "score.region_m has nothing of the workspace in it"});
}

}  // namespace

std::string text_of(const Vec3& p_m) {
  return fmt::format("[{}, {}, {}]", p_m.x(), p_m.y(), p_m.z());
}

bool check_box(const Vec3& low_m, const Vec3& high_m, const std::string& min_key,
               const std::string& max_key, std::vector<Problem>& out) {
  bool is_box = true;
  for (int axis = 0; axis < 3; ++axis) {
    if (low_m[axis] < high_m[axis]) continue;
    is_box = false;
    const char name = kAxes[static_cast<std::size_t>(axis)];
    out.push_back({{max_key, min_key},
                   fmt::format("min {} = {} has to be below max {} = {}", name, low_m[axis], name,
                               high_m[axis])});
  }
  return is_box;
}

void check_world(const Scenario& scenario, std::vector<Problem>& out) {
  check_mesh_files(scenario, out);
  check_obstacles(scenario, out);
  check_no_fly(scenario, out);
  check_region(scenario, out);
}

}  // namespace gnbv
