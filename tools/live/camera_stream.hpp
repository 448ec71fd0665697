// What the cameras of a flight see, for other processes: each camera's newest frame as a file that
// NumPy reads, and the first camera's colour as video.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "sensors/capture.hpp"
#include "sim/core/child_process.hpp"

namespace gnbv {

/// A frame as a file in NumPy's format (.npy, version 1.0): one record of the fields
/// - sequence: uint64, counts from 1;
/// - time_s: float64, simulated, as MAVLink's time_boot_ms;
/// - K: float64 (3, 3); the centre of the top left pixel is at (0.5, 0.5);
/// - T_body_camera: float64 (4, 4), from the optical frame to the body (x forward, z up);
/// - depth_m: float32 (height, width), along the optical axis; inf: no return, nan: too near;
/// - rgb: uint8 (height, width, 3), sRGB, aligned with the depth.
std::string npy_of(const CameraModel& camera, std::uint64_t sequence, double time_s,
                   const DepthFrame& depth, const ColourFrame& colour);

struct CameraStreamOptions {
  std::filesystem::path folder = {};  // of the files NAME.npy; empty: none
  std::string video_url = {};         // rtp://HOST:PORT, by ffmpeg; empty: none
  double rate_hz = 10.0;              // simulated
  double speed = 1.0;                 // simulated seconds a second
  std::uint64_t seed = 0;             // of the noise
};

/// Takes and writes frames on a thread of its own: a flight never waits for them. While frames are
/// under way, those that come due are left out. Files appear by rename, and go with this object.
class CameraStream {
 public:
  /// The scene has to outlive it. Throws BadInput for cameras of one name, a folder that cannot be
  /// made and where ffmpeg does not start.
  CameraStream(const RayScene& scene, std::vector<CameraModel> cameras,
               CameraStreamOptions options);
  ~CameraStream();
  CameraStream(const CameraStream&) = delete;
  CameraStream& operator=(const CameraStream&) = delete;

  /// Tells where the vehicle truly is, and when, as often as that is known. Throws what taking a
  /// frame threw. A folder that takes none and an ffmpeg that ends are said once, and done without.
  void offer(const Isometry& T_world_body, double time_s);

 private:
  struct Moment {
    Isometry T_world_body;
    double time_s = 0.0;
  };
  std::filesystem::path file_of(const CameraModel& camera) const;
  void work();
  void take(const Moment& moment);

  const RayScene& scene_;
  const std::vector<CameraModel> cameras_;
  const CameraStreamOptions options_;
  std::unique_ptr<ChildProcess> video_;
  bool keeps_files_;
  std::uint64_t sequence_ = 0;

  std::mutex mutex_;
  std::condition_variable is_offered_;
  std::optional<Moment> next_;  // that the thread is to take, or is taking
  std::exception_ptr failure_;  // of the thread
  bool is_over_ = false;
  double due_s_ = 0.0;  // when the next frames are
  std::thread thread_;
};

}  // namespace gnbv
