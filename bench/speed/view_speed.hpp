// How fast a candidate view is evaluated, against the paper's way (bench/reference).
#pragma once

#include <vector>

#include "bench/speed/speed_row.hpp"

namespace gnbv {

/// Rows, in thread CPU time on one thread:
/// - candidate: one candidate (two cameras of 47 x 34 rays) at the best level this processor has,
///   against the paper's way on an octomap::OcTree, and beside it the competent one
///   (KeysetViewTwin);
/// - candidate_avx2, candidate_baseline: the same at that level, if the processor has it;
/// - all_utilities_over_one: `ours` is what the metrics of all utilities cost and scoring them all,
///   `reference` what one utility of voxel counts costs; the ratio is to stay below its target.
/// `identical`: summed over candidates, the unique counts differ from those of OctoMap's exact walk
/// by no more than 1e-5 of the voxels, and those of the key sets by none.
std::vector<SpeedRow> view_speed();

}  // namespace gnbv
