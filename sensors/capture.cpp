#include "sensors/capture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sensors/pixel_tiles.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Rays begin at the sensor itself: a surface that is too near to be measured still hides what lies
/// behind it.
constexpr float kTraceFrom_m = 0.0F;

/// What the sensor reports of a surface at `true_m` for which it reads `read_m`.
float measured_range(float true_m, float read_m, double range_min_m, double range_max_m) {
  if (std::min(true_m, read_m) < static_cast<float>(range_min_m)) return kInvalidRange;
  return read_m > static_cast<float>(range_max_m) ? kNoReturn : read_m;
}

/// Angle between a ray and the normal of the face that it meets, from either side.
double incidence_rad(const RayScene& scene, std::int32_t face, const Vec3f& direction_world) {
  const float cosine = std::abs(scene.normal_world(face).dot(direction_world.normalized()));
  return std::acos(std::min(static_cast<double>(cosine), 1.0));
}

/// One depth frame in the making.
struct DepthCapture {
  const RayScene& scene;
  const CameraModel& camera;
  NoiseKey key;
  DepthFrame& frame;
  Vec3f origin_world_m;
  float far_m;
  PixelTiles tiles;

  void trace(RunRays& rays) const {
    scene.first_hits(origin_world_m, rays.directions_world, kTraceFrom_m, far_m, rays.hits);
  }

  void exact_run(const TileRun& run, RunRays& rays) const {
    tiles.directions_world(run, rays.directions_world);
    scene.first_distances(origin_world_m, rays.directions_world, kTraceFrom_m, far_m,
                          rays.distances_m);
    const auto range_min_m = static_cast<float>(camera.config.range_min_m);
    for (std::size_t tile = 0; tile < rays.distances_m.size(); ++tile) {
      // the rays end at range_max_m, so only depths that are too small are left to reject
      Eigen::Map<Eigen::Array<float, RayPacket::kRays, 1>> depths_m(rays.distances_m[tile].data());
      depths_m = (depths_m < range_min_m).select(kInvalidRange, depths_m);
      tiles.put(run, tile, rays.distances_m[tile], frame.depth_m);
    }
  }

  void noisy_run(const TileRun& run, RunRays& rays) const {
    tiles.directions_world(run, rays.directions_world);
    trace(rays);
    if (asks_incidence(camera.config.noise)) {
      displace(run, rays);
      trace(rays);
    }
    tiles.for_each_pixel(run, [&](std::size_t tile, std::size_t ray, std::size_t pixel) {
      const HitPacket& hits = rays.hits[tile];
      frame.depth_m[pixel] = read(hits.distance_m[ray], hits.face[ray],
                                  rays.directions_world[tile].direction(ray), pixel);
    });
  }

  /// Turns each ray to where its pixel really looks: the more slanted the surface that it met, the
  /// farther.
  void displace(const TileRun& run, RunRays& rays) const {
    tiles.for_each_pixel(run, [&](std::size_t tile, std::size_t ray, std::size_t pixel) {
      RayPacket& packet = rays.directions_world[tile];
      const std::int32_t face = rays.hits[tile].face[ray];
      const double theta_rad =
          face == kNoFace ? 0.0 : incidence_rad(scene, face, packet.direction(ray));
      const double sigma_px = lateral_sigma_px(camera.config.noise, theta_rad);
      const Vec3f shift_world =
          tiles.shift_world(sigma_px * lateral_deviate(key, frame.camera, pixel, 0),
                            sigma_px * lateral_deviate(key, frame.camera, pixel, 1));
      packet.x[ray] += shift_world.x();
      packet.y[ray] += shift_world.y();
      packet.z[ray] += shift_world.z();
    });
  }

  float read(float true_m, std::int32_t face, const Vec3f& direction_world,
             std::size_t pixel) const {
    if (face == kNoFace) return kNoReturn;
    const double theta_rad =
        asks_incidence(camera.config.noise) ? incidence_rad(scene, face, direction_world) : 0.0;
    if (!has_return(camera.config.noise, theta_rad)) return kInvalidRange;
    const double sigma_m = depth_sigma_m(camera, true_m, theta_rad);
    const double read_m = true_m + sigma_m * depth_deviate(key, frame.camera, pixel);
    return measured_range(true_m, static_cast<float>(read_m), camera.config.range_min_m,
                          camera.config.range_max_m);
  }
};

/// The pose `intervals` after the first one. Position and rotation each change at an even pace.
Isometry pose_during(std::span<const Isometry> poses, double intervals) {
  const std::size_t before = std::min(static_cast<std::size_t>(intervals), poses.size() - 2);
  const double t = intervals - static_cast<double>(before);
  const Isometry& from = poses[before];
  const Isometry& to = poses[before + 1];
  Isometry pose = Isometry::Identity();
  pose.translate((1.0 - t) * from.translation() + t * to.translation());
  pose.rotate(Eigen::Quaterniond(from.linear()).slerp(t, Eigen::Quaterniond(to.linear())));
  return pose;
}

bool is_still(std::span<const Isometry> poses) {
  return std::all_of(poses.begin(), poses.end(),
                     [&](const Isometry& pose) { return pose.matrix() == poses.front().matrix(); });
}

/// Traces each beam from the pose at its own time.
std::vector<RayHit> trace_sweep(const RayScene& scene, const LidarModel& lidar,
                                std::span<const Isometry> T_world_body_during, double interval_s,
                                float far_m) {
  const bool still = is_still(T_world_body_during);
  const std::size_t beams = lidar.beams_lidar.size();
  const double last = std::max(1.0, static_cast<double>(beams) - 1.0);
  const double intervals = still ? 0.0 : sweep_duration_s(lidar.config) / interval_s;
  constexpr double kRounding = 1e-9;
  GNBV_CHECK(intervals <= static_cast<double>(T_world_body_during.size() - 1) + kRounding,
             "{} poses {} s apart do not last for the sweep of {}", T_world_body_during.size(),
             interval_s, lidar.config.name);
  std::vector<Vec3f> origins_world_m(beams);
  std::vector<Vec3f> directions_world(beams);
  Isometry T_world_lidar = T_world_body_during.front() * lidar.T_body_lidar;
  for (std::size_t i = 0; i < beams; ++i) {
    if (!still) {
      const double at = intervals * static_cast<double>(i) / last;
      T_world_lidar = pose_during(T_world_body_during, at) * lidar.T_body_lidar;
    }
    origins_world_m[i] = T_world_lidar.translation().cast<float>();
    directions_world[i] = T_world_lidar.linear().cast<float>() * lidar.beams_lidar[i];
  }
  std::vector<RayHit> hits(beams);
  scene.first_hits(origins_world_m, directions_world, kTraceFrom_m, far_m, hits);
  return hits;
}

}  // namespace

DepthFrame capture_depth(const RayScene& scene, const CameraModel& camera, int camera_index,
                         const Isometry& T_world_body, const NoiseKey& key, int threads) {
  const CameraConfig& config = camera.config;
  GNBV_CHECK(config.width_px > 0 && config.height_px > 0, "camera {} has {} x {} pixels",
             config.name, config.width_px, config.height_px);
  DepthFrame frame;
  frame.camera = camera_index;
  frame.T_world_camera = T_world_body * camera.T_body_camera;
  frame.depth_m.resize(static_cast<std::size_t>(config.width_px) *
                       static_cast<std::size_t>(config.height_px));
  const DepthCapture capture = {scene,
                                camera,
                                key,
                                frame,
                                frame.T_world_camera.translation().cast<float>(),
                                static_cast<float>(farthest_m(camera)),
                                PixelTiles(camera, frame.T_world_camera)};
  const bool is_exact = config.noise.model == DepthNoise::none;
  for_each_tile_run(capture.tiles, threads, [&](const TileRun& run, RunRays& rays) {
    is_exact ? capture.exact_run(run, rays) : capture.noisy_run(run, rays);
  });
  return frame;
}

LidarScan capture_scan(const RayScene& scene, const LidarModel& lidar, int lidar_index,
                       std::span<const Isometry> T_world_body_during, double interval_s,
                       const NoiseKey& key) {
  GNBV_CHECK(!T_world_body_during.empty(), "a sweep of {} without a pose", lidar.config.name);
  const LidarConfig& config = lidar.config;
  const auto far_m = static_cast<float>(farthest_m(config));
  LidarScan scan;
  scan.lidar = lidar_index;
  scan.T_world_lidar = T_world_body_during.front() * lidar.T_body_lidar;
  const std::vector<RayHit> hits =
      trace_sweep(scene, lidar, T_world_body_during, interval_s, far_m);
  scan.range_m.reserve(hits.size());
  for (std::size_t beam = 0; beam < hits.size(); ++beam) {
    const float true_m = hits[beam].distance_m;
    float read_m = true_m;
    if (hits[beam].face != kNoFace && config.range_sigma_m > 0.0) {
      read_m =
          static_cast<float>(true_m + config.range_sigma_m * range_deviate(key, lidar_index, beam));
    }
    scan.range_m.push_back(measured_range(true_m, read_m, config.range_min_m, config.range_max_m));
  }
  return scan;
}

}  // namespace gnbv
