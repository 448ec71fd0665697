// Missions of oracles: planned on the mesh, flown and scored like the others, and with less effort.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "bench/limits/oracle.hpp"
#include "sim/core/error.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/known_inputs.hpp"
#include "tools/mission/reference.hpp"

namespace gnbv {
namespace {

struct ScoredFlight {
  MissionResult result;
  MissionScore score;

  /// From the first view on until the cloud covered so much; without end where it never did.
  double effort_to(double coverage, Effort effort) const {
    const auto reached = entry_that_covers(score.curve, coverage);
    if (!reached) return std::numeric_limits<double>::infinity();
    if (effort == Effort::metres) return score.curve.metres[*reached];
    return seconds_of_views(score.curve, *reached);
  }
};

/// Smoke with a planner, to its end: an entropy that hardly changes would end any other mission.
ScoredFlight fly(const std::string& utility, double coverage = 0.0) {
  Scenario scenario =
      smoke({"planner.utility.name=" + utility, "planner.termination.max_iterations=100",
             "planner.termination.entropy_change_percent=1"});
  scenario.planner.oracle.coverage = coverage;
  const World world = world_of(scenario);
  const RayScene scene(world);
  const SurfaceReference reference = reference_of(scenario, world, scene, 2);
  MissionResult result =
      run_mission(scenario, world, scene, known_inputs(scenario, world, scene, reference), 2);
  const double voxel_m = scenario.planner.map.resolution_m;
  MissionScore score = score_cloud(reference, scene, scored_cloud(scenario, result), voxel_m, 2);
  return {std::move(result), std::move(score)};
}

void expect_whole_route(const ScoredFlight& flight) {
  EXPECT_EQ(flight.result.termination, Termination::route_flown);
  EXPECT_EQ(flight.result.legs_timed_out, 0);
  for (std::size_t i = 1; i < flight.result.views.size(); ++i) {
    EXPECT_EQ(flight.result.views[i].decision.sampler, Sampler::oracle);
  }
  EXPECT_GT(flight.score.final[0], kOracleShare - 0.01);  // all of smoke can be seen
}

TEST(OracleRoute, EmptyEndsAfterTheFirstViewAndNoneIsRefused) {
  EXPECT_THROW(Flown(smoke({"planner.utility.name=oracle_views"})), BrokenInvariant);
  const Flown flight(smoke({"planner.utility.name=oracle_views"}),
                     {.sources = {.route = [](const SurfaceCloud&, const HeedStop&) {
                        return std::vector<Decision>();
                      }}});
  EXPECT_EQ(flight.result.termination, Termination::route_flown);
  EXPECT_EQ(flight.result.views.size(), 1U);
}

/// Of all that take their frames at stops. As in tables, of an oracle's missions the least counts.
/// Every oracle flies its whole route and finds nearly all.
TEST(OracleMission, NobodyReachesAShareWithLessThanTheOracleOfThisShare) {
  std::vector<std::pair<std::string, ScoredFlight>> flights;
  for (const std::string_view name : planner_names()) {
    const std::string utility(name);
    const PlannerTraits traits = traits_of(smoke({"planner.utility.name=" + utility}).planner);
    if (traits.takes_views) continue;
    flights.emplace_back(utility, fly(utility));
    if (traits.knows_structure) expect_whole_route(flights.back().second);
    if (!traits.counts_metres && !traits.counts_seconds) continue;
    for (const double share : kReachShares) {
      flights.emplace_back(utility, fly(utility, share));
      EXPECT_GE(flights.back().second.score.final[0], share);
    }
  }
  for (const auto& [oracle, effort] :
       {std::pair("oracle_metres", Effort::metres), std::pair("oracle_seconds", Effort::seconds)}) {
    for (const double share : kReachShares) {
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [utility, flight] : flights) {
        if (utility == oracle) least = std::min(least, flight.effort_to(share, effort));
      }
      for (const auto& [utility, flight] : flights) {
        const double spent = flight.effort_to(share, effort);
        EXPECT_GE(spent * (1.0 + kOracleSpread), least)
            << utility << ", " << oracle << ", " << share;
      }
    }
  }
}

}  // namespace
}  // namespace gnbv
