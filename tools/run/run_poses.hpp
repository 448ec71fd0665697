// Poses of a run that its files say only together.
#pragma once

#include <optional>
#include <string_view>

#include "tools/run/run_record.hpp"

namespace gnbv {

/// Throws BadInput naming trajectory.tum, and the command that makes it, when the run has no path.
void need_path(const RunRecord& record);

/// T_world_body as it truly was, between the samples of the path: straight, and along the shorter
/// arc. For one period after the last sample, 0.1 s, that one holds: a run ends where it hovers to
/// see. Nothing before the first sample or later.
std::optional<Isometry> true_pose_at(const RunRecord& record, double time_s);

/// The camera as the scenario mounts it. Throws BadInput naming it when the scenario has none.
CameraModel camera_named(const RunRecord& record, std::string_view name);

}  // namespace gnbv
