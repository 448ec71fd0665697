#include "tools/run/run_poses.hpp"

#include <algorithm>

#include "sim/core/error.hpp"
#include "tools/run/file_names.hpp"

namespace gnbv {
namespace {

constexpr double kHeld_s =
    0.1001;  // a period of the path's samples, and what their text rounds off

}  // namespace

void need_path(const RunRecord& record) {
  if (!record.path.empty()) return;
  const std::string file = (record.folder / kTrajectoryFile).string();
  for (const std::string& sentence : record.missing) {
    if (sentence.find(file) != std::string::npos) throw BadInput(sentence);
  }
  throw BadInput(fmt::format("{}: is missing", file));
}

std::optional<Isometry> true_pose_at(const RunRecord& record, double time_s) {
  const auto after = std::lower_bound(
      record.path.begin(), record.path.end(), time_s,
      [](const TrajectorySample& sample, double t_s) { return sample.time_s < t_s; });
  if (after == record.path.end()) {
    const bool is_held = !record.path.empty() && time_s <= record.path.back().time_s + kHeld_s;
    return is_held ? std::optional(record.path.back().T_world_body) : std::nullopt;
  }
  if (after->time_s == time_s) return after->T_world_body;
  if (after == record.path.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double share = (time_s - before->time_s) / (after->time_s - before->time_s);
  const Vec3 from = before->T_world_body.translation();
  const Vec3 to = after->T_world_body.translation();
  const Eigen::Quaterniond turn(before->T_world_body.linear());
  Isometry T_world_body = Isometry::Identity();
  T_world_body.translate(from + share * (to - from));
  T_world_body.rotate(turn.slerp(share, Eigen::Quaterniond(after->T_world_body.linear())));
  return T_world_body;
}

CameraModel camera_named(const RunRecord& record, std::string_view name) {
  for (const CameraConfig& camera : record.scenario.cameras) {
    if (camera.name == name) return make_camera_model(camera);
  }
  throw BadInput(fmt::format("{}: cameras.json names '{}', which scenario.yaml does not have",
                             (record.folder / kFramesFolder).string(), name));
}

}  // namespace gnbv
