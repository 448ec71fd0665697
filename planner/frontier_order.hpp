// Which clusters of density frontiers FVS looks at, and in which order.
#pragma once

#include <span>
#include <vector>

#include "planner/decision.hpp"
#include "planner/map/frontiers.hpp"

namespace gnbv {

struct Belief;
struct FvsConfig;

/// The clusters that a decision made at `from_world_m`, after those made before, may try: in their
/// order, FvsConfig::tries of them at most. A cluster that is still there after looks_max views
/// around it stays (glass, a slit, an edge) and is left out.
std::vector<FrontierCluster> clusters_to_try(const FvsConfig& fvs, const Belief& belief,
                                             std::span<const Decision> decisions,
                                             const Vec3& from_world_m, FrontierMarks& marks);

}  // namespace gnbv
