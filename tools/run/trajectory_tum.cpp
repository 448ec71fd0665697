#include "tools/run/trajectory_tum.hpp"

#include <array>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

TrajectorySample sample_of(std::string_view row, const TextPlace& place) {
  std::array<double, 8> values{};  // time x y z qx qy qz qw
  for (double& value : values) {
    if (row.empty()) throw BadInput("{}: fewer than 8 values", to_string(place));
    value = to_number(next_part(row, ' '), place, "one of the 8 values");
    row = trimmed(row);
  }
  if (!row.empty()) throw BadInput("{}: more than 8 values", to_string(place));
  return {values[0], to_pose(std::span(values).subspan<1>(), place)};
}

}  // namespace

std::string tum_line(double time_s, const Isometry& T) {
  return fmt::format("{:.3f} {}\n", time_s, pose_text(T, ' '));
}

std::string tum_text(std::string_view whose, std::span<const TrajectorySample> path_world) {
  std::string text = fmt::format("# time_s x_m y_m z_m qx qy qz qw, {}\n", whose);
  for (const TrajectorySample& s : path_world) text += tum_line(s.time_s, s.T_world_body);
  return text;
}

std::string trajectory_tum(std::span<const TrajectorySample> path_world) {
  return tum_text("body FLU in world ENU", path_world);
}

std::vector<TrajectorySample> read_trajectory_tum(const std::filesystem::path& file,
                                                  const Box3& workspace_m) {
  std::vector<TrajectorySample> samples;
  for_each_line(read_file(file), file, [&](std::string_view line, const TextPlace& place) {
    const std::string_view row = trimmed(line);
    if (row.empty() || row.front() == '#') return;
    const TrajectorySample sample = sample_of(row, place);
    if (!samples.empty() && sample.time_s < samples.back().time_s) {
      throw BadInput("{}: time {} s goes back", to_string(place), sample.time_s);
    }
    need_near_workspace(sample.T_world_body.translation(), workspace_m, place);
    samples.push_back(sample);
  });
  if (samples.empty()) throw BadInput("{}: holds no pose", file.string());
  return samples;
}

void need_near_workspace(const Vec3& p_world_m, const Box3& workspace_m, const TextPlace& place) {
  if (workspace_m.exteriorDistance(p_world_m) < workspace_m.diagonal().norm()) return;
  throw BadInput("{}: stands at {:g} {:g} {:g} m, far out of the workspace", to_string(place),
                 p_world_m.x(), p_world_m.y(), p_world_m.z());
}

}  // namespace gnbv
