// How much of what a look promises it brings: learned in flight, by what is looked at and how.
#pragma once

#include <array>
#include <cstddef>

#include "planner/tour/config.hpp"
#include "planner/tour/patches.hpp"

namespace gnbv {

/// A look at a patch by its incidence, the angle between line of sight and normal.
constexpr std::size_t kIncidenceBins = 3;
constexpr std::size_t kLookBins = 5;  // looks before; the last: that many or more

/// Where the bins begin.
constexpr std::array<int, kIncidenceBins> kIncidenceFrom_deg = {0, 45, 65};
constexpr std::size_t incidence_bin(float cos_incidence) {
  return cos_incidence >= 0.7071F ? 0 : (cos_incidence >= 0.4226F ? 1 : 2);
}

/// (hits + a) / (tries + b) of small voxels, where a / b is what is assumed beforehand.
class LookSuccess {
 public:
  explicit LookSuccess(TourSuccess method);

  /// Of the voxels that a patch lacks, the share that a look can be expected to bring.
  float share(const Patch& patch, std::size_t incidence) const {
    return patch.credit * shares_[index(patch, incidence)];
  }
  /// What became of a look: `missing` voxels before, `found` of them after.
  void learn(const Patch& patch, std::size_t incidence, double missing, double found);

 private:
  static std::size_t index(const Patch& patch, std::size_t incidence) {
    const std::size_t looks = patch.looks < kLookBins ? patch.looks : kLookBins - 1;
    const std::size_t kind = static_cast<std::size_t>(patch.source) * kLookBins + looks;
    return (kind * kIncidenceBins + incidence) * kPointBins + patch.points;
  }
  static constexpr std::size_t kBins = kPatchSources * kLookBins * kIncidenceBins * kPointBins;

  TourSuccess method_;
  std::array<double, kBins> tries_{};
  std::array<double, kBins> hits_{};
  std::array<float, kBins> shares_{};
};

}  // namespace gnbv
