// trajectory.tum: the true path of the body, as `evo_traj tum` opens it.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tools/run/mission_result.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {

/// A line of the format: time and pose (pose_text()).
std::string tum_line(double time_s, const Isometry& T);

/// A comment that says whose poses these are, then a line a sample.
std::string tum_text(std::string_view whose, std::span<const TrajectorySample> path_world);

/// trajectory.tum of a run.
std::string trajectory_tum(std::span<const TrajectorySample> path_world);

/// The samples, times ascending, one at least. Throws BadInput naming file and line for whatever
/// is damaged or not near the workspace.
std::vector<TrajectorySample> read_trajectory_tum(const std::filesystem::path& file,
                                                  const Box3& workspace_m);

/// Throws BadInput for a place that no vehicle of this scenario can have been at: farther from the
/// workspace than that is wide, which no drift of an estimate explains.
void need_near_workspace(const Vec3& p_world_m, const Box3& workspace_m, const TextPlace& place);

}  // namespace gnbv
