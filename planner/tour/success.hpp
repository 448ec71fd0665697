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

  /// Of the voxels that a patch lacks, the share that a look brings.
  float share(PatchSource source, std::size_t looks, std::size_t incidence) const {
    return shares_[index(source, looks, incidence)];
  }
  float share(const Patch& patch, std::size_t incidence) const {
    return share(patch.source, patch.looks, incidence);
  }
  /// What became of a look: `missing` voxels before, `found` of them after.
  void learn(PatchSource source, std::size_t looks, std::size_t incidence, double missing,
             double found);

 private:
  static std::size_t index(PatchSource source, std::size_t looks, std::size_t incidence) {
    const std::size_t look_bin = looks < kLookBins ? looks : kLookBins - 1;
    return (static_cast<std::size_t>(source) * kLookBins + look_bin) * kIncidenceBins + incidence;
  }
  static constexpr std::size_t kBins = kPatchSources * kLookBins * kIncidenceBins;

  TourSuccess method_;
  std::array<double, kBins> tries_{};
  std::array<double, kBins> hits_{};
  std::array<float, kBins> shares_{};
};

}  // namespace gnbv
