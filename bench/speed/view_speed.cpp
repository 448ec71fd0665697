#include <algorithm>
#include <cmath>

#include "bench/reference/analytic_scans.hpp"
#include "bench/reference/view_twins.hpp"
#include "bench/speed/speed_rows.hpp"
#include "planner/guided/utility.hpp"
#include "planner/map/scan_insertion.hpp"
#include "planner/view/visibility.hpp"
#include "sim/core/rng.hpp"
#include "sim/core/simd.hpp"

namespace gnbv {
namespace {

constexpr int kFrames = 36;
constexpr int kCandidates = 60;
constexpr int kRounds = 3;

double draw(std::uint64_t frame, std::uint64_t index) {
  return uniform01({7, Stream::bench, frame, index});
}

/// A mission half done: map and cloud of frames on a circle that leaves a third of it unseen.
struct BenchBelief {
  OccupancyGrid grid{OccupancyConfig{}, kWorkspace_m};
  SurfaceCloud cloud{CloudConfig{}, grid.geometry()};
  ShadowBand shadow{ShadowConfig{}, grid.geometry()};
};

void integrate(const DepthFrame& frame, const CameraModel& camera, FanWalker& walker,
               BenchBelief& belief) {
  const std::vector<ScanRay> rays = rays_of(frame, camera, kFloor_m);
  const Vec3f origin_m = frame.T_world_camera.translation().cast<float>();
  belief.grid.apply(walker.compute_update(origin_m, rays));
  belief.cloud.add(surface_points_world_m(rays), CloudConfig{}.leaf_m);
  FrameRays columns;
  compute_frame_rays(frame, camera, kFloor_m, columns);
  belief.shadow.add(columns, belief.grid);
}

BenchBelief make_belief(std::span<const CameraModel> cameras) {
  BenchBelief belief;
  FanWalker walker(belief.grid.geometry());
  for (int i = 0; i < kFrames; ++i) {
    const double angle_rad = i * (4.0 / 3.0) * kPi / kFrames;
    const double radius_m = 8.0 + 2.0 * draw(0, static_cast<std::uint64_t>(i));
    const ViewPose pose = {
        Vec3(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), 3.0 + i % 3),
        angle_rad + kPi};
    for (const CameraModel& camera : cameras) {
      integrate(analytic_depth(example_scene(), camera, T_world_body(pose)), camera, walker,
                belief);
    }
  }
  return belief;
}

/// Poses around the scene, most of them looking inwards.
std::vector<ViewPose> make_candidates() {
  std::vector<ViewPose> poses;
  for (std::uint64_t i = 0; i < kCandidates; ++i) {
    const double angle_rad = 2.0 * kPi * draw(1, i);
    const double radius_m = 7.0 + 5.0 * draw(2, i);
    const double turn_rad = (draw(3, i) - 0.5) * kPi;
    poses.push_back({Vec3(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad),
                          1.0 + 6.0 * draw(4, i)),
                     angle_rad + kPi + turn_rad});
  }
  return poses;
}

/// Median time of `work(candidate)` over the candidates, in the best of the rounds.
template <typename Work>
double median_us(const std::vector<ViewPose>& candidates, int rounds, Work&& work) {
  double best_us = 1e30;
  for (int round = 0; round < rounds; ++round) {
    std::vector<double> times_us;
    for (const ViewPose& candidate : candidates) {
      const double before_ms = thread_time_ms();
      work(candidate);
      times_us.push_back(1e3 * (thread_time_ms() - before_ms));
    }
    best_us = std::min(best_us, median(times_us));
  }
  return best_us;
}

class ViewBench {
 public:
  std::vector<SpeedRow> rows() {
    const PaperViewTwin twin(belief_.grid);
    std::int64_t seen = 0;
    const double twin_us = median_us(candidates_, kRounds, [&](const ViewPose& candidate) {
      seen += twin.evaluate(rays_, candidate).free;
    });
    KeysetViewTwin keysets(belief_.grid);
    const double keysets_us = median_us(candidates_, kRounds, [&](const ViewPose& candidate) {
      seen += keysets.evaluate(rays_, candidate).free;
    });
    const auto candidate_row = [&](const char* name, double target) {
      const double ours_us = median_us(candidates_, kRounds, [&](const ViewPose& candidate) {
        checksum_ += evaluate(candidate, {}).entropy_nat;
      });
      return SpeedRow{.name = name,
                      .ours = ours_us,
                      .reference = twin_us,
                      .competent = keysets_us,
                      .unit = "us/candidate",
                      .identical = is_exact(keysets),
                      .target = target};
    };
    const SimdLevel best = simd_level();
    std::vector<SpeedRow> rows = {candidate_row("candidate", seen > 0 ? 200.0 : 0.0)};
    rows.push_back(all_over_one_row(keysets));
    for (const auto& [name, level, target] :
         {std::tuple{"candidate_avx2", SimdLevel::avx2, 40.0},
          std::tuple{"candidate_baseline", SimdLevel::baseline, 0.0}}) {
      if (level > best) continue;
      set_simd_level(level);
      rows.push_back(candidate_row(name, target));
    }
    set_simd_level(best);
    return rows;
  }

 private:
  ViewStats evaluate(const ViewPose& candidate, const ViewOptions& options) {
    return evaluate_view(belief_.grid, belief_.cloud, rays_, candidate, marks_, options);
  }

  SpeedRow all_over_one_row(KeysetViewTwin& keysets) {
    const ViewOptions one = {.sparse_below = 100.0};
    const ViewOptions all = {
        .detail = ViewDetail::rays, .sparse_below = 100.0, .shadow = &belief_.shadow};
    const double one_us = median_us(candidates_, kRounds, [&](const ViewPose& candidate) {
      add_scores(evaluate(candidate, one), {"proposed"});
    });
    const std::vector<std::string_view> names = utility_names();
    const double all_us = median_us(candidates_, kRounds, [&](const ViewPose& candidate) {
      add_scores(evaluate(candidate, all), names);
    });
    return {.name = "all_utilities_over_one",
            .ours = all_us,
            .reference = one_us,
            .unit = "us/candidate",
            .identical = is_exact(keysets),
            .target = 1.3,
            .is_limit = true};
  }

  void add_scores(ViewStats stats, const std::vector<std::string_view>& names) {
    stats.density_max = belief_.cloud.density_max();
    stats.path_m = 1.0;
    for (const std::string_view name : names) {
      UtilityConfig config;
      config.name = name;
      if (const auto s = score(config, stats)) checksum_ += s->value;
    }
  }

  /// Ours but for float32's rounding; key sets to the voxel.
  bool is_exact(KeysetViewTwin& keysets) {
    std::int64_t difference = 0;
    std::int64_t voxels = 0;
    bool are_keysets_exact = true;
    for (const ViewPose& candidate : candidates_) {
      const ViewStats ours = evaluate(candidate, {});
      const ViewCounts exact = exact_view_counts(belief_.grid, rays_, candidate);
      are_keysets_exact = are_keysets_exact && keysets.evaluate(rays_, candidate) == exact;
      difference += std::abs(exact.free - ours.free_voxels) +
                    std::abs(exact.occupied - ours.occupied_voxels) +
                    std::abs(exact.unknown - ours.unknown_voxels);
      voxels += exact.free + exact.occupied + exact.unknown;
    }
    return are_keysets_exact &&
           static_cast<double>(difference) <= 1e-5 * static_cast<double>(voxels);
  }

  std::array<CameraModel, 2> cameras_ = camera_pair();
  BenchBelief belief_ = make_belief(cameras_);
  ViewRays rays_ = make_view_rays(cameras_, belief_.grid.geometry().resolution_m());
  std::vector<ViewPose> candidates_ = make_candidates();
  VisitMarks marks_{belief_.grid.geometry().voxel_count()};
  double checksum_ = 0.0;  // keeps the work from being optimised away
};

}  // namespace

std::vector<SpeedRow> view_speed() { return ViewBench().rows(); }

}  // namespace gnbv
