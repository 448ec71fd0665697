// Missions of the oracle: planned on the mesh, flown and scored like the others.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "bench/limits/oracle.hpp"
#include "sim/core/error.hpp"
#include "tests/support/flown_into.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/mission/reference.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_directory.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

Scenario oracle_smoke(const std::string& utility, const std::string& max_iterations = "100") {
  // an entropy that hardly changes would end any other mission
  return smoke({"planner.utility.name=" + utility,
                "planner.termination.max_iterations=" + max_iterations,
                "planner.termination.entropy_change_percent=1"});
}

const std::vector<Decision>& route_of(const std::string& utility) {
  static std::map<std::string, std::vector<Decision>> routes;
  if (!routes.contains(utility)) {
    setenv("GNBV_CACHE", "", 1);
    const Scenario scenario = oracle_smoke(utility);
    std::vector<std::string> warnings;
    const World world = load_world(scenario, warnings);
    const RayScene scene(world);
    const OracleAim aim =
        traits_of(scenario.planner).counts_metres ? OracleAim::metres : OracleAim::views;
    routes[utility] = plan_oracle(scenario, world, scene, reference_of(scenario, world, scene, 2),
                                  start_pose(scenario, scene), aim, 2);
  }
  return routes[utility];
}

MissionInputs with_route(const std::string& utility) {
  MissionInputs inputs;
  inputs.sources.route = route_of(utility);
  return inputs;
}

class OracleMission : public testing::TestWithParam<const char*> {};

TEST_P(OracleMission, FliesItsWholeRouteAndFindsNearlyAll) {
  const std::string utility = GetParam();
  const Flown flight(oracle_smoke(utility), with_route(utility));
  EXPECT_EQ(flight.result.termination, Termination::route_flown);
  ASSERT_EQ(flight.result.views.size(), route_of(utility).size() + 1);
  EXPECT_EQ(flight.result.legs_timed_out, 0);
  for (std::size_t i = 1; i < flight.result.views.size(); ++i) {
    const Decision& flown = flight.result.views[i].decision;
    EXPECT_EQ(flown.view.p_world_m, route_of(utility)[i - 1].view.p_world_m);
    EXPECT_EQ(flown.sampler, Sampler::oracle);
  }
  const SurfaceReference reference = make_surface_reference(
      flight.world, flight.scene, {.floor_z_m = flight.scenario.planner.floor_z_m}, 2);
  // all of smoke can be seen; what a real vehicle's errors cost beside kOracleShare is little
  const std::array<double, 3> coverage =
      coverage_at_all_sizes(reference.outside, flight.result.belief.cloud.points_world_m());
  EXPECT_GT(coverage[0], kOracleShare - 0.03);
}

TEST_P(OracleMission, IsCutOffAtMaxIterations) {
  const std::string utility = GetParam();
  const Flown flight(oracle_smoke(utility, "3"), with_route(utility));
  EXPECT_EQ(flight.result.termination, Termination::max_iterations);
  EXPECT_EQ(flight.result.views.size(), 3U);
}

INSTANTIATE_TEST_SUITE_P(BothAims, OracleMission, testing::Values("oracle_views", "oracle_metres"));

TEST(OracleRoute, WithoutOneTheMissionIsRefused) {
  EXPECT_THROW(Flown(oracle_smoke("oracle_views")), BrokenInvariant);
}

TEST(OracleRoute, EmptyEndsAfterTheFirstView) {
  MissionInputs inputs;
  inputs.sources.route.emplace();
  const Flown flight(oracle_smoke("oracle_views"), inputs);
  EXPECT_EQ(flight.result.termination, Termination::route_flown);
  EXPECT_EQ(flight.result.views.size(), 1U);
}

}  // namespace
}  // namespace gnbv
