// Map and cloud by level, threads and leaf, on the frames of bench/reference/analytic_scans.hpp;
// the speed table has them beside their slow twins.
#include <benchmark/benchmark.h>

#include "bench/reference/analytic_scans.hpp"
#include "bench/speed/speed_rows.hpp"
#include "planner/map/scan_insertion.hpp"
#include "planner/map/surface_cloud.hpp"
#include "sim/core/simd.hpp"

namespace gnbv {
namespace {

/// Sets the level that the benchmark asks for, and says which one it got.
void use_level(benchmark::State& state) {
  set_simd_level(static_cast<SimdLevel>(state.range(0)));
  state.SetLabel(std::string(name_of(simd_level())));
}

void BM_FrameRays(benchmark::State& state) {
  use_level(state);
  FrameRays rays;
  for (auto _ : state) compute_frame_rays(circle_frames()[0], circle_camera(), kFloor_m, rays);
  set_simd_level(SimdLevel::avx512);
}
BENCHMARK(BM_FrameRays)->ArgName("level")->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

/// From the depths to the updated grid.
void BM_GridInsertDepthFrame(benchmark::State& state) {
  use_level(state);
  const int threads = static_cast<int>(state.range(1));
  const std::vector<DepthFrame>& frames = circle_frames();
  OccupancyGrid grid(OccupancyConfig{}, kWorkspace_m);
  ScanInserter inserter(grid.geometry());
  FrameRays rays;
  std::size_t next = 0;
  for (auto _ : state) {
    const DepthFrame& frame = frames[next++ % frames.size()];
    compute_frame_rays(frame, circle_camera(), kFloor_m, rays);
    grid.apply(inserter.compute_update(rays, frame, circle_camera(), grid, threads));
  }
  set_simd_level(SimdLevel::avx512);
}
BENCHMARK(BM_GridInsertDepthFrame)
    ->ArgNames({"level", "threads"})
    ->ArgsProduct({{0, 1, 2}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

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
  for (const DepthFrame& frame : circle_frames()) {
    frames_m.push_back(surface_points_world_m(rays_of(frame, circle_camera(), kFloor_m)));
  }
  std::size_t gained = 0;
  for (auto _ : state) {
    state.PauseTiming();
    SurfaceCloud cloud({.leaf_m = leaf_m, .profile_leaf_m = 0.1}, grid.geometry());
    state.ResumeTiming();
    for (const std::vector<Vec3f>& frame_m : frames_m) gained += cloud.add(frame_m, leaf_m);
  }
  const auto frames = static_cast<double>(state.iterations() * frames_m.size());
  state.counters["new_points_per_frame"] = static_cast<double>(gained) / frames;
  state.counters["ms_per_frame"] =
      benchmark::Counter(frames * 1e-3, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(BM_CloudAddFrames)->ArgName("leaf_mm")->Arg(20)->Arg(50)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gnbv

BENCHMARK_MAIN();
