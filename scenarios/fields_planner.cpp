#include <algorithm>

#include "planner/planners.hpp"
#include "scenarios/fields.hpp"

namespace gnbv {
namespace {

constexpr EnumNames<ProfilingMethod, 4> kProfilingMethods = {
    {{ProfilingMethod::bounding_box, "bounding_box"},
     {ProfilingMethod::circular, "circular"},
     {ProfilingMethod::saved, "saved"},
     {ProfilingMethod::none, "none"}}};
constexpr EnumNames<PathCheck, 3> kPathChecks = {{{PathCheck::straight, "straight"},
                                                  {PathCheck::astar, "astar"},
                                                  {PathCheck::unchecked, "unchecked"}}};
constexpr EnumNames<ClusterOrder, 2> kClusterOrders = {
    {{ClusterOrder::nearest, "nearest"}, {ClusterOrder::largest, "largest"}}};
constexpr EnumNames<DistanceAlong, 2> kDistances = {
    {{DistanceAlong::path, "path"}, {DistanceAlong::straight, "straight"}}};
constexpr EnumNames<DensityTerm, 2> kDensityTerms = {
    {{DensityTerm::sparse, "sparse"}, {DensityTerm::literal, "literal"}}};
constexpr EnumNames<IgCounting, 2> kIgCountings = {
    {{IgCounting::per_ray, "per_ray"}, {IgCounting::unique, "unique"}}};
constexpr EnumNames<HitVoxel, 2> kHitVoxels = {
    {{HitVoxel::counted, "counted"}, {HitVoxel::excluded, "excluded"}}};

constexpr std::string_view kUtility = "planner.utility.name";
using NameList = std::initializer_list<std::string_view>;

bool is_one_of(std::string_view name, NameList names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// What the planner of a scenario does, and so which settings it reads.

bool scores_views(const Scenario& s) { return traits_of(s.planner).scores_views; }
bool lays_views(const Scenario& s) { return traits_of(s.planner).lays_views; }
bool spaces_rows(const Scenario& s) { return traits_of(s.planner).spaces_rows; }
bool takes_views(const Scenario& s) { return traits_of(s.planner).takes_views; }
bool makes_tours(const Scenario& s) { return traits_of(s.planner).makes_tours; }
bool may_end_early(const Scenario& s) {
  return !traits_of(s.planner).knows_structure && !takes_views(s);
}
bool may_end_by_entropy(const Scenario& s) { return may_end_early(s) && !makes_tours(s); }
bool would_read_prediction(const Scenario& s) {
  UtilityConfig weighed = s.planner.utility;
  weighed.gamma = 1.0;
  return reads_prediction(weighed);
}

}  // namespace

void fields(FieldVisitor& v, OccupancyConfig& c) {
  v.in_papers_setting().number("resolution_m", c.resolution_m, between(0.001, 10),
                               "Edge of a voxel.");
  v.number("prob_hit", c.prob_hit, inside(0.5, 1), "Occupancy that one hit alone implies.");
  v.number("prob_miss", c.prob_miss, inside(0, 0.5), "Occupancy that one miss alone implies.");
  v.number("clamp_min", c.clamp_min, inside(0, 0.5), "Occupancy never falls below.");
  v.number("clamp_max", c.clamp_max, inside(0.5, 1), "Occupancy never rises above.");
  v.number("occupied_min", c.occupied_min, inside(0, 1), "From here up a voxel is occupied.");
  v.number("free_max", c.free_max, inside(0, 1), "Up to here a voxel is free.");
}

void fields(FieldVisitor& v, CloudConfig& c) {
  v.number("leaf_m", c.leaf_m, between(0.001, 10), "The cloud keeps one point a leaf.");
  v.number("profile_leaf_m", c.profile_leaf_m, between(0.001, 10),
           "The same for the points of the profile.");
}

void fields(FieldVisitor& v, ProfilingConfig& c) {
  const bool is_circular = c.method == ProfilingMethod::circular;
  v.in_papers_setting().choice("method", c.method, kProfilingMethods,
                               "The rough scan before the first view.");
  v.only_if(flies_a_profile, ".method")
      .flag("scan_in_transit", c.scan_in_transit, "LIDAR on between the descents too.");
  v.only_if(c.method == ProfilingMethod::saved, ".method")
      .path("file", c.file, "saved: the profile.map of an earlier run.");
  v.only_if(is_circular, ".method")
      .integer("circle_stations", c.circle_stations, between(1, 1000),
               "circular: places on the circle where it climbs.");
  v.only_if(is_circular, ".method")
      .number("climb_step_m", c.climb_step_m, between(0.01, 1e3),
              "circular: climbs by this as long as surface is seen.");
}

void fields(FieldVisitor& v, AgvsConfig& c) {
  v.in_papers_setting().number("step_m", c.step_m, above_upto(0, 100),
                               "Distance of the grid's positions at scale 1.");
  v.in_papers_setting().angle("yaw_step_deg", c.yaw_step_rad, above_upto(0, 180),
                              "Between the yaws of a position.");
  v.flag("rotation_only", c.rotation_only,
         "Offer the current position with other yaws at scale 1.");
  v.flag("scales", c.scales, "Grow the grid at a local minimum.");
  const auto grown = [&]() -> FieldVisitor& { return v.only_if(c.scales, ".scales"); };
  grown().number("scale_factor", c.scale_factor, between(1.1, 100),
                 "Growth of the grid at a local minimum.");
  grown().number("scale_max", c.scale_max, between(1, 1e3), "The grid's largest scale.");
  grown().number("utility_threshold", c.utility_threshold, between(0, 1e9),
                 "Local minimum: the best utility stays below this");
  grown().integer("utility_window", c.utility_window, between(1, 1e6), "for so many views.");
  grown().integer("repeated_moves", c.repeated_moves, between(0, 1e6),
                  "Or after so many moves back and forth; 0: never.");
  grown().number(
      "entropy_threshold_nat", c.entropy_threshold_nat, between(0, 1),
      "Or when no view changed the total entropy by more than this per voxel of its frusta");
  grown()
      .only_if(c.entropy_threshold_nat != 0.0, ".entropy_threshold_nat")
      .integer("entropy_window", c.entropy_window, between(1, 1000), "over this many views.");
}

void fields(FieldVisitor& v, FrontierConfig& c) {
  const auto sampled = [&]() -> FieldVisitor& {
    return v.only_if([](const Scenario& s) { return s.planner.fvs.enabled; },
                     "planner.fvs.enabled");
  };
  v.number("density_share", c.density_share, between(0, 10),
           "Frontier: less dense than this share of a fully scanned plane.");
  v.flag("occupied_only", c.occupied_only,
         "And it is occupied; false: points in it will do, as those of thin parts.");
  sampled().integer("neighbour_voxels", c.neighbour_voxels, between(1, 100),
                    "Frontier voxels so near along each axis are one cluster.");
  sampled().integer("min_cluster_voxels", c.min_cluster_voxels, between(1, 1e6),
                    "Smaller clusters are left out.");
  sampled().number(
      "max_extent_m", c.max_extent_m, between(0, 1e4),
      "Larger clusters are cut, into parts of any size; 0: never, the paper to the letter.");
}

void fields(FieldVisitor& v, FvsConfig& c) {
  const auto sampled = [&]() -> FieldVisitor& { return v.only_if(c.enabled, ".enabled"); };
  v.flag("enabled", c.enabled, "Whether frontier views are sampled at a local minimum.");
  sampled().number("entropy_threshold_nat", c.entropy_threshold_nat, between(0, 1),
                   "Local minimum: no view changed the total entropy by more, per voxel of its "
                   "frusta,");
  sampled()
      .only_if(c.entropy_threshold_nat != 0.0, ".entropy_threshold_nat")
      .integer("entropy_window", c.entropy_window, between(1, 1000), "over this many views.");
  v.section("frontier", c.frontier, "Which voxels are frontiers, and how they cluster.");
  sampled().choice("order", c.order, kClusterOrders, "Which clusters come first.");
  sampled().integer("tries", c.tries, between(1, 1e6),
                    "Clusters, in this order, until one has a valid view; 1: the paper.");
  sampled().flag("pool_clusters", c.pool_clusters, "The views of all these clusters compete.");
  sampled().integer("looks_max", c.looks_max, between(0, 1e6),
                    "Frontier views at a cluster before it is left for what it is; 0: any number.");
  sampled().integer("views_per_layer", c.views_per_layer, between(1, 360), "Around the cluster.");
  sampled().number("radius_m", c.radius_m, above_upto(0, 1e3), "Of the cylinder of views.");
  sampled().number("layer_step_m", c.layer_step_m, between(0, 1e3),
                   "Height between its three layers.");
  sampled().flag("needs_visible_cluster", c.needs_visible_cluster,
                 "A view must see part of the cluster unoccluded.");
  sampled().flag("agvs_when_stuck", c.agvs_when_stuck,
                 "Where no cluster has a valid view, sample the grid; false: the mission ends.");
  sampled().flag(
      "when_grid_finds_nothing", c.when_grid_finds_nothing,
      "Where the grid has no valid view, sample frontier views, at last by a way around; false: "
      "the mission ends.");
}

void fields(FieldVisitor& v, PathSearchConfig& c) {
  v.integer("max_expansions", c.max_expansions, between(1, 1e7),
            "Nodes that a search may look at in a navigation box of up to 40,000; in a larger one "
            "as many times that as it has more.");
}

void fields(FieldVisitor& v, ValidityConfig& c) {
  v.in_papers_setting().number("collision_radius_m", c.collision_radius_m, above_upto(0, 100),
                               "Of the sphere that may touch no occupied voxel.");
  v.number("z_min_m", c.z_min_m, between(-1e4, 1e4), "No view below.");
  v.integer("recent_poses", c.recent_poses, between(0, 1e6), "Views that are not taken again.");
  v.only_if(c.recent_poses != 0, ".recent_poses")
      .number("recent_distance_m", c.recent_distance_m, between(0, 100),
              "The same view: nearer than this");
  v.only_if(c.recent_poses != 0, ".recent_poses")
      .angle("recent_yaw_deg", c.recent_yaw_rad, between(0, 180), "and turned by less than this.");
  v.flag(
      "allow_unknown", c.allow_unknown,
      "Views, and legs that path: astar checks, in unknown space, too; false, the paper: in free "
      "space only.");
  v.choice(
      "path", c.path, kPathChecks,
      "straight: a view behind what is known is discarded, the paper; astar: a view to which no "
      "way leads through known space; unchecked: flown to all the same.");
  v.only_if(c.path != PathCheck::unchecked, "planner.validity.path")
      .section("path_search", c.path_search, "The search for a way around.");
}

void fields(FieldVisitor& v, VolumeWeights& c) {
  constexpr Range kWeight = between(0, 1e9);
  v.number("unmapped", c.unmapped, kWeight, "A cubic metre of unknown space.");
  v.number("free", c.free, kWeight, "A cubic metre of free space.");
  v.number("occupied", c.occupied, kWeight, "A cubic metre of occupied space.");
}

void fields(FieldVisitor& v, ShadowConfig& c) {
  v.number("shadow_depth_m", c.shadow_depth_m, above_upto(0, 100), "Behind a hit, along its ray.");
}

void fields(FieldVisitor& v, UserUtilityConfig& c) {
  v.text("function", c.function, "Its name in the source.");
  v.text("source", c.source, "Python, all of it: as `--utility FILE.py:FUNCTION` put it here.");
}

void fields(FieldVisitor& v, UtilityConfig& c) {
  constexpr Range kWeight = between(0, 1e9);
  std::vector<std::string_view> names = planner_names();
  names.push_back(kUserUtilityName);
  v.choice("name", c.name, names,
           "What ranks the candidate views, a baseline's route, an oracle's, or your own.");
  const auto of = [&](NameList known) -> FieldVisitor& {
    return v.only_if(scores_views, kUtility).only_if(is_one_of(c.name, known), kUtility);
  };
  const bool hides_hits = is_one_of(c.name, {"bircher", "isler"}) && c.prediction_hides_hits;
  of({"proposed"}).number("alpha", c.alpha, kWeight, "Weight of information, Eq. (2).");
  of({"proposed"}).number("beta", c.beta, kWeight, "Weight of density, Eq. (2).");
  v.only_if(hides_hits || c.name == "proposed", kUtility)
      .number("gamma", c.gamma, kWeight, "Weight of prediction, Eq. (2).");
  of({"proposed", "bircher_volume", "aep"})
      .number("lambda_per_m", c.lambda_per_m, kWeight, "Decay with distance, Eq. (2).");
  of({"proposed"})
      .choice("density_term", c.density_term, kDensityTerms,
              "sparse: reward thinly sampled surface; literal: Eq. (2) as printed.");
  of({"bircher"})
      .number("bircher_lambda_per_m", c.bircher_lambda_per_m, kWeight,
              "bircher: decay with distance; 0.5 in the released configuration.");
  of({"proposed", "bircher", "bircher_volume", "aep", "nearest_frontier", kUserUtilityName})
      .choice("distance", c.distance, kDistances,
              "By which gains are discounted: along the way that is flown, or straight.");
  of({"proposed"})
      .flag("normalise_weights", c.normalise_weights, "Divide beta and gamma by their sum.");
  of({"bircher", "isler"})
      .choice("ig_counting", c.ig_counting, kIgCountings,
              "bircher, isler: a voxel counts once a ray that crosses it, or once.");
  of({"bircher", "isler"})
      .choice("hit_voxel", c.hit_voxel, kHitVoxels,
              "bircher, isler: whether the voxel that ends a ray counts; excluded: released slip.");
  of({"bircher", "isler"})
      .flag("prediction_hides_hits", c.prediction_hides_hits,
            "A hit counts only where the prediction was hit too; released slip.");
  of({"occlusion_aware", "unobserved_voxel", "rear_side_entropy", kUserUtilityName})
      .flag("legacy_visibility", c.legacy_visibility,
            "Visibility multiplies P instead of 1 - P, as the released code of Delmerico et al.");
  of({"bircher_volume"})
      .section("volume_weights", c.volume_weights, "bircher_volume: worth of visible space.");
  of({"proximity_count", "area_factor", kUserUtilityName})
      .section("shadow", c.shadow, "proximity_count, area_factor: what lies behind seen surface.");
  of({kUserUtilityName}).section("python", c.python, "python: a function of yours.");
}

void fields(FieldVisitor& v, ViewPose& c) {
  v.number("position_m", c.p_world_m, between(-1e6, 1e6), "Of the body, world ENU.");
  v.angle("yaw_deg", c.yaw_rad, between(-360, 360), "Heading of the body, 0 = east, 90 = north.");
  v.angle("pitch_deg", c.gimbal_pitch_rad, between(-90, 90),
          "Of the cameras on a gimbal; positive looks down.");
}

void fields(FieldVisitor& v, RouteConfig& c) {
  v.only_if(lays_views, kUtility)
      .number("standoff_m", c.standoff_m, between(0.1, 1e3), "From the surface of the profile.");
  v.only_if(spaces_rows, kUtility)
      .number("overlap", c.overlap, between(0, 0.95), "lawnmower: of neighbouring images.");
  v.only_if(takes_views, kUtility)
      .list("views", c.views, {0, kMostUserViews},
            "route: body poses, in the order in which they are flown.");
}

void fields(FieldVisitor& v, TourConfig& c) {
  v.number("detail_m", c.detail_m, between(0.005, 1),
           "Edge of the voxels that are to hold a point.");
  v.number(
      "lattice_step_m", c.lattice_step_m, between(0, 100),
      "Between views of the lattice; 0: a quarter of the cameras' range, more in a large box.");
  v.angle("yaw_step_deg", c.yaw_step_rad, between(5, 360), "Between views at one place.");
  v.angle("incidence_max_deg", c.incidence_max_rad, between(10, 89),
          "Beyond, no observation counts.");
  v.flag(
      "double_cover", c.double_cover,
      "Whether a second observation is worth what the first may miss; else it is worth nothing.");
  v.flag("explore", c.explore,
         "Without a profile: looks for unseen space where no surface pays any more.");
  v.number("price", c.price, above_upto(0, 10),
           "What a metre has to bring: as a share of what the mean metre would of a tour twice as "
           "long as the sides of the structure's box together.");
  v.number("metres_per_view", c.metres_per_view, between(0, 100), "What a view costs as if way.");
  v.integer("iterations", c.iterations, between(0, 1e5), "Of the search, each time.");
  v.integer("views_per_replan", c.views_per_replan, between(1, 1e6), "Flown before the next tour.");
  v.number("replan_below", c.replan_below, between(0, 1),
           "A new tour when a view brings less than this share of what was predicted.");
  v.number("end_price", c.end_price, above_upto(0, 1),
           "When no view pays, the price is halved, down to this share of it.");
  v.flag("surface_views", c.surface_views, "Views off the lattice for what none of it sees.");
}

void fields(FieldVisitor& v, SymmetryConfig& c) {
  v.flag("enabled", c.enabled, "Whether a mirror-symmetric profile predicts its other half.");
  v.only_if(c.enabled, ".enabled")
      .number("min_support", c.min_support, between(0, 1),
              "Share of mirrored points that measured free space must not contradict.");
  v.only_if(c.enabled, ".enabled")
      .number("min_confirmed", c.min_confirmed, between(0, 1),
              "Share of mirrored points that must fall on measured surface.");
}

void fields(FieldVisitor& v, TerminationConfig& c) {
  const auto by_entropy = [&]() -> FieldVisitor& {
    return v.only_if(may_end_by_entropy, kUtility);
  };
  const auto by_gain = [&]() -> FieldVisitor& { return v.only_if(may_end_early, kUtility); };
  v.in_papers_setting().integer("max_iterations", c.max_iterations, between(1, 1e6),
                                "Views at most.");
  by_entropy().number("entropy_change_percent", c.entropy_change_percent, between(0, 100),
                      "Over when the total entropy changes by less, per view; 0: never.");
  by_entropy()
      .only_if(c.entropy_change_percent != 0.0, ".entropy_change_percent")
      .integer("entropy_window", c.entropy_window, between(1, 1e6), "For so many views in a row.");
  by_entropy().integer("repeated_moves", c.repeated_moves, between(0, 1e6),
                       "Over after so many moves back and forth; 0: never.");
  v.in_papers_setting().number(
      "max_distance_m", c.max_distance_m, between(0, 1e9),
      "Over when the way to the next view would make the planned way longer; 0: no limit.");
  v.in_papers_setting().number(
      "max_flight_time_s", c.max_flight_time_s, between(0, 1e9),
      "Over in flight, so long after the mission's beginning; 0: no limit.");
  by_gain().in_papers_setting().number(
      "min_new_voxels_per_m", c.min_new_voxels_per_m, between(0, 1e9),
      "Over when fewer voxels of the map become occupied a planned metre; 0: never.");
  by_gain()
      .only_if(c.min_new_voxels_per_m != 0.0, ".min_new_voxels_per_m")
      .integer("new_voxels_window", c.new_voxels_window, between(1, 1e6),
               "That is asked of so many views together.");
  by_gain().in_papers_setting().integer(
      "max_views_without_new_points", c.max_views_without_new_points, between(0, 1e6),
      "Over after so many views in a row that add no point to the cloud; 0: never.");
}

void fields(FieldVisitor& v, PlannerConfig& c) {
  const std::string before = c.preset;
  v.choice("preset", c.preset, kPlannerPresets,
           "paper, or the authors' released code: sets the switches in which they differ.");
  if (c.preset != before) set_preset_switches(c);
  v.section("map", c.map, "The occupancy grid.");
  v.section("cloud", c.cloud, "The surface cloud.");
  v.number("floor_z_m", c.floor_z_m, between(-1e4, 1e4),
           "Returns below are the floor: they clear, but mark nothing.");
  v.section("profiling", c.profiling, "The rough scan before the first view.");
  v.only_if(scores_views, kUtility).section("agvs", c.agvs, "Adaptive grid view sampling.");
  v.only_if(scores_views, kUtility).section("fvs", c.fvs, "Frontier view sampling.");
  v.section("validity", c.validity, "Which views may be flown to.");
  v.section("utility", c.utility, "What a view is worth.");
  v.section("routes", c.routes, "Baselines whose views are laid around the profile.");
  v.only_if(makes_tours, kUtility).section("tour", c.tour, "The tour of all that lacks points.");
  v.only_if(would_read_prediction, kUtility)
      .only_if(c.utility.gamma > 0.0 || is_user_utility(c.utility.name), "planner.utility.gamma")
      .section("symmetry", c.symmetry, "The mirror image of the profile.");
  v.section("termination", c.termination, "When the mission is over.");
}

}  // namespace gnbv
