// benchmark.stop_at_coverage: the truth ends a mission, as only a benchmark can.
#pragma once

#include <functional>

#include "bench/score/surface_reference.hpp"
#include "planner/core/belief.hpp"
#include "scenarios/scenario.hpp"

namespace gnbv {

/// Share of the voxels of 0.05 m with surface seen from outside that the believed cloud covers:
/// what score_cloud() will call `final` at that size. Each call has to have all points of the one
/// before. Keeps reference and scene.
std::function<double(const Belief&)> coverage_meter(const SurfaceReference& reference,
                                                    const RayScene& scene);

/// Whether the believed cloud covers at least benchmark.stop_at_coverage of the voxels of 0.05 m
/// with surface seen from outside: what score_cloud() will call `final` at that size. Never without
/// the key. For MissionInputs::is_covered of one mission: each call has to have all points of the
/// one before. Keeps the scene's reference.
std::function<bool(const Belief&)> coverage_goal(const BenchmarkConfig& benchmark,
                                                 const SurfaceReference& reference,
                                                 const RayScene& scene);

}  // namespace gnbv
