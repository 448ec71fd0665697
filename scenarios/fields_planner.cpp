#include "planner/planners.hpp"
#include "scenarios/fields.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kUtility = "planner.utility.name";
constexpr Range kWeight = {0, 1e9};
void repeated_by(const Keys& key, RepeatedBy& value) {
  key("repeated_by", value, {{RepeatedBy::places, "places"}, {RepeatedBy::utilities, "utilities"}},
      "What counts as back and forth: the place of two views before, or its utility (the authors' "
      "code).");
}

// What the planner of a scenario does, and so which settings it reads.

bool scores_views(const Scenario& s) { return traits_of(s.planner).scores_views; }
bool lays_views(const Scenario& s) { return traits_of(s.planner).lays_views; }
bool spaces_rows(const Scenario& s) { return traits_of(s.planner).spaces_rows; }
bool knows_structure(const Scenario& s) { return traits_of(s.planner).knows_structure; }
bool takes_views(const Scenario& s) { return traits_of(s.planner).takes_views; }
bool makes_tours(const Scenario& s) { return traits_of(s.planner).makes_tours; }
bool samples_frontiers(const Scenario& s) { return s.planner.fvs.enabled; }
bool flies_bursts(const Scenario& s) { return s.planner.fvs.mode == FvsMode::burst; }
bool has_lidars(const Scenario& s) { return !s.lidars.empty(); }
bool has_profile(const Scenario& s) { return s.planner.profiling.method != ProfilingMethod::none; }
bool has_no_profile(const Scenario& s) { return !has_profile(s); }
bool keeps_lidar_points(const Scenario& s) {
  return has_profile(s) || s.planner.profiling.flight_rate_hz > 0.0;
}
bool may_end_early(const Scenario& s) {
  return !traits_of(s.planner).knows_structure && !takes_views(s);
}
bool may_end_by_entropy(const Scenario& s) { return may_end_early(s) && !makes_tours(s); }
bool would_read_prediction(const Scenario& s) {
  PlannerConfig weighed = s.planner;
  weighed.utility.gamma = 1.0;
  return traits_of(weighed).reads_prediction;
}

}  // namespace

void fields(const Keys& key, OccupancyConfig& c) {
  key.of_papers_setting()("resolution_m", c.resolution_m, {0.001, 10}, "Edge of a voxel.");
  key("prob_hit", c.prob_hit, inside(0.5, 1), "Occupancy that one hit alone implies.");
  key("prob_miss", c.prob_miss, inside(0, 0.5), "Occupancy that one miss alone implies.");
  key("clamp_min", c.clamp_min, inside(0, 0.5), "Occupancy never falls below this.");
  key("clamp_max", c.clamp_max, inside(0.5, 1), "Occupancy never rises above this.");
  key("occupied_min", c.occupied_min, inside(0, 1), "A voxel is occupied from this occupancy on.");
  key("free_max", c.free_max, inside(0, 1), "A voxel is free up to this occupancy.");
  key("no_return", c.no_return, {{NoReturn::free, "free"}, {NoReturn::unknown, "unknown"}},
      "What a pixel without a return means up to range_max_m of its camera.");
}

void fields(const Keys& key, CloudConfig& c) {
  constexpr Range kLeaf_m = {0.001, 10};
  key("leaf_m", c.leaf_m, kLeaf_m, "The cloud keeps one point per cube of this edge.");
  key.only_if(keeps_lidar_points, "planner.profiling.method")(
      "profile_leaf_m", c.profile_leaf_m, kLeaf_m, "The same for the points of the profile.");
}

void fields(const Keys& key, ProfilingConfig& c) {
  using enum ProfilingMethod;
  key.of_papers_setting()(
      "method", c.method,
      {{bounding_box, "bounding_box"}, {circular, "circular"}, {saved, "saved"}, {none, "none"}},
      "The rough scan before the first view.");
  key.only_if(flies_a_profile, ".method")("scan_in_transit", c.scan_in_transit,
                                          "The LIDAR scans between the descents, too.");
  key.only_if(has_lidars, "lidars")(
      "flight_rate_hz", c.flight_rate_hz, {0, 1e3},
      "Sweeps per second of each LIDAR between the views. They show surface to look at, and cover "
      "nothing. 0: none.");
  key.only_if(c.method == saved, ".method")
      .path("file", c.file,
            "saved: an earlier run's profile.map, or an OctoMap (.bt, .ot) in the "
            "world's frame.");
  const Keys on_circle = key.only_if(c.method == circular, ".method");
  on_circle("circle_stations", c.circle_stations, {1, 1000},
            "circular: at how many places the vehicle climbs.");
  on_circle("climb_step_m", c.climb_step_m, {0.01, 1e3},
            "circular: step of the climb, which goes on while surface is seen.");
}

void fields(const Keys& key, AgvsConfig& c) {
  const Keys papers = key.of_papers_setting();
  papers("step_m", c.step_m, positive(100), "Distance of the grid's positions at scale 1.");
  papers.angle("yaw_step_deg", c.yaw_step_rad, positive(180),
               "Step between the yaws of a position.");
  key("rotation_only", c.rotation_only, "Offer the current position with other yaws at scale 1.");
  key.only_if(c.rotation_only, ".rotation_only")(
      "rotation_at_all_scales", c.rotation_at_all_scales,
      "rotation_only: at every scale; false: only at scale 1.");
  key("current_pose", c.current_pose,
      "Offer the current pose itself at scale 1. It is valid unless it is a recent one.");
  key("look_again", c.look_again,
      "Where no view has a utility above 0, take another view from where the vehicle is, with "
      "utility 0 (the authors' code); false: as if no view were valid.");
  key("scales", c.scales, "Grow the grid at a local minimum.");
  const Keys grown = key.only_if(c.scales, ".scales");
  grown("scale_factor", c.scale_factor, {1.1, 100}, "The grid grows by this factor.");
  grown("scale_max", c.scale_max, {1, 1e3}, "The grid's largest scale.");
  grown("utility_threshold", c.utility_threshold, {0, 1e9},
        "Local minimum: the best utility stays below this for utility_window views.");
  grown("utility_window", c.utility_window, {1, 1e6}, "Number of views; see utility_threshold.");
  grown("repeated_moves", c.repeated_moves, {0, 1e6},
        "Also a local minimum: this many moves back and forth; 0: never.");
  repeated_by(grown.only_if(c.repeated_moves != 0, ".repeated_moves"), c.repeated_by);
  grown("entropy_threshold_nat", c.entropy_threshold_nat, {0, 1},
        "Also a local minimum: none of entropy_window views changed the total entropy by more than "
        "this per voxel of its frusta; 0: never.");
  grown.only_if(c.entropy_threshold_nat != 0.0, ".entropy_threshold_nat")(
      "entropy_window", c.entropy_window, {1, 1000}, "Number of views; see entropy_threshold_nat.");
}

void fields(const Keys& key, FrontierConfig& c) {
  key("density_share", c.density_share, {0, 10},
      "A frontier voxel is less dense than this share of a fully scanned plane.");
  const Keys sampled = key.only_if(samples_frontiers, "planner.fvs.enabled");
  sampled("occupied_only", c.occupied_only,
          "A frontier voxel has to be occupied; false: points in it are enough, as in thin parts.");
  using enum FrontierLinking;
  sampled("linking", c.linking, {{face, "face"}, {chebyshev, "chebyshev"}, {pcl, "pcl"}},
          "Which voxels join to one cluster. face: those that share a face; chebyshev: those up to "
          "neighbour_voxels away along each axis; pcl: as in the authors' use of PCL, where "
          "rounding joins some faces.");
  sampled.only_if(c.linking == chebyshev, ".linking")(
      "neighbour_voxels", c.neighbour_voxels, {1, 100}, "chebyshev: distance that joins voxels.");
  sampled("min_cluster_voxels", c.min_cluster_voxels, {1, 1e6}, "Smaller clusters are left out.");
  sampled("max_cluster_voxels", c.max_cluster_voxels, {0, 1e6},
          "Larger clusters are left out, too; 0: no limit.");
  sampled("max_extent_m", c.max_extent_m, {0, 1e4},
          "Larger clusters are cut into parts of any size; 0: never (the paper to the letter).");
}

void fields(const Keys& key, FvsConfig& c) {
  key("enabled", c.enabled, "Whether frontier views are sampled at a local minimum.");
  const Keys sampled = key.only_if(c.enabled, ".enabled");
  const FvsMode before = c.mode;
  sampled("mode", c.mode, {{FvsMode::burst, "burst"}, {FvsMode::single, "single"}},
          "burst (the paper): views that cover the nearest clusters, flown one after the other; "
          "single: the one view of the highest utility. Sets the switches in which they differ.");
  if (c.mode != before) set_mode_switches(c);
  const Keys in_bursts = sampled.only_if(c.mode == FvsMode::burst, ".mode");
  const Keys singly = sampled.only_if(c.mode == FvsMode::single, ".mode");
  sampled("entropy_threshold_nat", c.entropy_threshold_nat, {0, 1},
          "Local minimum: none of entropy_window views changed the total entropy by more than this "
          "per voxel in view; 0: never.");
  const Keys by_entropy = sampled.only_if(c.entropy_threshold_nat != 0.0, ".entropy_threshold_nat");
  by_entropy("entropy_window", c.entropy_window, {1, 1000},
             "Number of views; see entropy_threshold_nat.");
  by_entropy("entropy_lag", c.entropy_lag, {0, 1000},
             "This many of the last views do not count yet.");
  by_entropy("voxels_in_view", c.voxels_in_view,
             {{VoxelsInView::frusta, "frusta"}, {VoxelsInView::quarter_frustum, "quarter_frustum"}},
             "frusta: the voxels in the frusta of all cameras, up to maximum range; "
             "quarter_frustum: a quarter of those of the first camera (the authors' code).");
  key.section("frontier", c.frontier, "Which voxels are frontiers, and how they cluster.");
  in_bursts("clusters", c.clusters, {1, 1e6},
            "How many clusters one burst covers, the nearest ones.");
  in_bursts("clusters_growth", c.clusters_growth, {0, 1e6},
            "After a burst without a view, all later bursts cover this many clusters more.");
  in_bursts("retries", c.retries, {0, 1e6},
            "How often in a mission a burst without a view is followed by another burst; after "
            "that agvs_when_stuck decides.");
  in_bursts("share_to_cover", c.share_to_cover, {0, 1},
            "A cluster is covered when one view sees this share of the points left around it.");
  in_bursts("culling", c.culling, {{Culling::map, "map"}, {Culling::front, "front"}},
            "map: occupied voxels of the map hide a point; front (the authors' code): a point is "
            "hidden when it lies far behind the front of all points in view.");
  in_bursts("fov_margin_m", c.fov_margin_m, {0, 100},
            "Least distance from a cluster's centroid to the sides of the camera's field of view.");
  in_bursts("keeps_blind", c.keeps_blind,
            "Of the views at one bearing, also keep those that see none of the points left, up to "
            "the first that sees one (the authors' code).");
  sampled("first_bearing_twice", c.first_bearing_twice, "Sample the first view of a layer again.");
  singly("order", c.order, {{ClusterOrder::nearest, "nearest"}, {ClusterOrder::largest, "largest"}},
         "Which clusters come first.");
  singly("tries", c.tries, {1, 1e6},
         "How many clusters are tried, in this order, until one has a valid view; 1: the paper.");
  singly("pool_clusters", c.pool_clusters, "The views of all these clusters compete.");
  singly("looks_max", c.looks_max, {0, 1e6},
         "Frontier views at a cluster before it is given up; 0: any number.");
  sampled("views_per_layer", c.views_per_layer, {1, 360},
          "Views around the cluster, in each layer.");
  sampled("radius_m", c.radius_m, positive(1e3), "Radius of the cylinder of views.");
  sampled("layer_step_m", c.layer_step_m, {0, 1e3}, "Height between its three layers.");
  sampled("needs_visible_cluster", c.needs_visible_cluster, "A view must see part of its cluster.");
  sampled("agvs_when_stuck", c.agvs_when_stuck,
          "Where no cluster has a valid view, sample the grid; false: the mission ends.");
  sampled("when_grid_finds_nothing", c.when_grid_finds_nothing,
          "Where the grid has no valid view, sample frontier views, and at last look for a way "
          "around; false: the mission ends.");
}

void fields(const Keys& key, PathSearchConfig& c) {
  key("max_expansions", c.max_expansions, {1, 1e7},
      "How many nodes a search may expand when its lattice has up to 40,000 in the navigation box; "
      "with a larger lattice, proportionally more.");
}

void fields(const Keys& key, ValidityConfig& c) {
  key.of_papers_setting()("collision_radius_m", c.collision_radius_m, positive(100),
                          "Radius of the sphere that may touch no occupied voxel.");
  key("leg_radius_m", c.leg_radius_m, {0, 100},
      "Radius of the sphere for which a straight way to a view has to be clear; 0: "
      "collision_radius_m.");
  key("z_min_m", c.z_min_m, {-1e4, 1e4}, "No view lies below this.");
  key("recent_poses", c.recent_poses, {0, 1e6}, "This many of the last views are not taken again.");
  const Keys recent = key.only_if(c.recent_poses != 0, ".recent_poses");
  recent("recent_distance_m", c.recent_distance_m, {0, 100},
         "Two views are the same when they are nearer than this, and turned by less than "
         "recent_yaw_deg.");
  recent.angle("recent_yaw_deg", c.recent_yaw_rad, {0, 180}, "See recent_distance_m.");
  key("allow_unknown", c.allow_unknown,
      "Views may lie in unknown space, and so may the legs that `path: astar` checks; false (the "
      "paper): only in free space.");
  using enum PathCheck;
  key("path", c.path, {{straight, "straight"}, {astar, "astar"}, {unchecked, "unchecked"}},
      "Which views are discarded. straight (the paper): those behind what is known; astar: those "
      "to which no way leads through known space; unchecked: none.");
  key.only_if(c.path != unchecked, "planner.validity.path")
      .section("path_search", c.path_search, "The search for a way around.");
}

void fields(const Keys& key, VolumeWeights& c) {
  key("unmapped", c.unmapped, kWeight, "Worth of a cubic metre of unknown space.");
  key("free", c.free, kWeight, "Worth of a cubic metre of free space.");
  key("occupied", c.occupied, kWeight, "Worth of a cubic metre of occupied space.");
}

void fields(const Keys& key, ShadowConfig& c) {
  key("shadow_depth_m", c.shadow_depth_m, positive(100),
      "How far the shadow reaches behind a hit, along its ray.");
}

void fields(const Keys& key, UserFunctionConfig& c) {
  key("kind", c.kind,
      {{UserFunctionKind::utility, "utility"}, {UserFunctionKind::planner, "planner"}},
      "utility: scores the candidates; planner: gives the next view.");
  key("label", c.label, "Its name in tables; empty: the function's name.");
  key("file", c.file, "Name of the file that it comes from.");
  key("function", c.function, "Name of the function in the source.");
  key("source", c.source, "The Python source, put here by `--utility FILE.py:FUNCTION`.");
}

void fields(const Keys& key, UtilityConfig& c) {
  std::vector<std::string_view> names = planner_names();
  names.push_back(kUserUtilityName);
  key("name", c.name, names,
      "What ranks the candidate views; or a baseline, an oracle, or your own route.");
  const UtilityTraits reads = utility_traits(c.name);
  const auto where = [&](bool is_read) { return key.only_if(is_read, kUtility); };
  const Keys eq2 = where(reads.eq2);
  const Keys counted = where(reads.baseline);
  eq2("alpha", c.alpha, kWeight, "Weight of information, Eq. (2).");
  eq2("beta", c.beta, kWeight, "Weight of density, Eq. (2).");
  eq2("gamma", c.gamma, kWeight, "Weight of prediction, Eq. (2).");
  where(reads.lambda)("lambda_per_m", c.lambda_per_m, kWeight, "Decay with distance, Eq. (2).");
  eq2("density_term", c.density_term,
      {{DensityTerm::sparse, "sparse"}, {DensityTerm::literal, "literal"}},
      "sparse: reward thinly sampled surface; literal: Eq. (2) as printed.");
  where(reads.bircher_lambda)("bircher_lambda_per_m", c.bircher_lambda_per_m, kWeight,
                              "bircher: decay with distance; 0.5 in the released configuration.");
  where(reads.distance)("distance", c.distance,
                        {{DistanceAlong::path, "path"}, {DistanceAlong::straight, "straight"}},
                        "Which distance lowers a gain: along the way that is flown, or straight.");
  eq2("normalise_weights", c.normalise_weights, "Divide beta and gamma by their sum.");
  counted("ig_counting", c.ig_counting,
          {{IgCounting::per_ray, "per_ray"}, {IgCounting::unique, "unique"}},
          "bircher, isler: a voxel counts once for each ray that crosses it, or once in all.");
  counted("hit_voxel", c.hit_voxel,
          {{HitVoxel::counted, "counted"}, {HitVoxel::excluded, "excluded"}},
          "bircher, isler: whether the voxel that ends a ray counts; excluded: a slip of the "
          "released code.");
  counted("leaving_rays", c.leaving_rays,
          {{LeavingRays::counted, "counted"}, {LeavingRays::dropped, "dropped"}},
          "bircher, isler: whether rays that end outside the object bounds count; dropped: a slip "
          "of the released code.");
  eq2.only_if(c.gamma > 0.0, ".gamma")("prediction_hides_hits", c.prediction_hides_hits,
                                       "A surface counts only on rays that also meet predicted "
                                       "surface; a slip of the released code.");
  where(reads.visibility)(
      "legacy_visibility", c.legacy_visibility,
      "Visibility multiplies P instead of 1 - P, as in the released code of Delmerico et al.");
  where(reads.volume_weights)
      .section("volume_weights", c.volume_weights, "bircher_volume: worth of visible space.");
  where(reads.shadow)
      .section("shadow", c.shadow, "proximity_count, area_factor: what lies behind seen surface.");
  where(is_user_utility(c.name) || c.name == kRouteName)
      .section("python", c.python, "A function of yours: python asks it, route flies its views.");
}

void fields(const Keys& key, ViewPose& c) {
  key("position_m", c.p_world_m, {-1e6, 1e6}, "Position of the body, world ENU.");
  key.angle("yaw_deg", c.yaw_rad, {-360, 360}, "Heading of the body, 0 = east, 90 = north.");
  key.angle("pitch_deg", c.gimbal_pitch_rad, {-90, 90},
            "Pitch of the cameras on a gimbal; positive looks down.");
}

void fields(const Keys& key, RouteConfig& c) {
  key.only_if(lays_views, kUtility)("standoff_m", c.standoff_m, {0.1, 1e3},
                                    "Distance of the views from the surface of the profile.");
  key.only_if(spaces_rows, kUtility)("overlap", c.overlap, {0, 0.95},
                                     "lawnmower: overlap of its images.");
  key.only_if(takes_views, kUtility)
      .list("views", c.views, {0, kMostUserViews}, "route: body poses, in the order of flight.");
}

void fields(const Keys& key, OracleConfig& c) {
  key("coverage", c.coverage, {0, 1},
      "Coverage at 0.05 m that its views are to reach. 0, or more than its cloud can hold: 99 % of "
      "what the cloud can hold.");
  key("search_seed", c.search_seed, "Seed of what the search for its views leaves to chance.");
}

void fields(const Keys& key, TourConfig& c) {
  using enum TourCost;
  key("cost", c.cost, {{metres, "metres"}, {seconds, "seconds"}},
      "What a tour is to be short in. Seconds count turns, too, and what frames in flight bring.");
  key("detail_m", c.detail_m, {0.005, 1}, "Edge of the voxels that are to hold a point.");
  key("lattice_step_m", c.lattice_step_m, {0, 100},
      "Distance between views of the lattice; 0: a quarter of the cameras' range, more in a large "
      "box.");
  key.angle("yaw_step_deg", c.yaw_step_rad, {5, 360}, "Angle between views at one place.");
  key.angle("incidence_max_deg", c.incidence_max_rad, {10, 89},
            "An observation farther than this from the surface's normal does not count.");
  key("double_cover", c.double_cover,
      "A second observation is worth what the first may miss; false: it is worth nothing.");
  key.only_if(has_no_profile, "planner.profiling.method")(
      "explore", c.explore, "Without a profile: look for unseen space where no surface pays.");
  key("price", c.price, positive(10),
      "What a metre has to bring. 1 is what the mean metre brings of a tour that is twice as long "
      "as the sides of the structure's box together.");
  key.only_if(c.cost == metres, ".cost")("metres_per_view", c.metres_per_view, {0, 100},
                                         "A view costs as much as this many metres.");
  key.only_if(c.cost == seconds, ".cost")(
      "seconds_per_view", c.seconds_per_view, {0, 100},
      "A view costs as much as this many seconds, where seconds count.");
  key("iterations", c.iterations, {0, 1e5}, "Iterations of each search.");
  key("views_per_replan", c.views_per_replan, {1, 1e6},
      "Views that are flown before the next tour is planned.");
  key("replan_below", c.replan_below, {0, 1},
      "A new tour is planned when a view brings less than this share of what was predicted.");
  key("end_price", c.end_price, positive(1),
      "When no view pays, the price is halved, down to this share of it.");
  key("surface_views", c.surface_views,
      "Add views off the lattice for surface that no view of the lattice sees.");
}

void fields(const Keys& key, SymmetryConfig& c) {
  key("enabled", c.enabled, "Whether a mirror-symmetric profile predicts its other half.");
  const Keys used = key.only_if(c.enabled, ".enabled");
  used("min_support", c.min_support, {0, 1}, "Share of mirrored points not in free space.");
  used("min_confirmed", c.min_confirmed, {0, 1}, "Share of mirrored points on measured surface.");
}

void fields(const Keys& key, TerminationConfig& c) {
  const Keys papers = key.of_papers_setting();
  const Keys by_entropy = key.only_if(may_end_by_entropy, kUtility);
  const Keys by_gain = key.only_if(may_end_early, kUtility);
  papers("max_iterations", c.max_iterations, {1, 1e6}, "The mission ends after this many views.");
  by_entropy("entropy_change_percent", c.entropy_change_percent, {0, 100},
             "The mission ends when each of entropy_window views changed the total entropy by less "
             "than this; 0: never.");
  by_entropy.only_if(c.entropy_change_percent != 0.0, ".entropy_change_percent")(
      "entropy_window", c.entropy_window, {1, 1e6}, "Number of views; see entropy_change_percent.");
  by_entropy("repeated_moves", c.repeated_moves, {0, 1e6},
             "The mission ends after this many moves back and forth; 0: never.");
  repeated_by(by_entropy.only_if(c.repeated_moves != 0, ".repeated_moves"), c.repeated_by);
  key.only_if(scores_views, kUtility)
      .only_if(samples_frontiers, "planner.fvs.enabled")
      .only_if(flies_bursts, "planner.fvs.mode")("within_plans", c.within_plans,
                                                 "A mission may end within a burst; false: a burst "
                                                 "is flown to its end (the authors' code).");
  papers("max_distance_m", c.max_distance_m, {0, 1e9},
         "The mission ends when the way to the next view would make the planned way longer than "
         "this; 0: no limit.");
  papers("max_flight_time_s", c.max_flight_time_s, {0, 1e9},
         "The mission ends this long after its beginning, also in flight; 0: no limit.");
  by_gain.of_papers_setting()("min_new_voxels_per_m", c.min_new_voxels_per_m, {0, 1e9},
                              "The mission ends when fewer voxels of the map than this become "
                              "occupied per planned metre; 0: never.");
  by_gain.only_if(c.min_new_voxels_per_m != 0.0, ".min_new_voxels_per_m")(
      "new_voxels_window", c.new_voxels_window, {1, 1e6},
      "Views over which min_new_voxels_per_m is taken.");
  by_gain.of_papers_setting()(
      "max_views_without_new_points", c.max_views_without_new_points, {0, 1e6},
      "The mission ends after this many views in a row that add no point to the cloud; 0: never.");
}

void fields(const Keys& key, PlannerConfig& c) {
  const std::string before = c.preset;
  key("preset", c.preset, kPlannerPresets,
      "Sets the switches in which these differ: the paper, its authors' code of 2017 (released), "
      "the code behind the paper (authors_2018), and a flight without a profile (takeoff).");
  if (c.preset != before) set_preset_switches(c, before);
  const Keys scoring = key.only_if(scores_views, kUtility);
  key.section("map", c.map, "The occupancy grid.");
  key.section("cloud", c.cloud, "The surface cloud.");
  key("floor_z_m", c.floor_z_m, {-1e4, 1e4},
      "Returns below this height are floor: they clear voxels and mark none.");
  key.of_papers_setting().section("object_bounds_m", c.object_bounds_m,
                                  "Where entropy and information count, world ENU.");
  key.section("profiling", c.profiling, "The rough scan before the first view.");
  scoring.section("agvs", c.agvs, "Adaptive grid view sampling.");
  scoring.section("fvs", c.fvs, "Frontier view sampling.");
  key.section("validity", c.validity, "Which views may be flown to.");
  key.section("utility", c.utility, "What a view is worth.");
  key.section("routes", c.routes, "Baselines whose views are laid around the profile.");
  key.only_if(knows_structure, kUtility)
      .section("oracle", c.oracle, "What a planner that knows the structure is asked for.");
  key.only_if(makes_tours, kUtility).section("tour", c.tour, "The tour of all that lacks points.");
  key.only_if(would_read_prediction, kUtility)
      .only_if(has_profile, "planner.profiling.method")
      .only_if(c.utility.gamma > 0.0 || is_user_utility(c.utility.name), "planner.utility.gamma")
      .section("symmetry", c.symmetry, "The mirror image of the profile.");
  key.section("termination", c.termination, "When the mission is over.");
}

}  // namespace gnbv
