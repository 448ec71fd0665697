// A planner that knows the true structure: how far any other is from what is possible.
#pragma once

#include "bench/score/surface_reference.hpp"
#include "planner/route/route_planners.hpp"
#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

/// Which share of the cloud of all surveyed views an oracle finds that is not told how much, or is
/// asked for more than that cloud holds.
constexpr double kOracleShare = 0.99;

/// How much more than the least a search of other chance may need for the same share. Measured: 4 %
/// of metres and 5 % of seconds on the aircraft; on smoke, where one view is a tenth of all, 10 %.
constexpr double kOracleSpread = 0.1;

/// What `planner.utility.name`, an oracle's, flies from `start`, by a search for `planner.oracle`
/// alone. Surveys at once (view_survey.hpp) and plans when it is asked: with the mission's own
/// cloud at hand, the profile and the first view in it. Views in the order in which they are to be
/// flown, with the ways there, every one of which keeps the collision radius from the structure.
///
/// The cheapest tour that a large-neighbourhood search finds (covering_tour.hpp), begun with the
/// greedy tour: fewest metres, seconds or views (price_of_view()), after which the cloud
/// (CloudOfViews, in the order of flight) covers what is asked for. Asked again, it adds what the
/// flight missed; nothing more after some routes that found nothing. Deterministic at any number of
/// threads. The best we know; no bound.
///
/// `stop` is called several times a second, by any thread, and may throw. `reference` is what the
/// scenario's missions are scored against. Keeps references to all but `world` and `stop`; copies
/// share what they were asked.
KnownRoute plan_oracle(const Scenario& scenario, const World& world, const RayScene& scene,
                       const SurfaceReference& reference, const ViewPose& start, int threads,
                       const HeedStop& stop = {});

}  // namespace gnbv
