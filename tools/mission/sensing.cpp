#include "tools/mission/sensing.hpp"

#include <array>
#include <cmath>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

/// Ticks from the first beam of a sweep to the tick of its last one, or just after it.
std::size_t ticks_of(const LidarConfig& lidar) {
  return static_cast<std::size_t>(std::ceil(sweep_duration_s(lidar) / kTick_s));
}

double time_of(std::int64_t tick) { return static_cast<double>(tick) * kTick_s; }

}  // namespace

bool is_due(double rate_hz, std::int64_t tick) {
  const auto count = [&](std::int64_t t) {
    return std::floor(static_cast<double>(t) * rate_hz / static_cast<double>(kTicksPerSecond));
  };
  return count(tick) != count(tick - 1);
}

bool is_dropped(const CameraConfig& camera, std::size_t camera_index, std::int64_t tick,
                std::uint64_t seed) {
  return uniform01({seed, Stream::dropped_frame, static_cast<std::uint64_t>(tick),
                    static_cast<std::uint64_t>(camera_index)}) < camera.drop_probability;
}

DepthFrame sense_depth(const RayScene& scene, const CameraModel& camera, int camera_index,
                       const Flight& flight, std::uint64_t seed, int threads) {
  DepthFrame frame = capture_depth(scene.at(time_of(flight.tick())), camera, camera_index,
                                   flight.state().T_world_body,
                                   {seed, static_cast<std::uint64_t>(flight.tick())}, threads);
  frame.T_world_camera = flight.estimate().T_world_body * camera.T_body_camera;
  return frame;
}

ColourFrame sense_colour(const RayScene& scene, const CameraModel& camera, int camera_index,
                         const Flight& flight, int threads) {
  ColourFrame frame = capture_colour(scene.at(time_of(flight.tick())), camera, camera_index,
                                     flight.state().T_world_body, threads);
  frame.T_world_camera = flight.estimate().T_world_body * camera.T_body_camera;
  return frame;
}

LidarScan sense_sweep(const RayScene& scene, const LidarModel& lidar, int lidar_index,
                      const Flight& flight, std::uint64_t seed) {
  const std::array<Isometry, 1> T_world_body = {flight.state().T_world_body};
  LidarScan scan =
      capture_scan(scene.at(time_of(flight.tick())), lidar, lidar_index, T_world_body, kTick_s,
                   {seed, static_cast<std::uint64_t>(flight.tick())}, time_of(flight.tick()));
  scan.T_world_lidar = flight.estimate().T_world_body * lidar.T_body_lidar;
  return scan;
}

ProfileScanner::ProfileScanner(const RayScene& scene, std::span<const LidarModel> lidars,
                               std::uint64_t seed, std::optional<double> rate_hz)
    : scene_(scene), lidars_(lidars), seed_(seed), rate_hz_(rate_hz) {}

void ProfileScanner::tick(const Flight& flight, bool is_on) {
  for (std::size_t i = 0; is_on && i < lidars_.size(); ++i) {
    const LidarConfig& lidar = lidars_[i].config;
    const bool has_own_rate = !rate_hz_ || lidar.looks == LidarLooks::flight;
    if (!is_due(has_own_rate ? lidar.rate_hz : *rate_hz_, flight.tick())) continue;
    sweeps_.push_back({i, flight.tick(), flight.estimate().T_world_body, {}});
  }
  for (Sweep& sweep : sweeps_) sweep.T_world_body.push_back(flight.state().T_world_body);
  std::erase_if(sweeps_, [&](const Sweep& sweep) {
    const bool is_over = sweep.T_world_body.size() > ticks_of(lidars_[sweep.lidar].config);
    if (is_over) finish(sweep);
    return is_over;
  });
}

void ProfileScanner::finish(const Sweep& sweep) {
  const LidarModel& lidar = lidars_[sweep.lidar];
  const double begin_s = time_of(sweep.begin_tick);  // where bodies move, it sees them then
  LidarScan scan =
      capture_scan(scene_.at(begin_s), lidar, static_cast<int>(sweep.lidar), sweep.T_world_body,
                   kTick_s, {seed_, static_cast<std::uint64_t>(sweep.begin_tick)}, begin_s);
  scan.T_world_lidar = sweep.T_world_body_believed * lidar.T_body_lidar;
  scans_.push_back(std::move(scan));
}

}  // namespace gnbv
