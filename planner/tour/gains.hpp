// What the surface still lacks, what an observation of it can be expected to gain, and how that is
// learned from what observations brought.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "planner/tour/certainty.hpp"
#include "planner/tour/surface_cells.hpp"

namespace gnbv {

/// What is known of a patch: some of its points; a plane that leads there; the other side of
/// something thin; nothing but that it borders on unknown space.
enum class PatchSource : std::uint8_t { sampled, extrapolated, opposite, boundary };
constexpr std::size_t kPatchSources = 4;
constexpr std::string_view name_of(PatchSource source) {
  constexpr std::array<std::string_view, kPatchSources> kNames = {"sampled", "extrapolated",
                                                                  "opposite", "frontier"};
  return kNames[static_cast<std::size_t>(source)];
}

/// One side of a cell, for ever: 2 cell + (0: the side its normal points to, 1: the other).
using PatchId = std::uint32_t;
constexpr std::uint32_t cell_of(PatchId patch) { return patch / 2; }
constexpr std::size_t side_of(PatchId patch) { return patch % 2; }

/// Bin of how many points a cell holds for each small voxel expected of it; the last: 4 or more.
/// What many points have left out is hard to get.
constexpr std::size_t kPointBins = 5;
std::uint8_t point_bin(double points_per_voxel);

struct Patch {
  Vec3f target_m = Vec3f::Zero();  // the middle of what it lacks
  Vec3f normal = Vec3f::Zero();    // out of the surface
  float missing = 0.0F;            // small voxels expected to lack a point; 0: nothing to see here
  PatchSource source = PatchSource::sampled;
  std::uint8_t observations = 0;  // at both sides of the cell
  std::uint8_t points = 0;        // point_bin() of its cell
  float reliability = 1.0F;       // of predictions: the share that came true nearby of late
};

/// By PatchId. A side is there if the space before it is not known to be surface.
std::vector<Patch> find_patches(const SurfaceCells& cells, const OccupancyGrid& grid, int threads);

/// Bins of an observation: its incidence, the angle between line of sight and normal, and how many
/// there were before (the last bin: that many or more).
constexpr std::size_t kIncidenceBins = 3;
constexpr std::size_t kObservationBins = 5;
constexpr std::array<int, kIncidenceBins> kIncidenceFrom_deg = {0, 45, 65};
constexpr std::size_t incidence_bin(float cos_incidence) {
  return cos_incidence >= 0.7071F ? 0 : (cos_incidence >= 0.4226F ? 1 : 2);
}
constexpr std::size_t observation_bin(const Patch& patch) {
  return std::min<std::size_t>(patch.observations, kObservationBins - 1);
}

struct SeenPatch {
  PatchId patch = 0;
  std::uint8_t incidence = 0;  // incidence_bin()
  std::uint8_t certainty = 0;  // certainty_bin()
};

/// The share of a patch's missing voxels that an observation can be expected to bring, learned in
/// flight by what is observed and how: (hits + a) / (tries + b) of small voxels, where a / b is
/// what is assumed beforehand.
class ObservationYield {
 public:
  ObservationYield();

  float share(const Patch& patch, const SeenPatch& how) const {
    return patch.reliability * shares_[index(patch, how)];
  }
  /// Small voxels that one observation of the patch, face on, can be expected to bring.
  float face_on_gain(const Patch& patch) const { return patch.missing * share(patch, {}); }
  /// What became of an observation: `missing` voxels before, `found` of them after.
  void learn(const Patch& patch, const SeenPatch& how, double missing, double found);

 private:
  static std::size_t index(const Patch& patch, const SeenPatch& how) {
    const std::size_t kind =
        static_cast<std::size_t>(patch.source) * kObservationBins + observation_bin(patch);
    const std::size_t view = how.certainty * kIncidenceBins + how.incidence;
    return (kind * kIncidenceBins * kCertaintyBins + view) * kPointBins + patch.points;
  }
  static constexpr std::size_t kBins =
      kPatchSources * kObservationBins * kIncidenceBins * kCertaintyBins * kPointBins;

  std::array<double, kBins> tries_{};
  std::array<double, kBins> hits_{};
  std::array<float, kBins> shares_{};
};

/// In small voxels (SurfaceCells::detail_m).
struct Gain {
  double predicted = 0.0, found = 0.0;
};

/// What a view was predicted to gain by one kind of observation and what it brought, in voxels.
struct GainOutcome {
  PatchSource source = PatchSource::sampled;
  std::size_t observations = 0;  // observation_bin(), before
  std::size_t incidence = 0;     // incidence_bin()
  int patches = 0;
  double missing = 0.0;    // expected to lack a point
  double predicted = 0.0;  // of them, by what was learned so far
  double found = 0.0;
};

/// Compares what each view was predicted to gain with what it brought.
class GainCalibration {
 public:
  /// Edge of the cubes of which each has a reliability of its own, in edges of a small voxel.
  static constexpr double kReliabilityCube = 20.0;

  /// `detail_m`: edge of a small voxel.
  explicit GainCalibration(double detail_m) : cube_m_(kReliabilityCube * detail_m) {}

  const ObservationYield& yield() const { return yield_; }

  /// How many small voxels can be expected of seeing that.
  double expected(std::span<const SeenPatch> seen, std::span<const Patch> patches) const;
  /// Notes what the next view will see, or has, before its points are among the cells.
  void note(std::span<const SeenPatch> seen, std::span<const Patch> patches,
            const SurfaceCells& cells);

  /// Compares with what the cells hold since, learns from it, counts the observations and returns
  /// their sum. No prediction is left afterwards.
  Gain settle(SurfaceCells& cells);

  /// Sets each patch's reliability: the share that came true of what observations in its cube were
  /// predicted to gain; late ones weigh more. ObservationYield is of all the flight and all places,
  /// but what stays to the end is harder, and hard places lie together.
  void set_reliability(std::vector<Patch>& patches) const;

  /// Of the last settle(), by kind.
  std::span<const GainOutcome> outcomes() const { return outcomes_; }

 private:
  struct Prediction {
    SeenPatch seen;
    Patch patch;  // as it was
    float gain = 0.0F;
    std::uint64_t covered_before = 0;  // voxels of the cell that held a point
  };

  double cube_m_;
  ObservationYield yield_;
  std::map<Key, Gain> lately_;  // by cube; predicted as without reliability
  std::vector<Prediction> predictions_;
  std::vector<GainOutcome> outcomes_;
};

/// Patches of one source whose targets lie in one cube of the world's lattice.
struct PatchCube {
  PatchSource source = PatchSource::sampled;
  Vec3 p_world_m = Vec3::Zero();  // centre of mass of what they can be expected to bring
  double expected = 0.0;  // of the small voxels they lack, those that observations can bring
};

struct TourPlan {
  std::vector<ViewPose> views;  // in the order of the tour
  double cube_m = 0.0;          // edge of the cubes
  std::vector<PatchCube> cubes;
};

/// All patches that can be expected to bring something when seen face on, by source and place, in
/// cubes of kLeastCube_m, or twice, four times ... that, so that there are at most kMostCubes.
TourPlan make_tour_plan(std::vector<ViewPose> views, std::span<const Patch> patches,
                        const ObservationYield& yield);
constexpr double kLeastCube_m = 0.25;
constexpr std::size_t kMostCubes = 3000;

/// What a tour's planner did to come to its next view, for files and pictures.
struct TourNotes {
  std::vector<GainOutcome> outcomes = {};  // of the view before: what was predicted and found
  std::optional<TourPlan> plan = {};       // made anew, its next view among it; nothing: it goes on
};

}  // namespace gnbv
