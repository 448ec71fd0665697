// Frontier views as the paper has them: a burst of views that covers a cluster, flown one after the
// other without any utility (section 2.4; the authors' code, view_generator_frontier.cpp).
#pragma once

#include <span>
#include <vector>

#include "planner/core/planner.hpp"
#include "planner/guided/view_sampling.hpp"

namespace gnbv {

/// What the bursts of a mission leave behind them.
struct BurstMemory {
  FrontierMarks ignored;  // 1 for voxels of clusters that were tried; empty before the first burst
  int retries = 0;        // after bursts without a view
  int clusters = 0;       // that the next burst covers
};

/// What bursts are planned on.
struct BurstTask {
  const FvsConfig& fvs;
  const PlannerModel& model;
  const ValidityConfig& validity;
  const Belief& belief;
  std::span<const ViewPose> recent;
  const ViewPose& current;
  Scratch& scratch;
};

/// The points of the cloud (world) that views of the cluster have to cover: those nearer to its
/// centroid than the views are, by a metre (the authors' code).
std::vector<Vec3f> points_around(const FvsConfig& fvs, const SurfaceCloud& cloud,
                                 const FrontierCluster& cluster);

/// Adds a burst to the plan: its clusters, all candidates, and as `chosen` the views that are kept,
/// in the order of their flight. For each of the `memory.clusters` clusters nearest to the vehicle,
/// bearing after bearing, as long as less than share_to_cover of the points around it is in sight:
/// of the three heights the valid one from which most points are seen is kept, and these points are
/// taken away. Each way leads there from the view kept before. The voxels of the clusters are
/// ignored from then on, whatever came of it. Returns whether a view was kept; `plan.clusters` did
/// not grow when no cluster is left.
bool add_burst(const BurstTask& task, BurstMemory& memory, Plan& plan);

}  // namespace gnbv
