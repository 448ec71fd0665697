#include "scenarios/fields.hpp"

namespace gnbv {
namespace {

constexpr std::array<Named<ProfilingMethod>, 2> kProfilingMethods = {
    {{ProfilingMethod::bounding_box, "bounding_box"}, {ProfilingMethod::none, "none"}}};
constexpr std::array<Named<DensityTerm>, 2> kDensityTerms = {
    {{DensityTerm::sparse, "sparse"}, {DensityTerm::literal, "literal"}}};

}  // namespace

void fields(FieldVisitor& v, OccupancyConfig& c) {
  v.number("resolution_m", c.resolution_m, between(0.001, 10), "Edge of a voxel.");
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
  v.choice("method", c.method, kProfilingMethods, "The rough scan before the first view.");
  v.flag("scan_in_transit", c.scan_in_transit, "LIDAR on between the descents too.");
}

void fields(FieldVisitor& v, AgvsConfig& c) {
  v.number("step_m", c.step_m, above_upto(0, 100), "Distance of the grid's positions at scale 1.");
  v.angle("yaw_step_deg", c.yaw_step_rad, above_upto(0, 180), "Between the yaws of a position.");
  v.flag("rotation_only", c.rotation_only,
         "Offer the current position with other yaws at scale 1.");
  v.number("scale_factor", c.scale_factor, between(1.1, 100),
           "Growth of the grid at a local minimum.");
  v.number("scale_max", c.scale_max, between(1, 1e3), "The grid's largest scale.");
  v.number("utility_threshold", c.utility_threshold, between(0, 1e9),
           "Local minimum: the best utility stays below this");
  v.integer("utility_window", c.utility_window, between(1, 1e6), "for so many views.");
  v.number("entropy_threshold_nat", c.entropy_threshold_nat, between(0, 1),
           "Or when no view changed the total entropy by more than this per voxel of its frusta");
  v.integer("entropy_window", c.entropy_window, {1, 1000}, "over this many views.");
}

void fields(FieldVisitor& v, ValidityConfig& c) {
  v.number("collision_radius_m", c.collision_radius_m, above_upto(0, 100),
           "Of the sphere that may touch no occupied voxel.");
  v.number("z_min_m", c.z_min_m, between(-1e4, 1e4), "No view below.");
  v.integer("recent_poses", c.recent_poses, between(0, 1e6), "Views that are not taken again.");
  v.number("recent_distance_m", c.recent_distance_m, between(0, 100),
           "The same view: nearer than this");
  v.angle("recent_yaw_deg", c.recent_yaw_rad, between(0, 180), "and turned by less than this.");
}

void fields(FieldVisitor& v, UtilityConfig& c) {
  constexpr Range kWeight = between(0, 1e9);
  v.choice("name", c.name, utility_names(), "Formula that ranks the candidate views.");
  v.number("alpha", c.alpha, kWeight, "Weight of information, Eq. (2).");
  v.number("beta", c.beta, kWeight, "Weight of density, Eq. (2).");
  v.number("gamma", c.gamma, kWeight, "Weight of prediction, Eq. (2).");
  v.number("lambda_per_m", c.lambda_per_m, kWeight, "Decay with distance, Eq. (2).");
  v.choice("density_term", c.density_term, kDensityTerms,
           "sparse: reward thinly sampled surface; literal: Eq. (2) as printed.");
}

void fields(FieldVisitor& v, TerminationConfig& c) {
  v.integer("max_iterations", c.max_iterations, between(1, 1e6), "Views at most.");
  v.number("entropy_change_percent", c.entropy_change_percent, between(0, 100),
           "Over when the total entropy changes by less, per view; 0: never.");
  v.integer("entropy_window", c.entropy_window, between(1, 1e6), "For so many views in a row.");
}

void fields(FieldVisitor& v, PlannerConfig& c) {
  v.section("map", c.map, "The occupancy grid.");
  v.section("cloud", c.cloud, "The surface cloud.");
  v.number("floor_z_m", c.floor_z_m, between(-1e4, 1e4),
           "Returns below are the floor: they clear, but mark nothing.");
  v.section("profiling", c.profiling, "The rough scan before the first view.");
  v.section("agvs", c.agvs, "Adaptive grid view sampling.");
  v.section("validity", c.validity, "Which views may be flown to.");
  v.section("utility", c.utility, "What a view is worth.");
  v.section("termination", c.termination, "When the mission is over.");
}

}  // namespace gnbv
