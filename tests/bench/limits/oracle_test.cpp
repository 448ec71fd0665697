#include "bench/limits/oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "bench/limits/ceiling.hpp"
#include "bench/limits/cloud_of_views.hpp"
#include "bench/limits/lattice_ways.hpp"
#include "bench/limits/view_survey.hpp"
#include "planner/motion/paths.hpp"
#include "sim/flight/guidance.hpp"
#include "tests/bench/limits/limits_setting.hpp"

namespace gnbv {
namespace {

constexpr std::array<const char*, 3> kAims = {"oracle_views", "oracle_metres", "oracle_seconds"};

/// The smoke scenario as an oracle sees it.
struct Smoke : LimitsSetting {
  explicit Smoke(const std::string& utility = kAims[1], double coverage = 0.0,
                 std::uint64_t search_seed = 0)
      : LimitsSetting(load_scenario("smoke", {"planner.utility.name=" + utility})) {
    scenario.planner.oracle = {coverage, search_seed};
  }

  /// After the first view and some more.
  SurfaceCloud cloud_after(std::span<const Decision> views = {}) const {
    CloudOfViews cloud(scenario, reference.counted[0]);
    std::vector<FrameRays> rays;
    const auto add = [&](const ViewPose& view) {
      take_view(scene, exact_cameras(scenario), view, scenario.planner.floor_z_m, 1, rays);
      cloud.add(rays);
    };
    add(start);
    for (const Decision& view : views) add(view.view);
    return cloud.cloud();
  }
  double coverage_of(const SurfaceCloud& cloud) const {
    return coverage_at_all_sizes(reference.counted, cloud.points_world_m())[0];
  }
  KnownRoute oracle() const { return plan_oracle(scenario, world, scene, reference, start, 2); }
  std::vector<Decision> route() const { return oracle()(cloud_after(), {}); }
};

const Smoke& smoke() {
  static const Smoke made;
  return made;
}

const std::vector<Decision>& route(const std::string& utility) {
  static std::map<std::string, std::vector<Decision>> routes;
  if (!routes.contains(utility)) routes[utility] = Smoke(utility).route();
  return routes[utility];
}

const ViewSurvey& survey() {
  static const ViewSurvey made =
      survey_views(smoke().scenario, smoke().scene, smoke().legal, smoke().reference, 2);
  return made;
}

double length_m(const std::vector<Decision>& views) {
  double total_m = 0.0;
  Vec3 at_m = smoke().start.p_world_m;
  for (const Decision& view : views) {
    total_m += path_length_m(at_m, view.via_world_m, view.view.p_world_m);
    at_m = view.view.p_world_m;
  }
  return total_m;
}

/// Leg by leg, each from rest to rest.
double duration_s(const std::vector<Decision>& views) {
  const Scenario& scenario = smoke().scenario;
  double total_s = 0.0;
  ViewPose at = smoke().start;
  const auto fly_to = [&](const ViewPose& next) {
    total_s += leg_duration_s(at, next, scenario.guidance.path_speed_m_s, scenario.guidance,
                              scenario.vehicle);
    at = next;
  };
  for (const Decision& view : views) {
    for (const Vec3& via_m : view.via_world_m) fly_to({via_m, view.view.yaw_rad});
    fly_to(view.view);
  }
  return total_s;
}

void expect_radius_kept(const std::vector<Decision>& views) {
  const Smoke& s = smoke();
  const ValidityConfig& validity = s.scenario.planner.validity;
  const Box3 box = navigation_box_m(validity, s.scenario.workspace_m);
  Vec3 at_m = s.start.p_world_m;
  for (const Decision& view : views) {
    std::vector<Vec3> points_m = view.via_world_m;
    points_m.push_back(view.view.p_world_m);
    for (const Vec3& next_m : points_m) {
      for (double t = 0.0; t <= 1.0; t += 0.01) {
        const Vec3 p = (1.0 - t) * at_m + t * next_m;
        ASSERT_GE(s.scene.distance_to_structure_m(p, 100.0), validity.collision_radius_m - 1e-9);
        ASSERT_LT(box.squaredExteriorDistance(p), 1e-12);
      }
      at_m = next_m;
    }
  }
}

/// No view twice, and places one after the other.
void expect_in_order(const std::vector<Decision>& chosen) {
  std::set<std::array<double, 4>> views;
  std::set<std::array<double, 3>> left;  // places, once flown on from
  Vec3 at_m = smoke().start.p_world_m;
  for (const Decision& view : chosen) {
    const Vec3& p = view.view.p_world_m;
    EXPECT_TRUE(views.insert({p.x(), p.y(), p.z(), view.view.yaw_rad}).second);
    if (p != at_m) {
      EXPECT_FALSE(left.contains({p.x(), p.y(), p.z()}));
      left.insert({at_m.x(), at_m.y(), at_m.z()});
    }
    at_m = p;
    EXPECT_EQ(view.sampler, Sampler::oracle);
  }
}

/// One test, since each of its own would search the routes again.
TEST(Oracle, RoutesAreLegalFindTheirShareOfWhatAllViewsKeepAndNeedLeastOfWhatTheyCount) {
  const Smoke& s = smoke();
  for (const std::string aim : kAims) {
    SCOPED_TRACE(aim);
    expect_radius_kept(route(aim));
    expect_in_order(route(aim));
    const double coverage = s.coverage_of(s.cloud_after(route(aim)));
    EXPECT_GE(coverage, kOracleShare * survey().leaf_counted[0]);
    EXPECT_LE(coverage, survey().leaf_counted[0] + 0.01);
    EXPECT_LE(route("oracle_views").size(), route(aim).size());
    EXPECT_LE(length_m(route("oracle_metres")), length_m(route(aim)) * (1.0 + kOracleSpread));
    EXPECT_LE(duration_s(route("oracle_seconds")), duration_s(route(aim)) * (1.0 + kOracleSpread));
  }
  EXPECT_LT(length_m(route("oracle_metres")), length_m(route("oracle_views")));
}

/// The spread is that of three searches; each of them is for its share alone.
TEST(Oracle, NeedsMoreForMoreWhateverItsSearchLeavesToChance) {
  double least_m = 0.0;  // for the share before
  for (const double share : {0.8, 0.95}) {
    std::vector<double> lengths_m;
    for (const std::uint64_t seed : {0, 1, 2}) {
      const Smoke s(kAims[1], share, seed);
      const std::vector<Decision> views = s.route();
      EXPECT_GE(s.coverage_of(s.cloud_after(views)), share);
      lengths_m.push_back(length_m(views));
    }
    const auto [shortest_m, longest_m] = std::ranges::minmax(lengths_m);
    EXPECT_LE(longest_m, shortest_m * (1.0 + kOracleSpread)) << share;
    EXPECT_GT(shortest_m, least_m) << share;
    least_m = shortest_m;
  }
}

TEST(Oracle, AddsWhatTheFlightMissedAndStopsWhereViewsFindNothing) {
  const Smoke& s = smoke();
  const double enough = kOracleShare * survey().leaf_counted[0];
  const KnownRoute oracle = s.oracle();
  std::vector<Decision> flown = oracle(s.cloud_after(), {});
  flown.resize(flown.size() / 2);  // what the others saw was lost
  ASSERT_LT(s.coverage_of(s.cloud_after(flown)), enough);
  const std::vector<Decision> more = oracle(s.cloud_after(flown), {});
  flown.insert(flown.end(), more.begin(), more.end());
  EXPECT_GE(s.coverage_of(s.cloud_after(flown)), enough);
  EXPECT_TRUE(oracle(s.cloud_after(flown), {}).empty());
  const KnownRoute blind = s.oracle();
  int routes = 0;
  while (!blind(s.cloud_after(), {}).empty()) ASSERT_LT(++routes, 10);
  EXPECT_GT(routes, 1);
}

TEST(LatticeWays, RowsAreNoShorterThanTheWays) {
  const Smoke& s = smoke();
  LatticeWays ways(s.scene, s.legal, s.scenario.planner.validity.collision_radius_m);
  std::vector<std::size_t> places = {ways.start()};
  for (std::size_t place = 0; place < s.legal.size(); place += 293) places.push_back(place);
  ways.prepare(places, 2);
  int bent = 0;
  for (const std::size_t from : places) {
    const std::vector<float> row_m = ways.distances_m(from, places, 2);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double straight_m = (ways.p_world_m(places[i]) - ways.p_world_m(from)).norm();
      const double way_m = ways.way(from, places[i]).length_m;
      EXPECT_GE(static_cast<double>(row_m[i]), (straight_m <= 12.0 ? way_m : straight_m) - 1e-5);
      bent += way_m > straight_m + 1e-9 ? 1 : 0;
    }
  }
  EXPECT_GT(bent, 0);
}

TEST(ViewSurvey, FindsNoMoreAloneThanThereIsAndTogetherWhatTheCloudKeeps) {
  const std::size_t voxels = smoke().reference.counted[0].size();
  std::vector<bool> found(voxels, false);
  ASSERT_FALSE(survey().views.empty());
  for (const SurveyedView& view : survey().views) {
    EXPECT_TRUE(std::is_sorted(view.finds.begin(), view.finds.end()));
    for (const std::uint32_t voxel : view.finds) found.at(voxel) = true;
  }
  const auto together = static_cast<double>(std::count(found.begin(), found.end(), true));
  // a leaf of the common cloud keeps one view's centroid, of all that the views alone would keep
  EXPECT_LE(survey().leaf_counted[0], together / static_cast<double>(voxels) + 1e-12);
}

/// A closed room: something is in sight wherever a camera looks.
TEST(ViewSurvey, LooksFromFewerPositionsWhereThereWouldBeTooManyViews) {
  const LimitsSetting room(load_scenario(
      "smoke",
      {"cameras.0.width_px=16", "cameras.0.height_px=12", "planner.validity.collision_radius_m=0.4",
       "obstacles=[{box_m: {min: [-4, -4, 0], max: [4, -3.9, 5]}}, "
       "{box_m: {min: [-4, 3.9, 0], max: [4, 4, 5]}}, "
       "{box_m: {min: [-4, -3.9, 0], max: [-3.9, 3.9, 5]}}, "
       "{box_m: {min: [3.9, -3.9, 0], max: [4, 3.9, 5]}}]"}));
  const ViewSurvey found = survey_views(room.scenario, room.scene, room.legal, room.reference, 2);
  EXPECT_LE(found.views.size(), kManySurveyedViews);
  EXPECT_GT(found.views.size(), kManySurveyedViews / 8);
  const std::size_t even = std::ranges::count_if(room.legal.cell, [](const auto& cell) {
    return cell[0] % 2 == 0 && cell[1] % 2 == 0 && cell[2] % 2 == 0;
  });
  EXPECT_GT(7 * even, kManySurveyedViews) << "else it shows nothing";
  for (const SurveyedView& view : found.views) {
    for (const std::int32_t c : room.legal.cell[view.position]) ASSERT_EQ(c % 3, 0);
  }
}

TEST(ViewSurvey, SkipsNoPositionWhereCamerasReachNoFartherThanFourSteps) {
  const Scenario near_sighted = load_scenario("smoke", {"cameras.0.range_max_m=2.5"});
  const auto looks_from_odd_cells = [&](double step_m) {
    const Smoke& s = smoke();
    const ValidityConfig& validity = near_sighted.planner.validity;
    const LegalViewpoints legal =
        find_legal_viewpoints(s.scene, navigation_box_m(validity, near_sighted.workspace_m),
                              validity.collision_radius_m, step_m, s.start.p_world_m, 2);
    const ViewSurvey found = survey_views(near_sighted, s.scene, legal, s.reference, 2);
    EXPECT_FALSE(found.views.empty());
    return std::any_of(found.views.begin(), found.views.end(), [&](const SurveyedView& view) {
      const auto& cell = legal.cell[view.position];
      return cell[0] % 2 != 0 || cell[1] % 2 != 0 || cell[2] % 2 != 0;
    });
  };
  EXPECT_FALSE(looks_from_odd_cells(0.6));
  EXPECT_TRUE(looks_from_odd_cells(0.65));
}

TEST(CeilingCache, GivesBackWhatWasPutIn) {
  const std::string bytes = bytes_of(survey());
  const auto read = survey_in(bytes);
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(bytes_of(*read), bytes);
  ASSERT_EQ(read->views.size(), survey().views.size());
  for (std::size_t i = 0; i < read->views.size(); ++i) {
    EXPECT_EQ(read->views[i].position, survey().views[i].position);
    EXPECT_EQ(read->views[i].yaw_rad, survey().views[i].yaw_rad);
    EXPECT_EQ(read->views[i].finds, survey().views[i].finds);
  }
  EXPECT_FALSE(survey_in(bytes.substr(0, bytes.size() - 1)));
  EXPECT_FALSE(survey_in(bytes + "x"));
}

/// As content of a sweep and as key of the cache.
TEST(CeilingKey, ChangesWithAllThatTheResultDependsOnAndWithNothingElse) {
  const Smoke& s = smoke();
  std::set<std::string> keys = {ceiling_key(s.scenario, s.world, s.legal)};
  const auto key_of = [&](const Scenario& scenario) {
    return ceiling_key(scenario, s.world, find_legal_viewpoints(scenario, s.scene, s.start, 2));
  };
  const auto content_of = [](const Scenario& scenario) {
    return to_yaml(what_a_ceiling_depends_on(scenario));
  };
  for (const std::string set : {"cameras.0.fov_y_deg=50",
                                "cameras.0.range_max_m=4",
                                "cameras.0.width_px=80",
                                "cameras.0.pitch_deg=9",
                                "planner.floor_z_m=0.2",
                                "planner.cloud.leaf_m=0.06",
                                "planner.map.resolution_m=0.1",
                                "workspace_m.max=[4,4,6]",
                                "planner.validity.collision_radius_m=0.9",
                                "planner.validity.z_min_m=0.8",
                                "lidars.0.pitch_deg=5",
                                "lidars.0.range_max_m=12",
                                "lidars.0.looks=views",
                                "planner.profiling.method=none",
                                "planner.profiling.scan_in_transit=false",
                                "score.region_m={max: [0, 5, 5]}",
                                "no_fly=[{min: [3, 3, 3], max: [4, 4, 4]}]",
                                "no_fly=[{min: [30, 3, 3], max: [40, 4, 4]}]",
                                "start.position_m=[0, 2.8, 1.2]",
                                "score.reference=area_samples",
                                "score={reference: area_samples, area_samples: 99}"}) {
    const Scenario other = load_scenario("smoke", {set});
    EXPECT_TRUE(keys.insert(key_of(other)).second) << set;
    EXPECT_NE(content_of(other), content_of(s.scenario)) << set;
  }
  // beams are the pixels of a LIDAR that looks
  Scenario looking = load_scenario("smoke", {"lidars.0.looks=views"});
  for (const int beams : {2, 1000}) {
    looking.lidars[0].beams = beams;
    EXPECT_TRUE(keys.insert(key_of(looking)).second) << beams;
  }
  // by the mesh in the key, by the name in the content
  for (const char* set : {"seed=2", "structure.builtin=lab_model", "structure.ground=false",
                          "obstacles=[{box_m: {min: [2, 2, 0], max: [3, 3, 1]}}]"}) {
    EXPECT_NE(content_of(load_scenario("smoke", {set})), content_of(s.scenario)) << set;
  }
  // as a radius that moves no position of the lattice
  Scenario nearer = s.scenario;
  nearer.planner.validity.collision_radius_m += 1e-3;
  EXPECT_TRUE(keys.insert(ceiling_key(nearer, s.world, s.legal)).second);
  LegalViewpoints shifted = s.legal;
  for (auto& cell : shifted.cell) ++cell[0];
  EXPECT_TRUE(keys.insert(ceiling_key(s.scenario, s.world, shifted)).second);
  World moved = s.world;
  moved.structure.vertices_m[0].x() += 0.01F;
  EXPECT_TRUE(keys.insert(ceiling_key(s.scenario, moved, s.legal)).second);
  for (TriangleMesh World::*const around : {&World::obstacles, &World::terrain}) {
    World more = s.world;
    more.*around = box_mesh(Box3(Vec3(3, 3, 0), Vec3(4, 4, 1)));
    EXPECT_TRUE(keys.insert(ceiling_key(s.scenario, more, s.legal)).second);
  }
  World floating = s.world;
  floating.has_ground = false;
  EXPECT_TRUE(keys.insert(ceiling_key(s.scenario, floating, s.legal)).second);
  for (const std::string set :
       {"planner.utility.name=isler", "planner.termination.max_iterations=3",
        "planner.agvs.step_m=0.3", "planner.fvs.enabled=false", "planner.map.prob_hit=0.6",
        "planner.validity.path=astar", "cameras.0.noise.model=released", "cameras.0.rate_hz=2",
        "cameras.0.name=x", "cameras.0.drop_probability=0.3", "guidance.path_speed_m_s=2",
        "vehicle.kind=ideal", "benchmark.stop_at_coverage=0.5", "wind.mean_m_s=[1, 0, 0]",
        "score.sizes_m=[0.2]", "score.area_samples=99", "lidars.0.range_sigma_m=0.1",
        "lidars.0.beams=99"}) {
    const Scenario other = load_scenario("smoke", {set});
    EXPECT_FALSE(keys.insert(key_of(other)).second) << set;
    EXPECT_EQ(content_of(other), content_of(s.scenario)) << set;
  }
  EXPECT_FALSE(keys.insert(key_of(load_scenario("smoke", {"seed=7"}))).second);
}

}  // namespace
}  // namespace gnbv
