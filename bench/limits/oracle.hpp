// A planner that knows the true structure: how far any other is from what is possible.
#pragma once

#include <array>
#include <vector>

#include "bench/score/surface_reference.hpp"
#include "planner/core/plan.hpp"
#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

enum class OracleAim { views, metres };

/// Which share of the leaf ceiling's finest voxels the views are to find.
constexpr double kOracleShare = 0.99;

/// What a view costs beside its metres, for the aim metres, and what it does to the greedy choice
/// that the search begins with: there a low price wastes views.
constexpr double kMetresPerView = 0.3;
constexpr double kGreedyMetresPerView = 1.0;

/// The views after the first one, which is `start`, in the order in which they are to be flown,
/// with the ways there, every one of which keeps the collision radius from the structure.
///
/// The cheapest tour that a large-neighbourhood search finds (covering_tour.hpp) among the views of
/// the survey (view_survey.hpp), begun with the greedy tour: fewest metres and kMetresPerView, or
/// fewest views, whose cloud (CloudOfViews, in the order of flight) holds kOracleShare of what that
/// of all views holds. Deterministic at any number of threads. The best we know; no bound.
/// `stop` is called several times a second, by any thread, and may throw.
/// `reference` is what the scenario's missions are scored against.
std::vector<Decision> plan_oracle(const Scenario& scenario, const World& world,
                                  const RayScene& scene, const SurfaceReference& reference,
                                  const ViewPose& start, OracleAim aim, int threads,
                                  const HeedStop& stop = {});

/// Shares of what the cloud of all views holds that are asked of an oracle.
constexpr std::array<double, 4> kOracleReachShares = {0.90, 0.95, 0.98, 0.99};

/// A tour with few metres to one such share, planned for this share alone unless that for a larger
/// one is shorter, and the greedy one that finds as much of the survey. Lengths in m, of the ways
/// as they would be flown.
struct OracleReach {
  double share = 0.0;
  std::size_t views = 0;  // after the first
  double length_m = 0.0;
  std::size_t greedy_views = 0;
  double greedy_m = 0.0;
};

/// By kOracleReachShares. Takes as long as so many calls of plan_oracle.
std::vector<OracleReach> oracle_reaches(const Scenario& scenario, const World& world,
                                        const RayScene& scene, const SurfaceReference& reference,
                                        const ViewPose& start, int threads);

}  // namespace gnbv
