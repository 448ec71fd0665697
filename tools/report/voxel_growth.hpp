// The voxels that hold points of a cloud, and how many of them each held after every view.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/run/run_record.hpp"

namespace gnbv {

/// State n is that after n views; 0 after the profile. What came after the last view counts to it.
/// A gain says that a voxel got points on the way to a state: the gains of one state are in the
/// order of their voxels, each a step from the voxel of the gain before (the first from voxel 0). A
/// step or a number too large for its type is made of several gains, whose points may be 0.
struct VoxelGrowth {
  std::vector<std::int16_t> index;         // (n, 3): the voxel covers [index, index + 1) * size
  std::vector<std::uint32_t> after;        // (states): how many voxels there are; the first ones
  std::vector<std::uint16_t> gain_step;    // (gains)
  std::vector<std::uint8_t> gain_points;   // (gains)
  std::vector<std::uint32_t> gains_after;  // (states): the gains up to this state

  std::size_t bytes() const;
};

/// In voxels of a lattice of `size_m` that stands at the origin, in the order in which they got
/// their first point. Requires size_m > 0 and points within 2^15 voxels of the origin.
VoxelGrowth voxel_growth(const RunCloud& cloud, double size_m);

}  // namespace gnbv
