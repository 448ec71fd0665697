// What a planner of the user's own may ask of the belief: what the planners of C++ ask. This file
// and its .cpp include nothing but the planner (tools/check_layers): no truth is in reach.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "planner/config.hpp"
#include "planner/core/belief.hpp"
#include "planner/core/plan.hpp"
#include "planner/motion/paths.hpp"
#include "planner/view/view_stats.hpp"

namespace gnbv {

/// What questions need that are not about the belief alone. Kept for a mission; one question at a
/// time.
struct BeliefTools {
  BeliefTools(const PlannerConfig& planner_config, const PlannerModel& planner_model, int threads)
      : config(planner_config), model(planner_model), scratch(model, threads) {}
  const PlannerConfig config;
  const PlannerModel model;
  Scratch scratch;
};

/// The edges of the map along z, y, x, in voxels: the shape of its dense arrays.
std::vector<std::size_t> grid_shape(const Belief& belief);
/// The lowest corner of voxel (0, 0, 0).
Vec3 grid_origin_m(const Belief& belief);

/// Flat indices (z, y, x) of the voxels that hold points, and the density of each.
std::pair<std::vector<std::int64_t>, std::vector<double>> voxel_densities(const Belief& belief);

/// The grid of views around the current one, its steps times `scale`.
std::vector<ViewPose> views_around(const BeliefTools& tools, const ViewPose& current, double scale);
/// Views of the thinly sampled surface.
std::vector<ViewPose> views_of_frontiers(BeliefTools& tools, const Belief& belief);

/// Each as the mission will find it: rejected or not, and the length of the way there.
std::vector<Candidate> checked_views(BeliefTools& tools, const Belief& belief,
                                     const ViewPose& current, std::span<const ViewPose> views);
/// What each would see, rays included; path_m is the straight way.
std::vector<ViewStats> evaluated_views(BeliefTools& tools, const Belief& belief,
                                       const ViewPose& current, std::span<const ViewPose> views);
/// The way around what blocks the straight one.
FoundPath way_around(const BeliefTools& tools, const Belief& belief, const Vec3& from_m,
                     const Vec3& to_m);

}  // namespace gnbv
