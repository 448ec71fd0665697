// profile.map: what was believed after the profile, so that another mission can begin there.
#pragma once

#include <filesystem>

#include "planner/core/belief.hpp"

namespace gnbv {

/// Writes all of the belief, exactly. Little-endian: the line "gnbv belief 1", the float64 settings
/// it was made with, has_depth_return, the cloud's points in their order as float32 triples, the
/// voxels as runs of equal ones, the shadow band, and the SHA-256 of it all. Whole or not at all,
/// by rename. Throws BadInput when it cannot be written.
void write_belief(const Belief& belief, const std::filesystem::path& path);

/// The belief of the file, which goes on as the written one would have, bit by bit. Throws BadInput
/// naming the file when it cannot be read, is no belief, is damaged or cut short, or is that of
/// another map than the model's.
Belief read_belief(const std::filesystem::path& path, const PlannerModel& model);

}  // namespace gnbv
