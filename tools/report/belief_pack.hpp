// For whose sake each view of a run was chosen: unknown, predicted and frontier voxels of all
// decisions in a block of bytes.
#pragma once

#include <array>
#include <optional>

#include "planner/map/grid_geometry.hpp"
#include "tools/report/byte_pack.hpp"
#include "tools/run/beliefs_jsonl.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// Lists of BelievedVoxels, by the names that the page gives them. One that goes from decision to
/// decision with few changes is packed as these: the cells that are in the list of one of two views
/// alone, of the view and the one before it that has any (the first such view: all of its cells).
struct BeliefList {
  const char* name;
  VoxelRuns BelievedVoxels::*voxels;
  bool has_changes;
};
constexpr std::array<BeliefList, 4> kBeliefLists = {
    {{"unknown", &BelievedVoxels::unknown, false},
     {"predicted", &BelievedVoxels::predicted, false},
     {"frontier", &BelievedVoxels::frontier, true},
     {"looked_at", &BelievedVoxels::looked_at, false}}};

/// One list of all views.
struct PackedBeliefList {
  ByteSlice runs;    // uint8: of each run the gap to the end of the one before, then its length,
                     // seven bits a byte, the lowest first, 128 set where more follow (LEB128)
  ByteSlice begins;  // uint32 (views + 1): the first byte of each view's runs, and the end
  ByteSlice counts;  // uint32 (views): how many of the map's voxels they are
};

/// A lattice cell covers [index, index + 1) * size_m; cells count along x first, then y, then z.
struct PackedBeliefs {
  double size_m = 0.0;  // the map's, or twice, four times ... that, so that the page can carry them
  Key low = {0, 0, 0};  // index of the lattice's first cell
  Key cells = {0, 0, 0};
  std::array<std::optional<PackedBeliefList>, kBeliefLists.size()> lists;  // that hold anything
};

/// A larger cell is of a list when any of its voxels is. Nothing for a run that kept none. Throws
/// BadInput when they are damaged.
std::optional<PackedBeliefs> pack_beliefs(const RunRecord& record, std::size_t max_bytes,
                                          BytePack& bytes);

/// The sentence for a run that kept candidates, but not these: an older program's; empty otherwise.
std::string why_no_beliefs(const RunRecord& record);

}  // namespace gnbv
