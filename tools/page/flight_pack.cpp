// Where the vehicle flew, and where a tour still meant to.
#include <algorithm>
#include <cmath>

#include "tools/page/packs.hpp"
#include "tools/run/tour_files.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kSampleBytes = 18;   // of a sample of the path
constexpr std::size_t kPlannedBytes = 28;  // of a planned view

void add(const Vec3& place, const Eigen::Quaterniond& q, std::vector<float>& poses) {
  for (const double number : {place.x(), place.y(), place.z(), q.x(), q.y(), q.z(), q.w()}) {
    poses.push_back(static_cast<float>(number));
  }
}

}  // namespace

page::PathData pack_path(std::span<const TrajectorySample> path, std::size_t max_bytes,
                         page::Arrays& arrays) {
  std::vector<Vec3f> points;
  std::vector<float> time_s;
  std::vector<std::int16_t> quaternion;
  const std::size_t room = std::max(kLeastElements, max_bytes / kSampleBytes);
  const std::size_t every = (path.size() + room - 2) / (room - 1);
  for (std::size_t i = 0; i < path.size();) {
    const TrajectorySample& sample = path[i];
    points.push_back(sample.T_world_body.translation().cast<float>());
    time_s.push_back(static_cast<float>(sample.time_s));
    const Eigen::Quaterniond q(sample.T_world_body.linear());
    for (const double c : {q.x(), q.y(), q.z(), q.w()}) {
      quaternion.push_back(static_cast<std::int16_t>(std::lround(32767.0 * c)));
    }
    i = i + 1 == path.size() ? path.size() : std::min(i + every, path.size() - 1);
  }
  return {.points = arrays.add_points(points),
          .time = arrays.add(time_s),
          .quaternion = arrays.add<4>(quaternion)};
}

page::PlanData pack_plan(const RunRecord& record, std::size_t max_bytes, page::Arrays& arrays) {
  const std::vector<MadePlan> plans = read_plans(record);
  const std::size_t ranges_bytes = 2 * sizeof(std::uint32_t) * record.views.size();
  const std::size_t room =
      std::max(kLeastElements, (max_bytes - std::min(max_bytes, ranges_bytes)) / kPlannedBytes /
                                   std::max<std::size_t>(1, plans.size()));
  const CameraModel camera = make_camera_model(sights_of(record.scenario).front());
  std::vector<float> poses;
  std::vector<std::uint32_t> begins;  // of each plan
  const auto end_now = [&] { return static_cast<std::uint32_t>(poses.size() / 7); };
  for (const MadePlan& made : plans) {
    begins.push_back(end_now());
    for (std::size_t i = 0; i < std::min(room, made.plan.views.size()); ++i) {
      const ViewPose& view = made.plan.views[i];
      const Isometry T_world_camera =
          T_world_body(view) * turned(camera, view.gimbal_pitch_rad).T_body_camera;
      add(view.p_world_m, Eigen::Quaterniond(T_world_camera.linear()), poses);
    }
  }
  begins.push_back(end_now());
  std::vector<std::uint32_t> ranges;
  for (std::size_t view = 0; view < record.views.size(); ++view) {
    const auto standing = standing_plan(plans, record, view);
    if (!standing) {
      ranges.insert(ranges.end(), {0, 0});
      continue;
    }
    const auto plan = static_cast<std::size_t>(standing->made - plans.data());
    const std::uint32_t end = begins[plan + 1];
    const auto next = begins[plan] + static_cast<std::uint32_t>(standing->next);
    ranges.insert(ranges.end(), {std::min(next, end), end});
  }
  return {.poses = arrays.add<7>(poses), .ranges = arrays.add<2>(ranges)};
}

}  // namespace gnbv
