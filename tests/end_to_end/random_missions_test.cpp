// No mission with a utility that reads the map ends before 20 views while a frontier can be
// reached, whatever it flies around. One seed of every kind of random structure in ctest;
// tools/random_missions asks for more, by GNBV_RANDOM_SEEDS=FIRST-LAST, and gets its table by
// GNBV_RANDOM_TABLE=FILE.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <optional>
#include <set>
#include <vector>

#include "planner/core/belief.hpp"
#include "planner/guided/utility.hpp"
#include "planner/guided/view_sampling.hpp"
#include "planner/map/frontiers.hpp"
#include "planner/motion/free_space.hpp"
#include "planner/motion/paths.hpp"
#include "scenarios/load.hpp"
#include "tests/support/random_structures.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/watch.hpp"
#include "tools/mission/auto_bounds.hpp"
#include "tools/mission/mission.hpp"

namespace gnbv {
namespace {

/// Every place of a lattice with a step of `step_m` that can be flown to from `from_m`, along its
/// lines, through voxels known to be free, the collision sphere clear and within the navigation
/// box. The first is `from_m`.
std::vector<Vec3> reachable_places(const PlannerModel& model, const Belief& belief,
                                   const Vec3& from_m, double step_m) {
  const double radius_m = model.validity.collision_radius_m;
  using Node = std::array<int, 3>;
  std::set<Node> known = {{0, 0, 0}};
  std::deque<Node> open = {{0, 0, 0}};
  std::vector<Vec3> places;
  const auto place_m = [&](const Node& n) -> Vec3 {
    return from_m + step_m * Vec3(n[0], n[1], n[2]);
  };
  while (!open.empty()) {
    const Node node = open.front();
    open.pop_front();
    places.push_back(place_m(node));
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1}) {
        Node next = node;
        next[axis] += way;
        const Vec3 to_m = place_m(next);
        if (known.contains(next) || !model.navigation_m.contains(to_m) ||
            !is_line_free(belief.grid, places.back(), to_m) ||
            !is_sphere_clear(belief.grid, to_m, radius_m) ||
            !is_path_clear(belief.grid, places.back(), to_m, radius_m)) {
          continue;
        }
        known.insert(next);
        open.push_back(next);
      }
  }
  return places;
}

/// A view of a frontier from one of these places that was not taken yet, looking straight at the
/// frontier's centroid; nothing where there is none.
std::optional<ViewPose> view_of_a_frontier(const PlannerModel& model, const FrontierConfig& config,
                                           const Belief& belief, const std::vector<Vec3>& places_m,
                                           const std::vector<ViewPose>& taken) {
  FrontierMarks marks(belief.grid.geometry().voxel_count());
  const ValidityConfig& validity = model.validity;
  const auto is_taken = [&](const ViewPose& view) {
    for (const ViewPose& t : taken) {
      const double turn_rad = std::abs(wrap_angle_rad(t.yaw_rad - view.yaw_rad));
      if ((t.p_world_m - view.p_world_m).norm() < validity.recent_distance_m &&
          turn_rad < validity.recent_yaw_rad)
        return true;
    }
    return false;
  };
  for (const FrontierCluster& cluster : find_frontiers(config, belief.grid, belief.cloud, marks))
    for (const Vec3& p_m : places_m) {
      const Vec3 to_m = cluster.centroid_world_m - p_m;
      const ViewPose view = {p_m, std::atan2(to_m.y(), to_m.x())};
      if (!is_taken(view) && !cluster_rejection(model.cameras, belief.grid, cluster, view, true))
        return view;
    }
  return std::nullopt;
}

constexpr int kViews = 20;

/// The aircraft's mission around it, coarse: voxels of half a metre, images of 64 x 48, a fast
/// profile of few beams, and no search for symmetry, which only predicts surface.
Scenario coarse_scenario(const TriangleMesh& mesh) {
  Scenario scenario =
      load_scenario("aircraft", {"planner.map.resolution_m=0.5", "vehicle.kind=ideal",
                                 "guidance.profile_speed_m_s=4", "planner.cloud.leaf_m=0.1",
                                 "planner.symmetry.enabled=false",
                                 fmt::format("planner.termination.max_iterations={}", kViews)});
  for (CameraConfig& camera : scenario.cameras) {
    camera.width_px = 64;
    camera.height_px = 48;
  }
  for (LidarConfig& lidar : scenario.lidars) {
    lidar.beams = 181;
    lidar.rate_hz = 10.0;
  }
  return with_bounds_around(scenario, extent_of(mesh));
}

/// A random structure with its profile, which all missions around it begin with.
class Site {
 public:
  explicit Site(const RandomStructure& structure)
      : scenario(coarse_scenario(structure.mesh)),
        world_{.structure = structure.mesh, .has_ground = true},
        scene_(world_) {
    Watch watch;
    Scenario profile = scenario;
    profile.planner.termination.max_iterations = 1;
    watch.profile_belief = [&](const Belief& belief) { write_belief(belief, profile_file()); };
    run_mission(profile, world_, scene_, {.observers = {&watch}}, 2);
    scenario.planner.profiling.method = ProfilingMethod::saved;
    scenario.planner.profiling.file = profile_file();
  }

  MissionResult fly(std::string_view utility) {
    scenario.planner.utility.name = utility;
    return run_mission(scenario, world_, scene_, {}, 2);
  }

  /// As run_mission() makes it.
  PlannerModel planner() const { return planner_model(scenario); }

  Scenario scenario;

 private:
  std::string profile_file() const { return (temp_.path() / "profile.map").string(); }

  TempFolder temp_;
  World world_;
  RayScene scene_;
};

/// The view that the mission should have gone on with; nothing if it was right to end.
std::optional<ViewPose> missed_view(const PlannerModel& planner, const FrontierConfig& frontier,
                                    const MissionResult& result) {
  constexpr double kStep_m = 1.0;
  std::vector<ViewPose> taken;
  for (const ViewRecord& view : result.views) taken.push_back(view.decision.view);
  return view_of_a_frontier(
      planner, frontier, result.belief,
      reachable_places(planner, result.belief, taken.back().p_world_m, kStep_m), taken);
}

std::pair<std::uint64_t, std::uint64_t> seeds_to_fly() {
  const char* const text = std::getenv("GNBV_RANDOM_SEEDS");
  std::pair<std::uint64_t, std::uint64_t> seeds = {1, 1};
  if (text != nullptr) {
    EXPECT_EQ(std::sscanf(text, "%lu-%lu", &seeds.first, &seeds.second), 2) << text;
    EXPECT_LE(seeds.first, seeds.second);
  }
  return seeds;
}

/// A row a mission: kind, seed, utility, views, how it ended, whether a frontier could be reached.
void tabulate(const RandomStructure& r, std::string_view utility, const MissionResult& result,
              bool was_reachable) {
  const char* const file = std::getenv("GNBV_RANDOM_TABLE");
  if (file == nullptr) return;
  std::ofstream(file, std::ios::app)
      << fmt::format("{},{},{},{},{},{}\n", r.kind, r.seed, utility, result.views.size(),
                     name_of(result.termination), was_reachable ? "reachable" : "none");
}

class RandomMission : public testing::TestWithParam<std::string_view> {};

TEST_P(RandomMission, GoesOnWhileAFrontierCanBeReached) {
  const auto [first, last] = seeds_to_fly();
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    const RandomStructure r = {GetParam(), seed, make_random_structure(seed, GetParam())};
    Site site(r);
    for (const std::string_view utility : utility_names()) {
      if (utility == "random") continue;  // reads no map
      const MissionResult result = site.fly(utility);
      std::optional<ViewPose> missed;
      if (result.views.size() < kViews) {
        missed = missed_view(site.planner(), site.scenario.planner.fvs.frontier, result);
      }
      EXPECT_NE(result.termination, Termination::collision) << r.name() << ' ' << utility;
      EXPECT_FALSE(missed) << fmt::format(
          "{}, {}: ended by {} after {} views, but a frontier is seen from [{:.2f}, {:.2f}, "
          "{:.2f}]",
          r.name(), utility, name_of(result.termination), result.views.size(),
          missed->p_world_m.x(), missed->p_world_m.y(), missed->p_world_m.z());
      tabulate(r, utility, result, missed.has_value());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Random, RandomMission, testing::ValuesIn(kRandomKinds),
                         [](const auto& kind) { return std::string(kind.param); });

}  // namespace
}  // namespace gnbv
