// seen_points() of oriented_cloud.hpp.
#include <algorithm>
#include <array>
#include <limits>

#include "bench/score/point_tree.hpp"
#include "sensors/camera_model.hpp"
#include "sim/core/error.hpp"
#include "tools/run/file_names.hpp"
#include "tools/surface/oriented_cloud.hpp"

namespace gnbv {
namespace {

bool shows(const CameraModel& camera, const Vec3& p_camera_m) {
  if (p_camera_m.z() <= 0.0) return false;
  const Eigen::Vector2d px = pixel_of(camera, p_camera_m);
  return px.x() >= 0.0 && px.x() <= camera.config.width_px && px.y() >= 0.0 &&
         px.y() <= camera.config.height_px;
}

/// The cameras of a view in the world; the first that shows the point saw it.
Vec3f sensor_of(const Vec3f& p_world_m, const ViewPose& view,
                const std::vector<CameraModel>& cameras) {
  const Isometry T_body_world = T_world_body(view).inverse();
  const Vec3 p_body_m = T_body_world * p_world_m.cast<double>();
  const auto camera = std::find_if(cameras.begin(), cameras.end(), [&](const CameraModel& c) {
    return shows(c, c.T_body_camera.inverse() * p_body_m);
  });
  const Vec3 p_sensor_body_m =
      camera == cameras.end() ? Vec3::Zero() : Vec3(camera->T_body_camera.translation());
  return (T_world_body(view) * p_sensor_body_m).cast<float>();
}

struct TimeSpan {
  double begin_s;
  double end_s;
};

/// Where the run was then, a pose each metre.
std::vector<Vec3f> poses_in(const RunRecord& record, const TimeSpan& span) {
  std::vector<Vec3f> poses_world_m;
  for (const TrajectorySample& sample : record.path) {
    if (sample.time_s < span.begin_s || sample.time_s > span.end_s) continue;
    const Vec3f p_m = sample.T_world_body.translation().cast<float>();
    if (poses_world_m.empty() || (p_m - poses_world_m.back()).norm() >= 1.0F) {
      poses_world_m.push_back(p_m);
    }
  }
  return poses_world_m;
}

/// Whether another point lies close to the first metres of the line from the point to the sensor.
bool is_hidden(const Vec3f& p_m, const Vec3f& sensor_m, const PointTree& cloud, float leaf_m) {
  constexpr float kLookAhead_m = 4.0F;
  const Vec3f way_m = sensor_m - p_m;
  const float end_m = std::min(way_m.norm(), kLookAhead_m);
  for (float s_m = 3.0F * leaf_m; s_m < end_m; s_m += 1.5F * leaf_m) {
    const auto found = cloud.nearest(p_m + s_m * way_m.normalized());
    if (found && found->distance_m < leaf_m) return true;
  }
  return false;
}

/// Points [begin, end) of the cloud, seen while it flew along the poses.
struct Stretch {
  std::size_t begin;
  std::size_t end;
  std::vector<Vec3f> poses_world_m;
};

/// For each of them the nearest pose between which and the point no other point lies.
void find_sensors(const PointTree& cloud, const Stretch& stretch, float leaf_m, int threads,
                  SeenPoints& seen) {
  const PointTree poses(stretch.poses_world_m);
  for_each_point(threads, stretch.end - stretch.begin, [&](std::size_t index) {
    const std::size_t i = stretch.begin + index;
    const Vec3f& p_m = seen.points_world_m[i];
    std::array<Neighbour, 32> near_poses{};
    const auto found = poses.nearest(p_m, near_poses);
    const auto seeing = std::find_if(found.begin(), found.end(), [&](const Neighbour& pose) {
      return !is_hidden(p_m, stretch.poses_world_m[pose.point], cloud, leaf_m);
    });
    const Neighbour& chosen = seeing == found.end() ? found.front() : *seeing;
    seen.sensors_world_m[i] = stretch.poses_world_m[chosen.point];
  });
}

/// The profile's points that are not within a leaf of a view's point.
std::vector<Vec3f> uncovered_profile(const RunCloud& cloud, float leaf_m, int threads) {
  const std::span<const Vec3f> all = cloud.points_world_m;
  const PointTree tree(all.subspan(cloud.profile_points));
  std::vector<std::uint8_t> is_covered(cloud.profile_points);
  for_each_point(threads, is_covered.size(), [&](std::size_t i) {
    const auto found = tree.nearest(all[i]);
    is_covered[i] = found && found->distance_m < leaf_m ? 1 : 0;
  });
  std::vector<Vec3f> kept;
  for (std::size_t i = 0; i < is_covered.size(); ++i) {
    if (is_covered[i] == 0) kept.push_back(all[i]);
  }
  return kept;
}

bool cameras_run_in_flight(const RunRecord& record) {
  return std::ranges::any_of(sights_of(record.scenario),
                             [](const CameraConfig& camera) { return camera.rate_hz > 0.0; });
}

/// The points of each part of the flight in which cameras or LIDARs ran: the profile, the legs, and
/// what came after the last view. `from_profile` of the seen points are the profile's.
std::vector<Stretch> stretches_of(const RunRecord& record, const RunCloud& cloud,
                                  std::size_t from_profile) {
  constexpr double kEnd_s = std::numeric_limits<double>::infinity();
  const double profile_end_s = record.profile_end_s.value_or(kEnd_s);
  std::vector<Stretch> stretches = {{0, from_profile, poses_in(record, {0.0, profile_end_s})}};
  if (stretches[0].poses_world_m.empty()) {
    for (const ViewRecord& view : record.views) {
      stretches[0].poses_world_m.push_back(view.decision.view.p_world_m.cast<float>());
    }
  }
  const auto add = [&](std::size_t cloud_end, double end_s) {
    const std::size_t before = stretches.size() - 1;  // views
    const double begin_s =
        before == 0 ? record.profile_end_s.value_or(0.0) : record.views[before - 1].time_s;
    Stretch leg{.begin = stretches.back().end,
                .end = from_profile + cloud_end - cloud.profile_points,
                .poses_world_m = poses_in(record, {begin_s, end_s})};
    const std::size_t view = std::min(before, record.views.size() - 1);  // where it leads, or led
    if (!record.views.empty()) {
      leg.poses_world_m.push_back(record.views[view].decision.view.p_world_m.cast<float>());
    }
    stretches.push_back(std::move(leg));
  };
  for (std::size_t i = 0; i < record.views.size(); ++i) {
    add(cloud.view_points[i], record.views[i].time_s);
  }
  add(cloud.points_world_m.size(), kEnd_s);
  return stretches;
}

}  // namespace

SeenPoints seen_points(const RunRecord& record, const RunCloud& cloud, int threads) {
  const std::filesystem::path file = record.folder / kCloudFile;
  if (cloud.points_world_m.empty()) {
    throw BadInput("{}: holds no point; {}", file.string(), command_to_fly_again(record.folder));
  }
  const auto leaf_m = static_cast<float>(record.scenario.planner.cloud.profile_leaf_m);
  SeenPoints seen{.points_world_m = uncovered_profile(cloud, leaf_m, threads),
                  .sensors_world_m = {}};
  const std::vector<Stretch> stretches = stretches_of(record, cloud, seen.points_world_m.size());
  seen.points_world_m.insert(
      seen.points_world_m.end(),
      cloud.points_world_m.begin() + static_cast<std::ptrdiff_t>(cloud.profile_points),
      cloud.points_world_m.end());
  seen.sensors_world_m.resize(seen.points_world_m.size());
  std::vector<CameraModel> cameras;
  for (const CameraConfig& camera : sights_of(record.scenario)) {
    cameras.push_back(make_camera_model(camera));
  }
  const PointTree tree(seen.points_world_m);
  for (std::size_t part = 0; part < stretches.size(); ++part) {
    const Stretch& stretch = stretches[part];
    if (stretch.begin == stretch.end) continue;
    const bool is_of_view = part > 0 && part <= record.views.size();
    if (is_of_view && !cameras_run_in_flight(record)) {
      const ViewPose& view = record.views[part - 1].decision.view;
      const std::vector<CameraModel> looking = turned(cameras, view.gimbal_pitch_rad);
      for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
        seen.sensors_world_m[i] = sensor_of(seen.points_world_m[i], view, looking);
      }
      continue;
    }
    if (stretch.poses_world_m.empty()) {
      throw BadInput(
          "{}: nobody knows where its points were seen from: neither trajectory.tum nor "
          "iterations.csv holds a pose; {}",
          file.string(), command_to_fly_again(record.folder));
    }
    find_sensors(tree, stretch, leaf_m, threads, seen);
  }
  return seen;
}

}  // namespace gnbv
