// Map and cloud against their slow twins, on the frames of bench/reference/analytic_scans.hpp.
#include <benchmark/benchmark.h>

#include "bench/reference/analytic_scans.hpp"
#include "bench/reference/octomap_twin.hpp"
#include "bench/reference/pcl_twin.hpp"
#include "planner/map/scan_insertion.hpp"
#include "planner/map/surface_cloud.hpp"

namespace gnbv {
namespace {

constexpr double kFloor_m = 0.3;
constexpr int kViews = 16;
const Box3 kWorkspace_m(Vec3(-20, -20, 0), Vec3(20, 20, 20));

struct View {
  Vec3f origin_m;
  std::vector<ScanRay> rays;
};

/// 640 x 480 frames on a circle around the scene, looking inwards and down.
const std::vector<View>& views() {
  static const std::vector<View> all = [] {
    CameraConfig config;
    config.pitch_rad = deg_to_rad(20.0);
    const CameraModel camera = make_camera_model(config);
    std::vector<View> made;
    for (int view = 0; view < kViews; ++view) {
      const double angle_rad = view * 2.0 * kPi / kViews;
      const ViewPose pose = {Vec3(9.0 * std::cos(angle_rad), 9.0 * std::sin(angle_rad), 4.5),
                             angle_rad + kPi};
      const DepthFrame frame = analytic_depth(example_scene(), camera, T_world_body(pose));
      made.push_back(
          {frame.T_world_camera.translation().cast<float>(), rays_of(frame, camera, kFloor_m)});
    }
    return made;
  }();
  return all;
}

void BM_RaysOfFrame(benchmark::State& state) {
  const CameraModel camera = make_camera_model(CameraConfig{});
  const DepthFrame frame =
      analytic_depth(example_scene(), camera, T_world_body({Vec3(-9, 0, 4.5), 0.0}));
  for (auto _ : state) benchmark::DoNotOptimize(rays_of(frame, camera, kFloor_m));
}
BENCHMARK(BM_RaysOfFrame)->Unit(benchmark::kMillisecond);

void BM_GridInsertFrame(benchmark::State& state) {
  const int threads = static_cast<int>(state.range(0));
  const std::vector<View>& frames = views();
  OccupancyGrid grid(OccupancyConfig{}, kWorkspace_m);
  ScanInserter inserter(grid.geometry());
  std::size_t frame = 0;
  for (auto _ : state) {
    const View& view = frames[frame++ % kViews];
    grid.apply(inserter.compute_update(view.origin_m, view.rays, threads));
  }
}
BENCHMARK(BM_GridInsertFrame)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void BM_OctomapInsertPointCloud(benchmark::State& state) {
  const bool lazy = state.range(0) != 0;
  OctomapTwin twin{OccupancyConfig{}};
  std::vector<std::vector<Vec3f>> ends_m;
  for (const View& view : views()) {
    ends_m.emplace_back();
    for (const ScanRay& ray : view.rays) ends_m.back().push_back(ray.end_world_m);
  }
  std::size_t frame = 0;
  for (auto _ : state) {
    const std::size_t v = frame++ % kViews;
    twin.insert_point_cloud(views()[v].origin_m, ends_m[v], lazy);
  }
}
BENCHMARK(BM_OctomapInsertPointCloud)
    ->ArgName("lazy")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(kViews);

void BM_OctomapTwinInsertFrame(benchmark::State& state) {
  OctomapTwin twin{OccupancyConfig{}};
  const std::vector<View>& frames = views();
  std::size_t frame = 0;
  for (auto _ : state) {
    const View& view = frames[frame++ % kViews];
    twin.insert(view.origin_m, view.rays);
  }
}
BENCHMARK(BM_OctomapTwinInsertFrame)->Unit(benchmark::kMillisecond)->Iterations(kViews);

std::vector<LidarScan> descent(const LidarConfig& lidar, int count) {
  std::vector<LidarScan> scans;
  for (int s = 0; s < count; ++s) {
    const ViewPose pose = {Vec3(-15.0, -15.0, 19.0 - 16.0 * s / count), kPi / 4.0};
    scans.push_back(analytic_scan(example_scene(), lidar, T_world_body(pose)));
  }
  return scans;
}

/// 14,000 sweeps make a profile: multiply by 70.
void BM_GridInsert200Sweeps(benchmark::State& state) {
  const LidarConfig lidar;
  const LidarModel model = make_lidar_model(lidar);
  const std::vector<LidarScan> scans = descent(lidar, 200);
  OccupancyGrid grid(OccupancyConfig{}, kWorkspace_m);
  ScanInserter inserter(grid.geometry());
  for (auto _ : state) {
    inserter.insert_scans(grid, scans, {&model, 1}, kFloor_m, static_cast<int>(state.range(0)));
  }
}
BENCHMARK(BM_GridInsert200Sweeps)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// The frames in turn into an empty cloud, which holds all of them after the first round.
void BM_CloudAddFrames(benchmark::State& state) {
  const double leaf_m = static_cast<double>(state.range(0)) * 1e-3;
  const OccupancyGrid grid(OccupancyConfig{}, kWorkspace_m);
  std::vector<std::vector<Vec3f>> frames_m;
  for (const View& view : views()) frames_m.push_back(surface_points_world_m(view.rays));
  std::size_t gained = 0;
  for (auto _ : state) {
    state.PauseTiming();
    SurfaceCloud cloud({.leaf_m = leaf_m, .profile_leaf_m = 0.1}, grid.geometry());
    state.ResumeTiming();
    for (const std::vector<Vec3f>& frame_m : frames_m) gained += cloud.add(frame_m, leaf_m);
  }
  const auto frames = static_cast<double>(state.iterations()) * kViews;
  state.counters["new_points_per_frame"] = static_cast<double>(gained) / frames;
  state.counters["ms_per_frame"] =
      benchmark::Counter(frames * 1e-3, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(BM_CloudAddFrames)->ArgName("leaf_mm")->Arg(20)->Arg(50)->Unit(benchmark::kMillisecond);

void BM_PclFilterAndDensityOfAFrame(benchmark::State& state) {
  const std::vector<Vec3f> frame_m = surface_points_world_m(views()[0].rays);
  for (auto _ : state) {
    const std::vector<Vec3f> filtered_m = pcl_leaf_filter(frame_m, 0.02);
    benchmark::DoNotOptimize(pcl_neighbour_counts(filtered_m, 0.2 / std::sqrt(2.0)));
    state.counters["points"] = static_cast<double>(filtered_m.size());
  }
}
BENCHMARK(BM_PclFilterAndDensityOfAFrame)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gnbv

BENCHMARK_MAIN();
