#include "planner/tour/gains.hpp"

#include <algorithm>
#include <utility>

#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

// What a side that nobody observed lacks when the other side is known: a share of its voxels.
constexpr float kOppositeShare = 0.5F;
// What a cell of unknown space lacks: a fifth of a plane through it.
constexpr float kBoundaryVoxels = 0.2F * SurfaceCell::kSide * SurfaceCell::kSide;

// What an observation is taken to bring before anything was learned. Of sampled surface nearly all;
// each observation that left something says that the rest is hard to get.
constexpr std::array<double, kPatchSources> kPrior = {0.9, 0.5, 0.3, 0.5};
constexpr double kPriorPerObservation = 0.4;
constexpr std::array<double, kIncidenceBins> kPriorOfIncidence = {1.0, 0.95, 0.8};
constexpr std::array<double, kCertaintyBins> kPriorOfCertainty = {1.0, 0.8, 0.5, 0.2};
constexpr double kPriorTries = 300.0;  // the prior weighs as much as so many small voxels

// Each time a view sees into a cube, what was known of it counts by this factor. To begin with, so
// many voxels count as gained just as predicted.
constexpr double kFade = 0.8;
constexpr double kTrustVoxels = 32.0;

/// In float32, as the target is.
Key reliability_cube(const Patch& patch, double cube_m) {
  return cube_of((patch.target_m / static_cast<float>(cube_m)).cast<double>(), 1.0);
}

/// The middle of what is expected of a cell on its plane and holds no point.
Vec3f gap_middle_m(const SurfaceCells& cells, const SurfaceCell& cell, std::uint64_t missing) {
  if (missing == 0) return cell.on_plane_m;
  Vec3 sum_m = Vec3::Zero();
  const Vec3 normal = cell.normal.cast<double>();
  for_each_voxel(missing, [&](int bit) {
    const Vec3 center_m = cells.voxel_center_m(cell, bit);
    sum_m += center_m - cell.off_plane_m(center_m) * normal;
  });
  return (sum_m / std::popcount(missing)).cast<float>();
}

/// The patches of a cell with a plane, one a side.
void set_sides(const SurfaceCells& cells, const SurfaceCell& cell, const OccupancyGrid& grid,
               Patch* sides) {
  const auto before_m =
      static_cast<float>(1.5 * std::max(cells.edge_m(), grid.geometry().resolution_m()));
  const std::array<Vec3f, 2> normals = {cell.normal, -cell.normal};
  std::array<VoxelState, 2> before;
  for (int side = 0; side < 2; ++side) {
    before[side] = grid.state_at((cell.on_plane_m + before_m * normals[side]).cast<double>());
  }
  const bool any_free = before[0] == VoxelState::free || before[1] == VoxelState::free;
  const VoxelState needed = any_free ? VoxelState::free : VoxelState::unknown;
  const std::uint64_t missing = cell.expected & ~cell.covered;
  const auto expected = static_cast<float>(std::popcount(cell.expected));
  const Patch known = {
      .target_m = gap_middle_m(cells, cell, missing),
      .missing = static_cast<float>(std::popcount(missing)),
      .source = cell.is_extrapolated() ? PatchSource::extrapolated : PatchSource::sampled,
      // what an observation of one side has left, one of the other will hardly find
      .observations =
          static_cast<std::uint8_t>(std::min(0xff, cell.observations[0] + cell.observations[1])),
      .points = point_bin(cell.moments.count / expected)};
  for (int side = 0; side < 2; ++side) {
    if (before[side] != needed) continue;
    Patch& patch = sides[side];
    patch = known;
    patch.normal = normals[side];
    const bool is_other_side = cell.observations[side] == 0 && cell.observations[1 - side] > 0;
    if (!is_other_side || patch.missing >= kOppositeShare * expected) continue;
    patch.target_m = cell.on_plane_m;
    patch.missing = kOppositeShare * expected;
    patch.source = PatchSource::opposite;
    patch.observations = 0;
  }
}

constexpr double kLeastExpected = 0.5;  // a cube that can be expected to bring less is left out

std::vector<PatchCube> gathered(std::span<const Patch> patches, const ObservationYield& yield,
                                double cube_m) {
  std::map<std::pair<PatchSource, Key>, PatchCube> cubes;
  for (const Patch& patch : patches) {
    const double expected = yield.face_on_gain(patch);
    if (expected <= 0.0) continue;
    const Vec3 target_m = patch.target_m.cast<double>();
    PatchCube& cube = cubes[{patch.source, cube_of(target_m, cube_m)}];
    cube.source = patch.source;
    cube.p_world_m += expected * target_m;
    cube.expected += expected;
  }
  std::vector<PatchCube> kept;
  for (auto& [key, cube] : cubes) {
    if (cube.expected < kLeastExpected) continue;
    cube.p_world_m /= cube.expected;
    kept.push_back(cube);
  }
  return kept;
}

}  // namespace

std::uint8_t point_bin(double points_per_voxel) {
  constexpr std::array<double, kPointBins - 1> kFrom = {0.25, 1.0, 2.0, 4.0};
  return static_cast<std::uint8_t>(std::upper_bound(kFrom.begin(), kFrom.end(), points_per_voxel) -
                                   kFrom.begin());
}

std::vector<Patch> find_patches(const SurfaceCells& cells, const OccupancyGrid& grid, int threads) {
  const std::span<const SurfaceCell> all = cells.cells();
  std::vector<Patch> patches(2 * all.size());
  parallel_for_chunks(threads, all.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const SurfaceCell& cell = all[i];
      if (cell.is_boundary) {
        patches[2 * i] = {.target_m = cell.on_plane_m,
                          .normal = cell.normal,
                          .missing = kBoundaryVoxels,
                          .source = PatchSource::boundary,
                          .observations = cell.observations[0]};
      }
      if (cell.has_plane()) set_sides(cells, cell, grid, &patches[2 * i]);
    }
  });
  return patches;
}

ObservationYield::ObservationYield() {
  Patch patch;
  for (std::size_t source = 0; source < kPatchSources; ++source) {
    patch.source = static_cast<PatchSource>(source);
    double prior = kPrior[source];
    for (patch.observations = 0; patch.observations < kObservationBins; ++patch.observations) {
      SeenPatch how;
      for (how.certainty = 0; how.certainty < kCertaintyBins; ++how.certainty) {
        for (how.incidence = 0; how.incidence < kIncidenceBins; ++how.incidence) {
          const double share =
              prior * kPriorOfIncidence[how.incidence] * kPriorOfCertainty[how.certainty];
          for (patch.points = 0; patch.points < kPointBins; ++patch.points) {
            learn(patch, how, kPriorTries, kPriorTries * share);
          }
        }
      }
      prior *= kPriorPerObservation;
    }
  }
}

void ObservationYield::learn(const Patch& patch, const SeenPatch& how, double missing,
                             double found) {
  const std::size_t at = index(patch, how);
  tries_[at] += missing;
  hits_[at] += std::min(found, missing);
  shares_[at] = static_cast<float>(hits_[at] / tries_[at]);
}

double GainCalibration::expected(std::span<const SeenPatch> seen,
                                 std::span<const Patch> patches) const {
  double sum = 0.0;
  for (const SeenPatch& one : seen) {
    const Patch& patch = patches[one.patch];
    sum += patch.missing * yield_.share(patch, one);
  }
  return sum;
}

void GainCalibration::note(std::span<const SeenPatch> seen, std::span<const Patch> patches,
                           const SurfaceCells& cells) {
  for (const SeenPatch& one : seen) {
    const Patch& patch = patches[one.patch];
    predictions_.push_back({.seen = one,
                            .patch = patch,
                            .gain = patch.missing * yield_.share(patch, one),
                            .covered_before = cells.cells()[cell_of(one.patch)].covered});
  }
}

Gain GainCalibration::settle(SurfaceCells& cells) {
  outcomes_.clear();
  std::map<Key, Gain> now;
  for (const auto& [seen, patch, gain, covered_before] : predictions_) {
    const std::uint64_t fresh = cells.cells()[cell_of(seen.patch)].covered & ~covered_before;
    const double missing = patch.missing;
    const double found = std::min<double>(missing, std::popcount(fresh));
    yield_.learn(patch, seen, missing, found);
    cells.count_observation(cell_of(seen.patch), side_of(seen.patch));
    const GainOutcome kind = {.source = patch.source,
                              .observations = observation_bin(patch),
                              .incidence = seen.incidence};
    auto same = std::find_if(outcomes_.begin(), outcomes_.end(), [&](const GainOutcome& other) {
      return other.source == kind.source && other.observations == kind.observations &&
             other.incidence == kind.incidence;
    });
    if (same == outcomes_.end()) same = outcomes_.insert(same, kind);
    ++same->patches;
    same->missing += patch.missing;
    same->predicted += gain;
    same->found += found;
    Gain& cube = now[reliability_cube(patch, cube_m_)];
    cube.predicted += gain / patch.reliability;
    cube.found += found;
  }
  predictions_.clear();
  for (const auto& [cube, seen] : now) {
    Gain& lately = lately_[cube];
    lately.predicted = kFade * lately.predicted + seen.predicted;
    lately.found = kFade * lately.found + seen.found;
  }
  Gain sum;
  for (const GainOutcome& outcome : outcomes_) {
    sum.predicted += outcome.predicted;
    sum.found += outcome.found;
  }
  return sum;
}

void GainCalibration::set_reliability(std::vector<Patch>& patches) const {
  for (Patch& patch : patches) {
    if (patch.missing <= 0.0F) continue;
    const auto lately = lately_.find(reliability_cube(patch, cube_m_));
    if (lately == lately_.end()) continue;
    const auto& [predicted, found] = lately->second;
    const double share = (found + kTrustVoxels) / (predicted + kTrustVoxels);
    patch.reliability = static_cast<float>(std::min(1.0, share));
  }
}

TourPlan make_tour_plan(std::vector<ViewPose> views, std::span<const Patch> patches,
                        const ObservationYield& yield) {
  TourPlan plan{.views = std::move(views), .cube_m = kLeastCube_m, .cubes = {}};
  plan.cubes = gathered(patches, yield, plan.cube_m);
  while (plan.cubes.size() > kMostCubes) {
    plan.cube_m *= 2.0;
    plan.cubes = gathered(patches, yield, plan.cube_m);
  }
  return plan;
}

}  // namespace gnbv
