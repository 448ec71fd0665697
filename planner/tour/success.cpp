#include "planner/tour/success.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv {
namespace {

// before anything was learned: a look at sampled surface brings nearly all; each look that left
// something says that the rest is hard to get
constexpr std::array<double, kPatchSources> kPrior = {0.9, 0.5, 0.3, 0.5};
constexpr double kPriorPerLook = 0.4;
constexpr std::array<double, kIncidenceBins> kPriorOfIncidence = {1.0, 0.95, 0.8};
constexpr double kPriorTries = 300.0;  // small voxels that the prior weighs as much as

}  // namespace

LookSuccess::LookSuccess(TourSuccess method) : method_(method) {
  Patch patch;
  for (std::size_t source = 0; source < kPatchSources; ++source) {
    patch.source = static_cast<PatchSource>(source);
    double prior = kPrior[source];
    for (patch.looks = 0; patch.looks < kLookBins; ++patch.looks, prior *= kPriorPerLook) {
      for (std::size_t incidence = 0; incidence < kIncidenceBins; ++incidence) {
        for (patch.points = 0; patch.points < kPointBins; ++patch.points) {
          const std::size_t at = index(patch, incidence);
          tries_[at] = kPriorTries;
          hits_[at] = kPriorTries * prior * kPriorOfIncidence[incidence];
          shares_[at] = static_cast<float>(hits_[at] / tries_[at]);
        }
      }
    }
  }
}

void LookSuccess::learn(const Patch& patch, std::size_t incidence, double missing, double found) {
  if (method_ == TourSuccess::fixed) return;
  const std::size_t at = index(patch, incidence);
  tries_[at] += missing;
  hits_[at] += std::min(found, missing);
  shares_[at] = static_cast<float>(hits_[at] / tries_[at]);
}

}  // namespace gnbv
