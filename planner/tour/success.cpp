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
  for (std::size_t source = 0; source < kPatchSources; ++source) {
    double prior = kPrior[source];
    for (std::size_t looks = 0; looks < kLookBins; ++looks, prior *= kPriorPerLook) {
      for (std::size_t incidence = 0; incidence < kIncidenceBins; ++incidence) {
        const std::size_t at = index(static_cast<PatchSource>(source), looks, incidence);
        tries_[at] = kPriorTries;
        hits_[at] = kPriorTries * prior * kPriorOfIncidence[incidence];
        shares_[at] = static_cast<float>(hits_[at] / tries_[at]);
      }
    }
  }
}

void LookSuccess::learn(PatchSource source, std::size_t looks, std::size_t incidence,
                        double missing, double found) {
  if (method_ == TourSuccess::fixed) return;
  const std::size_t at = index(source, looks, incidence);
  tries_[at] += missing;
  hits_[at] += std::min(found, missing);
  shares_[at] = static_cast<float>(hits_[at] / tries_[at]);
}

}  // namespace gnbv
