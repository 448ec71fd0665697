// Which clusters of density frontiers FVS looks at, in which order, and which views see them.
#pragma once

#include <span>
#include <vector>

#include "planner/core/plan.hpp"
#include "planner/map/frontiers.hpp"

namespace gnbv {

struct Belief;
struct CameraModel;
struct FvsConfig;

/// The clusters that a decision made at `from_world_m`, after those made before, may try: in their
/// order, FvsConfig::tries of them at most. A cluster that is still there after looks_max views
/// around it stays (glass, a slit, an edge) and is left out.
std::vector<FrontierCluster> clusters_to_try(const FvsConfig& fvs, const Belief& belief,
                                             std::span<const Decision> decisions,
                                             const Vec3& from_world_m, FrontierMarks& marks);

/// cluster_outside_fov when no camera has the centroid in its frustum; cluster_hidden when none
/// sees a voxel of the cluster, if `needs_visible_cluster`; else nothing.
std::optional<Rejection> cluster_rejection(std::span<const CameraModel> cameras,
                                           const OccupancyGrid& grid,
                                           const FrontierCluster& cluster, const ViewPose& view,
                                           bool needs_visible_cluster);

}  // namespace gnbv
