// How good a mission was, against the truth that the planner never saw.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "bench/score/cloud_metrics.hpp"
#include "bench/score/coverage_curve.hpp"
#include "bench/score/run_figures.hpp"
#include "bench/score/sized_coverage.hpp"
#include "bench/score/surface_reference.hpp"

namespace gnbv {

/// Where a mission was after a view.
struct ViewMark {
  std::size_t cloud_points = 0;
  double straight_m = 0.0;               // from the first view on
  double time_s = 0.0;                   // since the start of the mission
  std::optional<double> energy_wh = {};  // drawn since then, if it is known
  bool on_one_battery = false;           // and so far it lasts, with the way home
};

/// All of a mission that its score depends on; a run directory holds it, too.
struct ScoredCloud {
  std::span<const Vec3f> points_world_m;
  std::size_t profile_points = 0;  // the first ones
  BeforeViews before = {};
  std::vector<ViewMark> views = {};
  Box3 region_m = ReferenceConfig{}.region_m;  // as of the reference
};

/// Coverage as fractions, by kCoverageSizes_m.
struct MissionScore {
  std::array<double, 3> profile{};  // of what coverage counts
  std::array<double, 3> final{};
  std::array<double, 3> accurate{};     // of the same, final (kAccurateShare)
  std::array<double, 3> profile_raw{};  // raw reference
  std::array<double, 3> final_raw{};
  std::size_t area_samples = 0;          // of the reference
  std::vector<SizedCoverage> more = {};  // at sizes beside those, ascending
  CloudDistances distances = {};
  CloudDensity density = {};  // over voxels of the map's size
  CoverageCurve curve = {};
  BeforeViews before = {};
  Budgets budgets = {};   // of the scenario
  bool is_noisy = false;  // as RunFigures has it, for those who know
  // ceiling of the coverage at 0.05 m (leaf_counted of bench/limits/ceiling.hpp), for those who
  // know
  std::optional<double> ceiling = {};
};

/// Sizes of which those that are not the paper's are scored, too (sized_coverage.hpp), and what it
/// takes.
struct MoreSizes {
  std::span<const double> sizes_m;
  const World& world;
  ReferenceConfig reference;
};

/// Points that belong to what stands around the structure (points_of_structure()) count nowhere.
/// Distances to the structure and density are those of points in the region; coverage and recall
/// ask all points for voxels and samples in it.
/// Deterministic at any number of threads. `density_voxel_m` is planner.map.resolution_m.
MissionScore score_cloud(const SurfaceReference& reference, const RayScene& scene,
                         const ScoredCloud& cloud, double density_voxel_m, int threads,
                         const std::optional<MoreSizes>& more = {});

}  // namespace gnbv
