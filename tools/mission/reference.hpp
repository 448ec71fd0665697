// What a scenario's missions are scored against.
#pragma once

#include "bench/score/surface_reference.hpp"
#include "scenarios/scenario.hpp"

namespace gnbv {

/// What of the structure the scenario scores.
ReferenceConfig reference_config(const Scenario& scenario);

/// From the cache, or found. Throws BadInput when there is nothing to measure: no surface above the
/// scenario's floor sees out.
SurfaceReference reference_of(const Scenario& scenario, const World& world, const RayScene& scene,
                              int threads);

}  // namespace gnbv
