// What a sensor costs beside the bare rays it is made of (bench/reference/bare_embree.hpp), around
// the aircraft. Sensor and bare rays take turns in one loop, so that a busy machine slows both; a
// benchmark's time is the sensor's, in CPU seconds of all threads, and `bare_share` is the bare
// rays' time over it: the sensor's rate as a share of Embree's.
#include <benchmark/benchmark.h>

#include <ctime>

#include "assets/catalog.hpp"
#include "bench/reference/bare_embree.hpp"
#include "sensors/capture.hpp"
#include "sensors/pixel_tiles.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr int kViews = 24;

const World& world() {
  static const World aircraft = {make_builtin_structure("aircraft"), true};
  return aircraft;
}

const RayScene& scene() {
  static const RayScene built(world());
  return built;
}

/// On an ellipse around the aircraft, level, a few metres off it and looking at it.
Isometry view(int index) {
  const double angle_rad = 2.0 * kPi * index / kViews;
  return T_world_body(
      {Vec3(17.0 * std::cos(angle_rad), 19.0 * std::sin(angle_rad), 5.0), angle_rad + kPi});
}

double cpu_time_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Work>
double seconds_of(const Work& work) {
  const double began_s = cpu_time_s();
  work();
  return cpu_time_s() - began_s;
}

/// Compares `sensor(view)` with bare rays, prepared by `prepare(view, bare)`.
template <typename Sensor, typename Prepare>
void compare(benchmark::State& state, const Sensor& sensor, const Prepare& prepare, float far_m,
             std::size_t packets_per_task, int threads) {
  BareEmbree bare(world());
  double sensor_s = 0.0;
  double bare_s = 0.0;
  int index = 0;
  for (auto _ : state) {
    const Isometry T_world_body = view(index++ % kViews);
    prepare(T_world_body, bare);
    bare_s +=
        seconds_of([&] { benchmark::DoNotOptimize(bare.trace(far_m, packets_per_task, threads)); });
    const double once_s = seconds_of([&] { sensor(T_world_body); });
    sensor_s += once_s;
    state.SetIterationTime(once_s);
  }
  state.counters["bare_share"] = bare_s / sensor_s;
}

/// Every pixel's point in the world; NaN or infinite where there is none.
std::vector<Vec3f> points_world(const DepthFrame& frame, const CameraModel& camera, int threads) {
  const auto width = static_cast<std::size_t>(camera.config.width_px);
  const Eigen::Matrix3f R = frame.T_world_camera.linear().cast<float>();
  std::vector<Vec3f> points(frame.depth_m.size());
  std::vector<Eigen::Vector4f> across(width);  // four numbers, so that three are computed at once
  for (std::size_t u = 0; u < width; ++u) {
    across[u] << camera.ray_camera(static_cast<int>(u), 0).x() * R.col(0), 0.0F;
  }
  const Eigen::Vector4f origin_m = frame.T_world_camera.translation().homogeneous().cast<float>();
  parallel_for(threads, points.size() / width, [&](std::size_t v) {
    Eigen::Vector4f down;
    down << camera.ray_camera(0, static_cast<int>(v)).y() * R.col(1) + R.col(2), 0.0F;
    const float* const depth_m = &frame.depth_m[v * width];
    Vec3f* const row = &points[v * width];
    // four numbers are stored at once, the last of them where the next point begins
    for (std::size_t u = 0; u + 1 < width; ++u) {
      Eigen::Map<Eigen::Vector4f>(row[u].data()) = origin_m + depth_m[u] * (across[u] + down);
    }
    const std::size_t last = width - 1;
    row[last] = (origin_m + depth_m[last] * (across[last] + down)).head<3>();
  });
  return points;
}

void BM_DepthFrameToPoints(benchmark::State& state, DepthNoise model) {
  const int threads = static_cast<int>(state.range(0));
  CameraConfig config;
  config.noise.model = model;
  const CameraModel camera = make_camera_model(config);
  const std::size_t packets_per_task = 8 * 160;  // as many tasks as a frame has
  const auto sensor = [&](const Isometry& T_world_body) {
    const DepthFrame frame = capture_depth(scene(), camera, 0, T_world_body, {}, threads);
    benchmark::DoNotOptimize(points_world(frame, camera, threads));
  };
  const auto prepare = [&](const Isometry& T_world_body, BareEmbree& bare) {
    const Isometry T_world_camera = T_world_body * camera.T_body_camera;
    const PixelTiles tiles(camera, T_world_camera);
    std::vector<Vec3f> directions_world;
    tiles.for_each_run(1, [&](const TileRun& run) {
      for (const RayPacket& packet : run.directions_world) {
        for (std::size_t ray = 0; ray < RayPacket::kRays; ++ray) {
          directions_world.push_back(packet.direction(ray));
        }
      }
    });
    bare.prepare(T_world_camera.translation().cast<float>(), directions_world);
  };
  compare(state, sensor, prepare, static_cast<float>(config.range_max_m), packets_per_task,
          threads);
}
BENCHMARK_CAPTURE(BM_DepthFrameToPoints, exact, DepthNoise::none)
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_DepthFrameToPoints, stereo, DepthNoise::stereo)
    ->Arg(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_DepthFrameToPoints, nguyen, DepthNoise::nguyen)
    ->Arg(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

void BM_LidarSweep(benchmark::State& state, double range_sigma_m, bool is_moving) {
  LidarConfig config;
  config.range_sigma_m = range_sigma_m;
  config.rolling = is_moving;
  const LidarModel lidar = make_lidar_model(config);
  const auto sensor = [&](const Isometry& T_world_body) {
    std::vector<Isometry> poses = {T_world_body};
    if (is_moving) poses.resize(4, T_world_body);
    for (std::size_t i = 1; i < poses.size(); ++i) {
      poses[i].pretranslate(Vec3(0.004 * static_cast<double>(i), 0.0, 0.0));
    }
    benchmark::DoNotOptimize(capture_scan(scene(), lidar, 0, poses, 0.00625, {}));
  };
  const auto prepare = [&](const Isometry& T_world_body, BareEmbree& bare) {
    const Isometry T_world_lidar = T_world_body * lidar.T_body_lidar;
    std::vector<Vec3f> directions_world;
    for (const Vec3f& beam : lidar.beams_lidar) {
      directions_world.push_back(T_world_lidar.linear().cast<float>() * beam);
    }
    bare.prepare(T_world_lidar.translation().cast<float>(), directions_world);
  };
  compare(state, sensor, prepare, static_cast<float>(config.range_max_m), lidar.beams_lidar.size(),
          1);
}
BENCHMARK_CAPTURE(BM_LidarSweep, exact, 0.0, false)->UseManualTime()->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_LidarSweep, noisy, 0.01, false)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_LidarSweep, noisy_and_moving, 0.01, true)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

void BM_ColourFrame(benchmark::State& state) {
  const CameraModel camera = make_camera_model(CameraConfig{});
  int index = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(capture_colour(scene(), camera, 0, view(index++ % kViews), 1));
  }
}
BENCHMARK(BM_ColourFrame)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gnbv

BENCHMARK_MAIN();
