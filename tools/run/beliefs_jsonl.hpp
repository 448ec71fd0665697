// beliefs.jsonl: the voxels for whose sake each view was chosen, as they were believed before it.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "planner/map/grid_geometry.hpp"
#include "tools/run/decision_lines.hpp"

namespace gnbv {

/// Voxels [first, first + length) of the map.
struct VoxelRun {
  VoxelIndex first = 0;
  std::uint32_t length = 0;

  bool operator==(const VoxelRun&) const = default;
};

/// Runs in ascending order, with gaps between them.
using VoxelRuns = std::vector<VoxelRun>;

/// Of ascending voxels, each once.
VoxelRuns runs_of(std::span<const VoxelIndex> voxels);
std::size_t voxel_count(const VoxelRuns& runs);

/// What a decision knew.
struct BelievedVoxels {
  VoxelRuns unknown = {};    // that the rays of its views cross (VoxelsInSight)
  VoxelRuns predicted = {};  // that they meet first
  VoxelRuns frontier = {};   // of all clusters that might be tried, where any was sampled around
  VoxelRuns looked_at = {};  // of them those of the clusters that its views are of
};

/// One JSON object a line and decision: `iteration` of its first view, and the four lists,
/// those without voxels left out: of each run the gap to the end of the one before (the first one's
/// to voxel 0), then its length. Voxels count along x first, then y, then z, through the lattice of
/// workspace and map.resolution_m. Written as candidates.jsonl is.
class BeliefsFile : public DecisionLines {
 public:
  /// What an interrupted run wrote of decisions before `first_iteration` is kept; an older
  /// program's run wrote none. Throws BadInput naming the file.
  BeliefsFile(const std::filesystem::path& folder, std::size_t first_iteration);

  void write(std::size_t iteration, const BelievedVoxels& voxels);
};

/// Of the first `iterations` iterations in their order; those that nothing is told of have no
/// voxels. Empty for a run that wrote none. Throws BadInput naming file and line of whatever is
/// damaged, as voxels from `voxels` on are.
std::vector<BelievedVoxels> read_beliefs(const std::filesystem::path& run, std::size_t iterations,
                                         std::size_t voxels);

}  // namespace gnbv
