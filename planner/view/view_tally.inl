// The voxels a view has marked, counted and unmarked, see view_kernel.hpp.

namespace gnbv {
namespace {

constexpr std::size_t kTallyChunk = 64;
constexpr int kChunksPerFlush = 256 * kLanes / 64;  // as kStepsPerFlush

void tally_group(const ViewMaps& maps, std::size_t first, Mask marked, VoxelSums& sums,
                 Ints& known_sum) {
  const Ints word = load_where(marked, maps.words + first);
  known_sum = add(known_sum, shift_right<kKnownShift>(word));
  sums.visited += count(marked);
  sums.free += count(has_bits(marked, word, static_cast<std::uint32_t>(VoxelState::free)));
  const auto list = [&](Mask which, std::int32_t* out, std::size_t& out_count) {
    for (std::uint32_t left = bits(which); left != 0; left &= left - 1) {
      out[out_count++] = static_cast<std::int32_t>(first) + __builtin_ctz(left);
    }
  };
  list(has_bits(marked, word, static_cast<std::uint32_t>(VoxelState::occupied)), sums.occupied,
       sums.occupied_count);
  if (sums.shadow != nullptr) {
    list(has_bits(marked, word, kShadowBit), sums.shadow, sums.shadow_count);
  }
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
        const Mask marked = nonzero_bytes(maps.marks + group);
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
