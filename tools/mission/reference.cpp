#include "tools/mission/reference.hpp"

#include "bench/score/surface_reference.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

ReferenceConfig reference_config(const Scenario& scenario) {
  return {.floor_z_m = scenario.planner.floor_z_m, .region_m = scenario.score.region_m};
}

SurfaceReference reference_of(const Scenario& scenario, const World& world, const RayScene& scene,
                              int threads) {
  const double floor_z_m = scenario.planner.floor_z_m;
  const ReferenceConfig config = reference_config(scenario);
  SurfaceReference reference = cached_surface_reference(world, scene, config, threads);
  if (reference.outside[0].empty()) {
    const std::string where =
        config.region_m.isApprox(ReferenceConfig{}.region_m) ? "" : " and in score.region_m";
    throw BadInput(fmt::format(
        "{}: nothing to measure: above planner.floor_z_m = {} m{} there is no voxel with surface "
        "enough that can be seen from outside; `gnbv lint` says more of a mesh",
        structure_name(scenario.structure), floor_z_m, where));
  }
  return reference;
}

}  // namespace gnbv
