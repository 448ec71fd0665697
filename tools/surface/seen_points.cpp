// seen_points() of oriented_cloud.hpp.
#include <algorithm>
#include <array>

#include "sensors/camera_model.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"
#include "tools/surface/oriented_cloud.hpp"
#include "tools/surface/point_tree.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kChunk = 4096;

bool shows(const CameraModel& camera, const Vec3& p_camera_m) {
  if (p_camera_m.z() <= 0.0) return false;
  const double u_px = camera.fx_px * p_camera_m.x() / p_camera_m.z() + camera.cx_px;
  const double v_px = camera.fy_px * p_camera_m.y() / p_camera_m.z() + camera.cy_px;
  return u_px >= 0.0 && u_px <= camera.config.width_px && v_px >= 0.0 &&
         v_px <= camera.config.height_px;
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

/// Where the profile was flown, a pose each metre.
std::vector<Vec3f> profile_poses(const RunRecord& record) {
  std::vector<Vec3f> poses_world_m;
  for (const TrajectorySample& sample : record.path) {
    if (record.profile_end_s && sample.time_s > *record.profile_end_s) break;
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
  std::array<Neighbour, 1> nearest{};
  for (float s_m = 3.0F * leaf_m; s_m < end_m; s_m += 1.5F * leaf_m) {
    const auto found = cloud.nearest(p_m + s_m * way_m.normalized(), nearest);
    if (!found.empty() && found[0].distance_m < leaf_m) return true;
  }
  return false;
}

struct ProfileSensors {
  std::span<const Vec3f> cloud_world_m;
  std::span<const Vec3f> poses_world_m;
  float leaf_m;
};

/// Of each of the first `count` points of the cloud.
std::vector<Vec3f> sensors_of_profile(const ProfileSensors& in, std::size_t count, int threads) {
  const PointTree cloud(in.cloud_world_m);
  const PointTree poses(in.poses_world_m);
  std::vector<Vec3f> sensors_world_m(count);
  parallel_for(threads, (count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    std::array<Neighbour, 32> near_poses{};
    for (std::size_t i = chunk * kChunk; i < std::min(count, (chunk + 1) * kChunk); ++i) {
      const Vec3f& p_m = in.cloud_world_m[i];
      const auto found = poses.nearest(p_m, near_poses);
      const auto seeing = std::find_if(found.begin(), found.end(), [&](const Neighbour& pose) {
        return !is_hidden(p_m, in.poses_world_m[pose.point], cloud, in.leaf_m);
      });
      const Neighbour& chosen = seeing == found.end() ? found.front() : *seeing;
      sensors_world_m[i] = in.poses_world_m[chosen.point];
    }
  });
  return sensors_world_m;
}

/// The profile's points that are not within a leaf of a view's point.
std::vector<Vec3f> uncovered_profile(const RunCloud& cloud, float leaf_m, int threads) {
  const std::span<const Vec3f> all = cloud.points_world_m;
  const PointTree tree(all.subspan(cloud.profile_points));
  std::vector<std::uint8_t> is_covered(cloud.profile_points);
  parallel_for(threads, (is_covered.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    std::array<Neighbour, 1> nearest{};
    for (std::size_t i = chunk * kChunk; i < std::min(is_covered.size(), (chunk + 1) * kChunk);
         ++i) {
      const auto found = tree.nearest(all[i], nearest);
      is_covered[i] = !found.empty() && found[0].distance_m < leaf_m ? 1 : 0;
    }
  });
  std::vector<Vec3f> kept;
  for (std::size_t i = 0; i < is_covered.size(); ++i) {
    if (is_covered[i] == 0) kept.push_back(all[i]);
  }
  return kept;
}

}  // namespace

SeenPoints seen_points(const RunRecord& record, const RunCloud& cloud, int threads) {
  const std::filesystem::path file = record.folder / "cloud.ply";
  if (cloud.points_world_m.empty()) {
    throw BadInput(fmt::format("{}: holds no point; {}", file.string(),
                               command_to_fly_again(record.folder, "")));
  }
  const auto leaf_m = static_cast<float>(record.scenario.planner.cloud.profile_leaf_m);
  SeenPoints seen{.points_world_m = uncovered_profile(cloud, leaf_m, threads),
                  .sensors_world_m = {}};
  seen.points_world_m.insert(
      seen.points_world_m.end(),
      cloud.points_world_m.begin() + static_cast<std::ptrdiff_t>(cloud.profile_points),
      cloud.points_world_m.end());
  const std::size_t from_views =
      record.views.empty() ? 0 : cloud.points_world_m.size() - cloud.profile_points;
  const std::size_t from_path = seen.points_world_m.size() - from_views;
  std::vector<Vec3f> poses_world_m = profile_poses(record);
  if (poses_world_m.empty()) {
    for (const ViewRecord& view : record.views) {
      poses_world_m.push_back(view.decision.view.p_world_m.cast<float>());
    }
  }
  if (from_path > 0 && poses_world_m.empty()) {
    throw BadInput(
        fmt::format("{}: nobody knows where its points were seen from: neither trajectory.tum nor "
                    "iterations.csv holds a pose; {}",
                    file.string(), command_to_fly_again(record.folder, "")));
  }
  if (from_path > 0) {
    seen.sensors_world_m =
        sensors_of_profile({seen.points_world_m, poses_world_m, leaf_m}, from_path, threads);
  }
  std::vector<CameraModel> cameras;
  for (const CameraConfig& camera : record.scenario.cameras) {
    cameras.push_back(make_camera_model(camera));
  }
  for (std::size_t i = cloud.points_world_m.size() - from_views; i < cloud.points_world_m.size();
       ++i) {
    // what came after the last view, while it flew on, was seen from near there
    const std::size_t view =
        std::min(static_cast<std::size_t>(cloud.view_of(i)), record.views.size() - 1);
    seen.sensors_world_m.push_back(
        sensor_of(cloud.points_world_m[i], record.views[view].decision.view, cameras));
  }
  return seen;
}

}  // namespace gnbv
