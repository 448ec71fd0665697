// Map and cloud against their slow twins, on the frames of bench/reference/analytic_scans.hpp.
#include <benchmark/benchmark.h>

#include "bench/reference/analytic_scans.hpp"
#include "bench/reference/depth_rays.hpp"
#include "bench/reference/octomap_twin.hpp"
#include "bench/reference/pcl_twin.hpp"
#include "bench/speed/map_speed.hpp"
#include "bench/speed/measure.hpp"
#include "planner/map/scan_insertion.hpp"
#include "planner/map/surface_cloud.hpp"
#include "sim/core/simd.hpp"

namespace gnbv {
namespace {

struct View {
  Vec3f origin_m;
  std::vector<ScanRay> rays;
};

const std::vector<View>& views() {
  static const std::vector<View> all = [] {
    std::vector<View> made;
    for (const DepthFrame& frame : circle_frames()) {
      made.push_back({frame.T_world_camera.translation().cast<float>(),
                      rays_of(frame, circle_camera(), kFloor_m)});
    }
    return made;
  }();
  return all;
}

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

/// Ray by ray.
void BM_GridInsertFrame(benchmark::State& state) {
  const std::vector<View>& frames = views();
  OccupancyGrid grid(OccupancyConfig{}, kWorkspace_m);
  FanWalker walker(grid.geometry());
  std::size_t frame = 0;
  for (auto _ : state) {
    const View& view = frames[frame++ % frames.size()];
    grid.apply(walker.compute_update(view.origin_m, view.rays));
  }
}
BENCHMARK(BM_GridInsertFrame)->Unit(benchmark::kMillisecond);

void BM_OctomapInsertPointCloud(benchmark::State& state) {
  const bool lazy = state.range(0) != 0;
  const bool discretize = state.range(1) != 0;
  OctomapTwin twin{OccupancyConfig{}};
  std::vector<OctomapScan> scans;
  for (const View& view : views()) {
    std::vector<Vec3f> ends_m;
    for (const ScanRay& ray : view.rays) ends_m.push_back(ray.end_world_m);
    scans.emplace_back(view.origin_m, ends_m);
  }
  std::size_t frame = 0;
  for (auto _ : state) {
    const std::size_t v = frame++ % views().size();
    twin.insert_point_cloud(scans[v], lazy, discretize);
  }
}
BENCHMARK(BM_OctomapInsertPointCloud)
    ->ArgNames({"lazy", "discretize"})
    ->Args({0, 0})
    ->Args({1, 0})
    ->Args({1, 1})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(16);

void BM_OctomapTwinInsertFrame(benchmark::State& state) {
  OctomapTwin twin{OccupancyConfig{}};
  const std::vector<View>& frames = views();
  std::size_t frame = 0;
  for (auto _ : state) {
    const View& view = frames[frame++ % frames.size()];
    twin.insert(view.origin_m, view.rays);
  }
}
BENCHMARK(BM_OctomapTwinInsertFrame)->Unit(benchmark::kMillisecond)->Iterations(16);

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
  const auto frames = static_cast<double>(state.iterations() * views().size());
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
