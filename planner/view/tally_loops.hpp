// The voxels a view has marked, counted and unmarked. For view_loops.cpp alone.
#pragma once

#include "planner/map/voxel_word.hpp"
#include "planner/view/view_kernels.hpp"
#include "planner/view/wide_sums.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kTallyChunk = 64;
constexpr int kChunksPerFlush = 256 * kLanes / 64;  // as kStepsPerFlush

void tally_group(const ViewMaps& maps, std::size_t first, Mask marked, VoxelSums& sums,
                 Ints& known_sum) {
  const Ints word = load_where(marked, maps.words + first);
  known_sum = known_sum + shift_right<kKnownShift>(word);
  sums.visited += count(marked);
  const auto has = [&](std::uint32_t word_bits) { return marked & has_bit(word, word_bits); };
  const auto list = [&](Mask which, std::int32_t* out, std::size_t& out_count) {
    if (!any(which)) return;  // mostly
    const Ints voxel = all(static_cast<std::int32_t>(first)) + int_ramp();
    out_count += static_cast<std::size_t>(pack(which, voxel, out + out_count));
  };
  sums.free += count(has(static_cast<std::uint32_t>(VoxelState::free)));
  list(has(static_cast<std::uint32_t>(VoxelState::occupied)), sums.occupied, sums.occupied_count);
  if (sums.shadow != nullptr) list(has(kShadowBit), sums.shadow, sums.shadow_count);
}

inline bool is_blank(const std::uint8_t* marks) {
  std::uint64_t eights[kTallyChunk / 8];
  __builtin_memcpy(eights, marks, kTallyChunk);
  std::uint64_t some = 0;
  for (const std::uint64_t eight : eights) some |= eight;
  return some == 0;
}

void tally_plane(const ViewMaps& maps, const VoxelRows& rows, VoxelSums& sums) {
  Ints known_sum = all(0);
  WideLanes known_wide;
  int chunks = 0;
  for (std::size_t row = 0; row < rows.count; ++row) {
    const std::size_t first = rows.first + row * rows.stride;
    for (std::size_t at = first; at < first + rows.length; at += kTallyChunk) {
      if (is_blank(maps.marks + at)) continue;
      for (std::size_t group = at; group < at + kTallyChunk; group += kLaneCount) {
        const Mask marked = equal_bytes(maps.marks + group, kMarked);
        if (any(marked)) tally_group(maps, group, marked, sums, known_sum);
      }
      __builtin_memset(maps.marks + at, 0, kTallyChunk);
      if (++chunks % kChunksPerFlush == 0) flush(known_sum, known_wide);
    }
  }
  flush(known_sum, known_wide);
  sums.known += sum_of(known_wide);
}

}  // namespace
}  // namespace gnbv
