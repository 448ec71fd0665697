#include "tools/mission/sensing.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv {
namespace {

/// Ticks from the first beam of a sweep to the tick of its last one, or just after it.
std::size_t ticks_of(const LidarConfig& lidar) {
  return static_cast<std::size_t>(std::ceil(sweep_duration_s(lidar) / kTick_s));
}

/// The poses of every tick, resampled so that the last one falls on the end of the sweep.
std::vector<Isometry> spread_over(std::span<const Isometry> at_ticks, double duration_s) {
  const std::size_t last = at_ticks.size() - 1;
  std::vector<Isometry> spread = {at_ticks.front()};
  for (std::size_t i = 1; i <= last; ++i) {
    const double tick = static_cast<double>(i) / static_cast<double>(last) * duration_s / kTick_s;
    const std::size_t before = std::min(static_cast<std::size_t>(tick), last - 1);
    spread.push_back(
        interpolated(at_ticks[before], at_ticks[before + 1], tick - static_cast<double>(before)));
  }
  return spread;
}

}  // namespace

bool is_due(double rate_hz, std::int64_t tick) {
  const auto count = [&](std::int64_t t) {
    return std::floor(static_cast<double>(t) * rate_hz / static_cast<double>(kTicksPerSecond));
  };
  return count(tick) != count(tick - 1);
}

DepthFrame sense_depth(const RayScene& scene, const CameraModel& camera, int camera_index,
                       const Flight& flight, std::uint64_t seed, int threads) {
  DepthFrame frame = capture_depth(scene, camera, camera_index, flight.state().T_world_body,
                                   {seed, static_cast<std::uint64_t>(flight.tick())}, threads);
  frame.T_world_camera = flight.estimate().T_world_body * camera.T_body_camera;
  return frame;
}

ColourFrame sense_colour(const RayScene& scene, const CameraModel& camera, int camera_index,
                         const Flight& flight, int threads) {
  ColourFrame frame =
      capture_colour(scene, camera, camera_index, flight.state().T_world_body, threads);
  frame.T_world_camera = flight.estimate().T_world_body * camera.T_body_camera;
  return frame;
}

ProfileScanner::ProfileScanner(const RayScene& scene, std::span<const LidarModel> lidars,
                               std::uint64_t seed)
    : scene_(scene), lidars_(lidars), seed_(seed), sweeps_(lidars.size()) {}

void ProfileScanner::tick(const Flight& flight, bool is_on) {
  for (std::size_t i = 0; i < lidars_.size(); ++i) {
    Sweep& sweep = sweeps_[i];
    if (sweep.T_world_body.empty() && is_on && is_due(lidars_[i].config.rate_hz, flight.tick())) {
      sweep.begin_tick = flight.tick();
      sweep.T_world_body_believed = flight.estimate().T_world_body;
    } else if (sweep.T_world_body.empty()) {
      continue;
    }
    sweep.T_world_body.push_back(flight.state().T_world_body);
    if (sweep.T_world_body.size() > ticks_of(lidars_[i].config)) finish(i);
  }
}

void ProfileScanner::finish(std::size_t i) {
  const LidarModel& lidar = lidars_[i];
  Sweep& sweep = sweeps_[i];
  if (sweep.T_world_body.size() > 1) {
    sweep.T_world_body = spread_over(sweep.T_world_body, sweep_duration_s(lidar.config));
  }
  LidarScan scan = capture_scan(scene_, lidar, static_cast<int>(i), sweep.T_world_body,
                                {seed_, static_cast<std::uint64_t>(sweep.begin_tick)});
  scan.T_world_lidar = sweep.T_world_body_believed * lidar.T_body_lidar;
  scans_.push_back(std::move(scan));
  sweep.T_world_body.clear();
}

}  // namespace gnbv
