#include "tools/mission/belief_questions.hpp"

#include "planner/guided/view_sampling.hpp"
#include "planner/map/frontiers.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

std::vector<std::size_t> grid_shape(const Belief& belief) {
  const Key& size = belief.grid.geometry().size();
  return {static_cast<std::size_t>(size[2]), static_cast<std::size_t>(size[1]),
          static_cast<std::size_t>(size[0])};
}

Vec3 grid_origin_m(const Belief& belief) {
  const Key& low = belief.grid.geometry().min_key();
  return belief.grid.geometry().resolution_m() * Vec3(low[0], low[1], low[2]);
}

std::pair<std::vector<std::int64_t>, std::vector<double>> voxel_densities(const Belief& belief) {
  const std::span<const VoxelIndex> voxels = belief.cloud.voxels();
  std::vector<double> densities;
  for (const VoxelIndex v : voxels) densities.push_back(belief.cloud.density(v));
  return {{voxels.begin(), voxels.end()}, std::move(densities)};
}

std::vector<ViewPose> views_around(const BeliefTools& tools, const ViewPose& current,
                                   double scale) {
  return sample_agvs(tools.config.agvs, current, scale, tools.model.pitches_rad);
}

std::vector<ViewPose> views_of_frontiers(BeliefTools& tools, const Belief& belief) {
  const FvsConfig& fvs = tools.config.fvs;
  std::vector<ViewPose> views;
  for (const FrontierCluster& cluster :
       find_frontiers(fvs.frontier, belief.grid, belief.cloud, tools.scratch.frontier_marks)) {
    const std::vector<ViewPose> around =
        sample_fvs(fvs, cluster.centroid_world_m, tools.model.pitches_rad);
    views.insert(views.end(), around.begin(), around.end());
  }
  return views;
}

std::vector<Candidate> checked_views(BeliefTools& tools, const Belief& belief,
                                     const ViewPose& current, std::span<const ViewPose> views) {
  const PlannerModel& model = tools.model;
  ViewChecker checker(model.validity_around, model.navigation_m, model.no_fly, belief.grid, {},
                      current);
  std::vector<Candidate> candidates;
  for (const ViewPose& view : views) {
    candidates.push_back({.view = view, .sampler = Sampler::route});
    check(checker, model, candidates.back());
  }
  return candidates;
}

std::vector<ViewStats> evaluated_views(BeliefTools& tools, const Belief& belief,
                                       const ViewPose& current, std::span<const ViewPose> views) {
  const PlannerModel& model = tools.model;
  const double density_max = belief.cloud.density_max();
  const ViewOptions options = {
      .detail = ViewDetail::rays,
      .sparse_below = tools.config.fvs.frontier.density_share * density_max};
  std::vector<VisitMarks>& marks = tools.scratch.marks;
  std::vector<ViewStats> stats(views.size());
  parallel_for(tools.scratch.threads, marks.size(), [&](std::size_t share) {
    for (std::size_t i = share; i < views.size(); i += marks.size()) {
      stats[i] = evaluate_view(belief.grid, belief.cloud, model.rays_at(views[i].gimbal_pitch_rad),
                               views[i], marks[share], options);
      stats[i].density_max = density_max;
      stats[i].path_m = (views[i].p_world_m - current.p_world_m).norm();
    }
  });
  return stats;
}

FoundPath way_around(const BeliefTools& tools, const Belief& belief, const Vec3& from_m,
                     const Vec3& to_m) {
  const PlannerModel& model = tools.model;
  const ValidityConfig& validity = model.validity;
  return find_path(validity.path_search,
                   {belief.grid, model.navigation_m, model.no_fly, validity.collision_radius_m,
                    validity.allow_unknown},
                   from_m, to_m);
}

}  // namespace gnbv
