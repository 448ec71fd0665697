#include "tools/mission/run_ceiling.hpp"

#include "bench/limits/ceiling.hpp"
#include "tools/mission/start_pose.hpp"

namespace gnbv {

std::optional<double> run_ceiling(const Scenario& scenario, const World& world,
                                  const RayScene& scene, CeilingFrom from, int threads) {
  const ViewPose start = start_pose(scenario, scene);
  const std::optional<Ceiling> ceiling =
      from == CeilingFrom::search ? find_ceiling(scenario, world, scene, start, threads)
                                  : known_ceiling(scenario, world, scene, start, threads);
  if (!ceiling || ceiling->leaf_outside[0] <= 0.0) return std::nullopt;
  return ceiling->leaf_outside[0];
}

}  // namespace gnbv
