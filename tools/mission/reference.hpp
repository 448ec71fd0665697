// What a scenario's missions are scored against: the true surface, and how much of it can be had.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "bench/limits/ceiling.hpp"
#include "bench/score/mission_score.hpp"
#include "bench/score/run_figures.hpp"
#include "bench/score/surface_reference.hpp"
#include "planner/core/belief.hpp"
#include "scenarios/scenario.hpp"

namespace gnbv {

/// From the cache, or found, which is said beforehand where it takes long, and shown as it goes on.
/// Throws BadInput when there is nothing to measure, no surface above the scenario's floor is
/// counted, and when the machine has not the memory to find it.
SurfaceReference reference_of(const Scenario& scenario, const World& world, const RayScene& scene,
                              int threads,
                              const std::function<void(const std::string& note)>& show = {});

/// Whether what looks measures with noise or is skewed in flight, or the pose is estimated.
bool is_noisy(const Scenario& scenario);

/// A cloud's score as the scenario asks for it: within its region, at its sizes, by its budgets.
MissionScore score_as_asked(const Scenario& scenario, const World& world, const RayScene& scene,
                            const SurfaceReference& reference, ScoredCloud cloud, int threads);

/// How a ceiling is come by: read when an earlier command left it in the cache, or found anew,
/// which may take longer than the mission.
enum class CeilingFrom { cache, search };

/// The coverage at 0.05 m that the cloud of this scenario can reach (Ceiling::leaf_counted), which
/// a run's effort is measured by. Nothing when the cache does not have it, or when there is nothing
/// to reach.
std::optional<double> run_ceiling(const Scenario& scenario, const World& world,
                                  const RayScene& scene, CeilingFrom from, int threads);

/// Share of the voxels of 0.05 m that coverage counts which the believed cloud covers: what
/// score_cloud() will call `final` at that size. Each call has to have all points of the one
/// before. Keeps reference and scene.
std::function<double(const Belief&)> coverage_meter(const SurfaceReference& reference,
                                                    const RayScene& scene);

/// benchmark.stop_at_coverage, by which the truth ends a mission, as only a benchmark can: whether
/// coverage_meter()'s share is that much. Never without the key. For MissionInputs::is_covered.
std::function<bool(const Belief&)> coverage_goal(const BenchmarkConfig& benchmark,
                                                 const SurfaceReference& reference,
                                                 const RayScene& scene);

}  // namespace gnbv
