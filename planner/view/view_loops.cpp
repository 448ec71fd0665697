// The view kernels, once for each SimdLevel; here the count of the voxels that the walk has marked.
#include "planner/view/walk_loops.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kTallyChunk = 64;
// each adds as many terms to a lane of LongSum as it has groups
constexpr int kChunksPerCarry = LongSum::kTermsPerCarry * kLanes / static_cast<int>(kTallyChunk);

void tally_group(const ViewMaps& maps, std::size_t first, Mask marked, VoxelSums& sums,
                 LongSum& known_sum) {
  const Ints word = hn::IfThenElseZero(marked, load(maps.words + first));
  known_sum.low = known_sum.low + shift_right<kKnownShift>(word);
  sums.visited += count(marked);
  sums.free += count(marked & has_bit(word, static_cast<std::uint32_t>(VoxelState::free)));
  const Mask occupied = marked & has_bit(word, static_cast<std::uint32_t>(VoxelState::occupied));
  if (any(occupied)) {
    const Ints voxel = all(static_cast<std::int32_t>(first)) + int_ramp();
    std::int32_t* const to = sums.occupied + sums.occupied_count;
    sums.occupied_count += static_cast<std::size_t>(pack(occupied, voxel, to));
  }
  const Mask shadow = marked & has_bit(word, kShadowBit);
  if (maps.shadow_steps != nullptr && any(shadow)) {
    sums.shadow += count(shadow);
    sums.shadow_steps += sum_of(select(shadow, load_bytes(maps.shadow_steps + first), all(0)));
  }
}

inline bool is_blank(const std::uint8_t* marks) {
  std::uint64_t eights[kTallyChunk / 8];
  __builtin_memcpy(eights, marks, kTallyChunk);
  std::uint64_t some = 0;
  for (const std::uint64_t eight : eights) some |= eight;
  return some == 0;
}

void tally(const ViewMaps& maps, const VoxelBox& box, VoxelSums& sums) {
  LongSum known_sum;
  int chunks = 0;
  for (std::size_t row = 0; row < box.rows * box.planes; ++row) {
    const std::size_t first =
        box.first + row % box.rows * box.row_stride + row / box.rows * box.plane_stride;
    for (std::size_t at = first; at < first + box.length; at += kTallyChunk) {
      if (is_blank(maps.marks + at)) continue;
      for (std::size_t group = at; group < at + kTallyChunk; group += kLanes) {
        const Mask marked = equal_bytes(maps.marks + group, kMarked);
        if (any(marked)) tally_group(maps, group, marked, sums, known_sum);
      }
      __builtin_memset(maps.marks + at, 0, kTallyChunk);
      if (++chunks % kChunksPerCarry == 0) known_sum.carry();
    }
  }
  sums.known += known_sum.total(every_lane());
}

}  // namespace

namespace GNBV_SIMD_LEVEL {

const ViewKernels kViewKernels = {
    .walk_voxels = walk_rays<false>, .walk_full = walk_rays<true>, .tally = tally};

}  // namespace GNBV_SIMD_LEVEL
}  // namespace gnbv
