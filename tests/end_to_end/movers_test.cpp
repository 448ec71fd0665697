// Missions among bodies that move.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/score/cloud_metrics.hpp"
#include "tests/support/flown.hpp"
#include "tools/mission/reference.hpp"

namespace gnbv {
namespace {

/// A pillar that goes up and down before the south side, where the mission begins, along y_m.
std::vector<std::string> pillar(bool is_known, const std::string& utility, double y_m = -2.4) {
  return {fmt::format("obstacles=[{{box_m: {{min: [-3.8, {}, 0], max: [-3.4, {}, 3]}}, motion: "
                      "{{waypoints: [{{offset_m: [7.2, 0, 0]}}], speed_m_s: 0.7, known: {}}}}}]",
                      y_m - 0.2, y_m + 0.2, is_known),
          "start.position_m=[0, -3.2, 1.2]",
          "start.jitter_m=[0, 0, 0]",
          "planner.profiling.method=none",
          "planner.utility.name=" + utility,
          "planner.termination.max_iterations=10"};
}

/// Nearest that any recorded pose came to the pillar.
double nearest_m(const Flown& f) {
  double nearest = 1e9;
  for (const TrajectorySample& sample : f.result.trajectory) {
    nearest = std::min(nearest, f.scene.distance_to_known_movers_m(
                                    sample.T_world_body.translation(), sample.time_s, 9.0));
  }
  return nearest;
}

TEST(MovingObstacle, OneWhoseMotionIsKnownIsWaitedForSoThatNobodyComesNearIt) {
  for (const std::string utility : {"proposed", "tour"}) {
    const Flown flown(smoke(pillar(true, utility)));
    EXPECT_NE(flown.result.termination, Termination::collision) << utility;
    EXPECT_GE(nearest_m(flown), 0.95 * flown.scenario.planner.validity.collision_radius_m)
        << utility;
    EXPECT_GE(flown.result.views.size(), 8U);
  }
}

/// It goes by the start itself: who waits there for a way is hit, who gives up there stands still.
TEST(MovingObstacle, OneThatComesToWhereTheVehicleWaitsIsMadeWayFor) {
  for (const std::string utility : {"proposed", "tour"}) {
    const Flown flown(smoke(pillar(true, utility, -2.8)));
    EXPECT_EQ(flown.result.termination, Termination::max_iterations) << utility;
    EXPECT_GT(flown.result.legs_timed_out, 0) << "no leg was given up";
    EXPECT_GE(nearest_m(flown), 0.95 * flown.scenario.planner.validity.collision_radius_m)
        << utility;
    double before_s = -1.0;
    for (const ViewRecord& view : flown.result.views) {
      EXPECT_GT(view.time_s, before_s) << utility << " view " << view.iteration;
      before_s = view.time_s;
    }
  }
}

/// It goes to and fro and stays on the first corner of the way home, behind the structure.
TEST(MovingObstacle, OneInTheWayHomeIsNotFledThroughTheStructure) {
  const std::string round = "{offset_m: [0, -4, 0]}, {offset_m: [0, 0, 0]}, ";
  const Flown flown(
      smoke({"obstacles=[{box_m: {min: [1.9, 1.9, 3.4], max: [2.1, 2.1, 3.6]}, "
             "motion: {waypoints: [" +
                 round + round +
                 "{offset_m: [-1.2, -0.8, -1.6]}], speed_m_s: 0.19, loop: false, "
                 "known: true}}]",
             "vehicle.power.return_home=true", "planner.utility.name=route",
             "planner.routes.views=[{position_m: [0, 2.8, 1], yaw_deg: -90}]"}));
  EXPECT_GT(flown.result.legs_timed_out, 0) << "no leg was given up";
  EXPECT_EQ(flown.result.termination, Termination::route_flown);
}

TEST(MovingObstacle, IsSeenAndItsOldPlacesAreSeenToBeFreeAgain) {
  const Flown flown(smoke(pillar(false, "proposed")));
  // on its way, beyond all of the structure, what was seen occupied
  const OccupancyGrid& grid = flown.result.belief.grid;
  const GridGeometry& voxels = grid.geometry();
  const double last_s = flown.result.views.back().time_s;
  std::size_t phantom = 0, freed = 0;
  for (VoxelIndex v = 0; v < voxels.voxel_count(); ++v) {
    const Vec3 p_m = voxels.center_m(voxels.key_at(v));
    if (p_m.y() > -2.0 || p_m.y() < -2.8 || p_m.z() < 0.4 || p_m.z() > 2.8) continue;
    const RayScene now = flown.scene.at(last_s);
    freed += grid.state(v) == VoxelState::free;
    phantom += grid.state(v) == VoxelState::occupied;
  }
  EXPECT_GT(freed, 5 * phantom);
  // of the cloud none of its points is scored as the structure's
  std::size_t seen = 0;
  const auto points = flown.result.belief.cloud.points_world_m();
  const std::vector<std::uint8_t> is_kept = points_of_structure(flown.scene, points, 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].y() > -2.15F || points[i].z() < 0.35F) continue;
    ++seen;
    EXPECT_EQ(is_kept[i], 0) << points[i].transpose();
  }
  EXPECT_GT(seen, 20U);
}

}  // namespace
}  // namespace gnbv
