#include "sensors/capture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sensors/pixel_tiles.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

/// Rays begin at the sensor itself: a surface that is too near to be measured still hides what lies
/// behind it.
constexpr float kTraceFrom_m = 0.0F;

/// Surfaces more than so many standard deviations beyond the maximum range are not traced: one
/// reading in three million of theirs would lie within it. (The laws of noise hold near the working
/// range; much farther out they would give errors as large as the depth.)
constexpr double kFarthest_sigmas = 5.0;

/// One standard normal number for every pixel or beam of every sensor at every tick.
double deviate(const NoiseKey& key, Stream stream, int sensor, std::uint64_t item) {
  const auto of_sensor = static_cast<std::uint64_t>(sensor) << 32;
  return standard_normal({key.seed, stream, key.tick, of_sensor | item});
}

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

  void exact_run(TileRun& run) const {
    scene.first_distances(origin_world_m, run.directions_world, kTraceFrom_m, far_m,
                          run.distances_m);
    const auto range_min_m = static_cast<float>(camera.config.range_min_m);
    for (std::size_t tile = 0; tile < run.distances_m.size(); ++tile) {
      // the rays end where returns do, so only depths that are too small are left to reject
      Eigen::Map<Eigen::Array<float, RayPacket::kRays, 1>> depths_m(run.distances_m[tile].data());
      depths_m = (depths_m < range_min_m).select(kInvalidRange, depths_m);
      tiles.put_distances(run, tile, frame.depth_m);
    }
  }

  void noisy_run(TileRun& run) const {
    trace(run);
    if (asks_incidence(camera.config.noise)) {
      displace(run);
      trace(run);
    }
    tiles.for_each_pixel(run, [&](std::size_t tile, std::size_t ray, std::size_t pixel) {
      const HitPacket& hits = run.hits[tile];
      frame.depth_m[pixel] = read(hits.distance_m[ray], hits.face[ray],
                                  run.directions_world[tile].direction(ray), pixel);
    });
  }

  void trace(TileRun& run) const {
    scene.first_hits(origin_world_m, run.directions_world, kTraceFrom_m, far_m, run.hits);
  }

  /// Turns each ray to where its pixel really looks: the more slanted the surface that it met, the
  /// farther.
  void displace(TileRun& run) const {
    tiles.for_each_pixel(run, [&](std::size_t tile, std::size_t ray, std::size_t pixel) {
      RayPacket& packet = run.directions_world[tile];
      const std::int32_t face = run.hits[tile].face[ray];
      const double theta_rad =
          face == kNoFace ? 0.0 : incidence_rad(scene, face, packet.direction(ray));
      const double sigma_px = lateral_sigma_px(camera.config.noise, theta_rad);
      const auto lateral = [&](int axis) {
        return sigma_px * deviate(key, Stream::lateral_noise, 2 * frame.camera + axis, pixel);
      };
      const Vec3f shift_world = tiles.shift_world(lateral(0), lateral(1), pixel);
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
    const double read_m = true_m + sigma_m * deviate(key, Stream::depth_noise, frame.camera, pixel);
    return measured_range(true_m, static_cast<float>(read_m), camera.config.range_min_m,
                          return_end_m(camera.config));
  }
};

/// Ranges along a radial lens's rays become depths along the axis; pixels without a ray say
/// nothing.
void put_lens_depths(const Lens& lens, std::vector<float>& depth_m) {
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    const Eigen::Vector2f& xy = lens.directions()[i];
    if (std::isnan(xy.x())) {
      depth_m[i] = kInvalidRange;
    } else if (lens.is_radial()) {
      depth_m[i] /= xy.homogeneous().norm();
    }
  }
}

/// The pose `intervals` after the first one: position and rotation change evenly in between.
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
std::vector<RayHit> trace_sweep(const RayScene& scene, const LidarModel& lidar, double begin_s,
                                std::span<const Isometry> T_world_body_during, double interval_s,
                                float far_m) {
  const bool still = is_still(T_world_body_during);
  std::vector<Vec3f> memory;
  const std::span<const Vec3f> beams_lidar = lidar.beams_at(begin_s, memory);
  const std::size_t beams = beams_lidar.size();
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
    directions_world[i] = T_world_lidar.linear().cast<float>() * beams_lidar[i];
  }
  std::vector<RayHit> hits(beams);
  scene.first_hits(origins_world_m, directions_world, kTraceFrom_m, far_m, hits);
  return hits;
}

}  // namespace

DepthFrame capture_depth(const RayScene& scene, const CameraModel& camera, int camera_index,
                         const Isometry& T_world_body, const NoiseKey& key, int threads) {
  DepthFrame frame;
  frame.camera = camera_index;
  frame.T_world_camera = T_world_body * camera.T_body_camera;
  const double end_m = return_end_m(camera.config);
  const double far_m = end_m + kFarthest_sigmas * depth_sigma_m(camera, end_m, 0.0);
  const DepthCapture capture = {scene,
                                camera,
                                key,
                                frame,
                                frame.T_world_camera.translation().cast<float>(),
                                static_cast<float>(far_m),
                                PixelTiles(camera, frame.T_world_camera)};
  frame.depth_m.resize(capture.tiles.pixel_count());
  const bool is_exact = camera.config.noise.model == DepthNoise::none;
  capture.tiles.for_each_run(
      threads, [&](TileRun& run) { is_exact ? capture.exact_run(run) : capture.noisy_run(run); });
  if (camera.lens) put_lens_depths(*camera.lens, frame.depth_m);
  return frame;
}

LidarScan capture_scan(const RayScene& scene, const LidarModel& lidar, int lidar_index,
                       std::span<const Isometry> T_world_body_during, double interval_s,
                       const NoiseKey& key, double begin_s) {
  GNBV_CHECK(!T_world_body_during.empty(), "a sweep of {} without a pose", lidar.config.name);
  const LidarConfig& config = lidar.config;
  const auto far_m =
      static_cast<float>(config.range_max_m + kFarthest_sigmas * config.range_sigma_m);
  LidarScan scan;
  scan.lidar = lidar_index;
  scan.T_world_lidar = T_world_body_during.front() * lidar.T_body_lidar;
  scan.begin_s = begin_s;
  const std::vector<RayHit> hits =
      trace_sweep(scene, lidar, begin_s, T_world_body_during, interval_s, far_m);
  scan.range_m.reserve(hits.size());
  for (std::size_t beam = 0; beam < hits.size(); ++beam) {
    const float true_m = hits[beam].distance_m;
    float read_m = true_m;
    if (hits[beam].face != kNoFace && config.range_sigma_m > 0.0) {
      const double error_m =
          config.range_sigma_m * deviate(key, Stream::range_noise, lidar_index, beam);
      read_m = static_cast<float>(true_m + error_m);
    }
    scan.range_m.push_back(measured_range(true_m, read_m, config.range_min_m, config.range_max_m));
  }
  return scan;
}

}  // namespace gnbv
