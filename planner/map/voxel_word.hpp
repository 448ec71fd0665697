// What the walk of a candidate's rays asks of a voxel, packed into 32 bits: one load (one lane of a
// gather) answers all of it. Zero is a voxel that no scan has touched.
#pragma once

#include <cstdint>

namespace gnbv {

enum class VoxelState : std::uint8_t { unknown = 0, free = 1, occupied = 2 };

using VoxelWord = std::uint32_t;

// bits 0-1: VoxelState; bit 2: any scan touched it; bit 3: predicted to be surface by symmetry,
// bit 4: within the shadow band behind a surface; both are dropped with the first measurement;
// bits 5-7: 0; bits 8-31: what is already known of it, ln 2 minus Eq. (1), in units of 2^-24 nat
constexpr VoxelWord kStateMask = 3U;
constexpr VoxelWord kMeasuredBit = 4U;
constexpr VoxelWord kPredictedBit = 8U;
constexpr VoxelWord kShadowBit = 16U;
constexpr unsigned kKnownShift = 8;
constexpr std::uint32_t kLn2Units = 11629080;  // ln 2 in 2^-24 nat; exactly float32's ln 2
constexpr double kEntropyUnit_nat = 0x1p-24;

constexpr VoxelState state_of(VoxelWord word) { return static_cast<VoxelState>(word & kStateMask); }
/// Eq. (1) in units of 2^-24 nat; an integer, so that no order of summation changes a sum.
constexpr std::uint32_t entropy_units_of(VoxelWord word) {
  return kLn2Units - (word >> kKnownShift);
}
constexpr VoxelWord measured_word(VoxelState state, std::uint32_t entropy_units) {
  return static_cast<VoxelWord>(state) | kMeasuredBit | (kLn2Units - entropy_units) << kKnownShift;
}

}  // namespace gnbv
