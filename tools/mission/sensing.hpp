// What the vehicle's sensors deliver: captured from the true pose, stamped with the believed one.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sensors/capture.hpp"
#include "sim/flight/flight.hpp"

namespace gnbv {

/// Whether something that happens `rate_hz` times a second happens at this tick; never at rate 0.
bool is_due(double rate_hz, std::int64_t tick);

/// Whether the camera's frame of this tick is lost on its way.
bool is_dropped(const CameraConfig& camera, std::size_t camera_index, std::int64_t tick,
                std::uint64_t seed);

/// One depth frame of the camera, now.
DepthFrame sense_depth(const RayScene& scene, const CameraModel& camera, int camera_index,
                       const Flight& flight, std::uint64_t seed, int threads);

/// And what it sees in colour.
ColourFrame sense_colour(const RayScene& scene, const CameraModel& camera, int camera_index,
                         const Flight& flight, int threads);

/// One sweep of the LIDAR that is a view: at one instant, as a camera's frame.
LidarScan sense_sweep(const RayScene& scene, const LidarModel& lidar, int lidar_index,
                      const Flight& flight, std::uint64_t seed);

/// Collects the sweeps of all LIDARs while the vehicle flies.
class ProfileScanner {
 public:
  /// `rate_hz`: of every LIDAR that does not look in flight; nothing: each its own.
  ProfileScanner(const RayScene& scene, std::span<const LidarModel> lidars, std::uint64_t seed,
                 std::optional<double> rate_hz = std::nullopt);

  /// In the state of another one, of the same LIDARs, which lie elsewhere now.
  ProfileScanner(const ProfileScanner& other, std::span<const LidarModel> lidars,
                 std::uint64_t seed)
      : ProfileScanner(other) {
    lidars_ = lidars;
    seed_ = seed;
  }

  /// After every tick. Sweeps that are due begin only while `is_on`; those begun are finished.
  void tick(const Flight& flight, bool is_on);

  /// Finished sweeps in the order in which they ended.
  const std::vector<LidarScan>& scans() const { return scans_; }
  /// Those since the last call, which it forgets.
  std::vector<LidarScan> take_scans() { return std::exchange(scans_, {}); }

 private:
  /// A sweep that has begun: the believed pose of its first beam, and the true ones since.
  struct Sweep {
    std::size_t lidar = 0;
    std::int64_t begin_tick = 0;
    Isometry T_world_body_believed = Isometry::Identity();
    std::vector<Isometry> T_world_body;  // at each tick
  };
  void finish(const Sweep& sweep);

  const RayScene& scene_;
  std::span<const LidarModel> lidars_;
  std::uint64_t seed_;
  std::optional<double> rate_hz_;
  std::vector<Sweep>
      sweeps_;  // under way, oldest first; a LIDAR may begin one before its last ends
  std::vector<LidarScan> scans_;
};

}  // namespace gnbv
