// The ceiling that a run's effort is measured by.
#pragma once

#include <optional>

#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

/// How a ceiling is come by: read when an earlier command left it in the cache, or found anew,
/// which may take longer than the mission.
enum class CeilingFrom { cache, search };

/// The coverage at 0.05 m that the cloud of this scenario can reach (Ceiling::leaf_outside).
/// Nothing when the cache does not have it, or when there is nothing to reach.
std::optional<double> run_ceiling(const Scenario& scenario, const World& world,
                                  const RayScene& scene, CeilingFrom from, int threads);

}  // namespace gnbv
