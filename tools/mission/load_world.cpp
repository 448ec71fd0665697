#include "tools/mission/load_world.hpp"

#include "assets/catalog.hpp"
#include "sim/core/error.hpp"
#include "sim/core/portable.hpp"

namespace gnbv {

namespace {

void add(const TriangleMesh& more, TriangleMesh& mesh) {
  if (mesh.faces.empty()) {
    mesh = more;
  } else {
    append(mesh, more);
  }
}

void load_obstacles(const Scenario& scenario, World& world, std::vector<std::string>& warnings) {
  const Material material{.name = "obstacle", .rgb = {0.6F, 0.6F, 0.6F}};
  world.obstacles = {};
  world.movers.clear();
  for (const ObstacleConfig& obstacle : scenario.obstacles) {
    TriangleMesh mesh = obstacle.file.path.empty() ? box_mesh(obstacle.box_m, material)
                                                   : load_mesh(obstacle.file, &warnings);
    if (obstacle.motion.waypoints.empty()) {
      add(mesh, world.obstacles);
    } else {
      world.movers.push_back({std::move(mesh), motion_of(obstacle.motion)});
    }
  }
}

}  // namespace

TriangleMesh load_structure(const Scenario& scenario, std::vector<std::string>& warnings) {
  const StructureConfig& structure = scenario.structure;
  TriangleMesh mesh;
  if (is_builtin(structure)) mesh = make_builtin_structure(structure.builtin);
  if (!structure.file.path.empty()) add(load_mesh(structure.file, &warnings), mesh);
  for (const MeshFileConfig& file : structure.files) add(load_mesh(file, &warnings), mesh);
  if (structure.offset_m != Vec3::Zero()) {
    for (auto& p_m : mesh.vertices_m) p_m += structure.offset_m.cast<float>();
  }
  return mesh;
}

void load_surroundings(const Scenario& scenario, World& world, std::vector<std::string>& warnings) {
  if (scenario.portable) need_portable_mathematics();
  world.is_portable = scenario.portable;
  world.has_ground = has_flat_ground(scenario);
  load_obstacles(scenario, world, warnings);
  if (!scenario.terrain.path.empty()) world.terrain = load_mesh(scenario.terrain, &warnings);
  world.terrain_floor_z_m = scenario.planner.floor_z_m;
}

std::shared_ptr<const RayScene> scene_around(const Scenario& scenario) {
  std::vector<std::string> warnings;  // told where the world is loaded
  World around;
  load_surroundings(scenario, around, warnings);
  around.has_ground = false;
  if (around.obstacles.faces.empty() && around.terrain.faces.empty()) return nullptr;
  return std::make_shared<const RayScene>(around);
}

World load_world_anywhere(const Scenario& scenario, std::vector<std::string>& warnings) {
  World world{.structure = load_structure(scenario, warnings)};
  load_surroundings(scenario, world, warnings);
  return world;
}

bool is_inside_workspace(const Scenario& scenario, const Box3& mesh_m) {
  constexpr double kRounding_m = 1e-3;
  const Box3 allowed_m(scenario.workspace_m.min() - Vec3::Constant(kRounding_m),
                       scenario.workspace_m.max() + Vec3::Constant(kRounding_m));
  return allowed_m.contains(mesh_m);
}

World load_world(const Scenario& scenario, std::vector<std::string>& warnings) {
  const StructureConfig& structure = scenario.structure;
  World world = load_world_anywhere(scenario, warnings);
  const Box3 mesh_m = bounds_m(world.structure);
  if (!is_inside_workspace(scenario, mesh_m)) {
    const Vec3 lo = mesh_m.min();
    const Vec3 hi = mesh_m.max();
    const std::string& at = scenario.placed_at;
    throw BadInput(
        "{}{}{}: the mesh spans [{:.2f}, {:.2f}, {:.2f}] to [{:.2f}, {:.2f}, {:.2f}] m, which is "
        "not inside workspace_m: `--bounds auto` lays the workspace around it; or set "
        "structure.file.scale, structure.file.offset_m, structure.file.unit_m or workspace_m",
        at, at.empty() ? "" : ": ", structure_name(structure), lo.x(), lo.y(), lo.z(), hi.x(),
        hi.y(), hi.z());
  }
  return world;
}

}  // namespace gnbv
