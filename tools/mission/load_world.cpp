#include "tools/mission/load_world.hpp"

#include "assets/catalog.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

TriangleMesh load_structure(const Scenario& scenario, std::vector<std::string>& warnings) {
  const StructureConfig& structure = scenario.structure;
  return structure.file.path.empty() ? make_builtin_structure(structure.builtin)
                                     : load_mesh(structure.file, &warnings);
}

bool is_inside_workspace(const Scenario& scenario, const Box3& mesh_m) {
  constexpr double kRounding_m = 1e-3;
  const Box3 allowed_m(scenario.workspace_m.min() - Vec3::Constant(kRounding_m),
                       scenario.workspace_m.max() + Vec3::Constant(kRounding_m));
  return allowed_m.contains(mesh_m);
}

World load_world(const Scenario& scenario, std::vector<std::string>& warnings) {
  const StructureConfig& structure = scenario.structure;
  World world{.structure = load_structure(scenario, warnings), .has_ground = structure.ground};
  const Box3 mesh_m = bounds_m(world.structure);
  if (!is_inside_workspace(scenario, mesh_m)) {
    const Vec3 lo = mesh_m.min();
    const Vec3 hi = mesh_m.max();
    throw BadInput(fmt::format(
        "{}: the mesh spans [{:.2f}, {:.2f}, {:.2f}] to [{:.2f}, {:.2f}, {:.2f}] m, which is not "
        "inside workspace_m: `--bounds auto` lays the workspace around it; or set "
        "structure.file.scale, structure.file.offset_m, structure.file.unit_m or workspace_m",
        structure_name(structure), lo.x(), lo.y(), lo.z(), hi.x(), hi.y(), hi.z()));
  }
  return world;
}

}  // namespace gnbv
