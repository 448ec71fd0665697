// What observations were predicted to gain and what they brought: how the planner learns whom to
// believe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "planner/tour/patches.hpp"

namespace gnbv {

/// An observation of a patch by its incidence, the angle between line of sight and normal.
constexpr std::size_t kIncidenceBins = 3;
constexpr std::size_t kObservationBins = 5;  // before; the last: that many or more

/// Where the bins begin.
constexpr std::array<int, kIncidenceBins> kIncidenceFrom_deg = {0, 45, 65};
constexpr std::size_t incidence_bin(float cos_incidence) {
  return cos_incidence >= 0.7071F ? 0 : (cos_incidence >= 0.4226F ? 1 : 2);
}

struct SeenPatch {
  PatchId patch = 0;
  std::uint8_t incidence = 0;  // incidence_bin()
};

/// The share of a patch's missing voxels that an observation can be expected to bring, learned in
/// flight by what is observed and how: (hits + a) / (tries + b) of small voxels, where a / b is
/// what is assumed beforehand.
class ObservationYield {
 public:
  ObservationYield();

  float share(const Patch& patch, std::size_t incidence) const {
    return patch.reliability * shares_[index(patch, incidence)];
  }
  /// What became of an observation: `missing` voxels before, `found` of them after.
  void learn(const Patch& patch, std::size_t incidence, double missing, double found);

 private:
  static std::size_t index(const Patch& patch, std::size_t incidence) {
    const std::size_t before =
        patch.observations < kObservationBins ? patch.observations : kObservationBins - 1;
    const std::size_t kind = static_cast<std::size_t>(patch.source) * kObservationBins + before;
    return (kind * kIncidenceBins + incidence) * kPointBins + patch.points;
  }
  static constexpr std::size_t kBins =
      kPatchSources * kObservationBins * kIncidenceBins * kPointBins;

  std::array<double, kBins> tries_{};
  std::array<double, kBins> hits_{};
  std::array<float, kBins> shares_{};
};

/// What a view was predicted to gain by one kind of observation, and what it brought, in small
/// voxels.
struct GainOutcome {
  PatchSource source = PatchSource::sampled;
  std::size_t observations = 0;  // before; the last bin for that many or more
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

  /// Notes what the next view will see. Returns how many small voxels it can be expected to gain.
  double predict(std::span<const SeenPatch> seen, std::span<const Patch> patches,
                 const SurfaceCells& cells);

  /// Compares with what the cells hold since, learns from it, and counts the observations. No
  /// prediction is left afterwards.
  void settle(SurfaceCells& cells);

  /// Sets each patch's reliability: of what observations in its cube were predicted to gain, what
  /// they brought, those of late more than those long ago. The shares of ObservationYield are of
  /// the whole flight and of all places; what stays to the end is harder, and hard places lie
  /// together.
  void set_reliability(std::vector<Patch>& patches) const;

  /// Of the last settle(), by kind, and of all kinds together.
  std::span<const GainOutcome> outcomes() const { return outcomes_; }
  double predicted() const { return predicted_; }
  double found() const { return found_; }

 private:
  struct Prediction {
    SeenPatch seen;
    Patch patch;  // as it was
    float gain = 0.0F;
    std::uint64_t covered_before = 0;  // voxels of the cell that held a point
  };
  struct Kept {
    double predicted = 0.0, found = 0.0;  // small voxels; predicted as without reliability
  };
  void book(const Prediction& prediction, double found);
  Key cube_of(const Patch& patch) const;

  double cube_m_;
  ObservationYield yield_;
  std::map<Key, Kept> kept_;  // by cube
  std::vector<Prediction> predictions_;
  std::vector<GainOutcome> outcomes_;
  double predicted_ = 0.0, found_ = 0.0;
};

}  // namespace gnbv
