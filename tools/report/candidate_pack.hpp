// Why each view of a run was chosen: the candidates of all decisions in a block of bytes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/report/packed_points.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// What became of a candidate that was not rejected; a Rejection's number otherwise.
constexpr std::uint8_t kValidCandidate = 254;
constexpr std::uint8_t kChosenCandidate = 255;

/// In the order of their views, and of each decision in the order they were sampled.
struct PackedCandidates {
  PackedPoints points;
  ByteSlice angles_rad;  // float32 (n, 2): yaw, the gimbal's pitch
  ByteSlice kind;        // uint8
  ByteSlice terms;       // float32 (valid and chosen ones, 5): utility, information, density,
                         // prediction, distance
  ByteSlice begins;      // uint32 (views + 1): the first one of each view's decision, and the end
};

/// Nothing for a run that kept none. Throws BadInput when they take more than `max_bytes`, or are
/// damaged.
std::optional<PackedCandidates> pack_candidates(const RunRecord& record, std::size_t max_bytes,
                                                BytePack& bytes);

}  // namespace gnbv
