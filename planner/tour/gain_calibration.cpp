#include "planner/tour/gain_calibration.hpp"

#include <algorithm>
#include <bit>

namespace gnbv {
namespace {

// before anything was learned: an observation of sampled surface brings nearly all; each that left
// something says that the rest is hard to get
constexpr std::array<double, kPatchSources> kPrior = {0.9, 0.5, 0.3, 0.5};
constexpr double kPriorPerObservation = 0.4;
constexpr std::array<double, kIncidenceBins> kPriorOfIncidence = {1.0, 0.95, 0.8};
constexpr double kPriorTries = 300.0;  // small voxels that the prior weighs as much as

constexpr double kFade = 0.8;          // of what a cube kept, each time a view sees into it
constexpr double kTrustVoxels = 32.0;  // that a cube is believed to have gained as predicted before

}  // namespace

ObservationYield::ObservationYield() {
  Patch patch;
  for (std::size_t source = 0; source < kPatchSources; ++source) {
    patch.source = static_cast<PatchSource>(source);
    double prior = kPrior[source];
    for (patch.observations = 0; patch.observations < kObservationBins; ++patch.observations) {
      for (std::size_t incidence = 0; incidence < kIncidenceBins; ++incidence) {
        for (patch.points = 0; patch.points < kPointBins; ++patch.points) {
          learn(patch, incidence, kPriorTries, kPriorTries * prior * kPriorOfIncidence[incidence]);
        }
      }
      prior *= kPriorPerObservation;
    }
  }
}

void ObservationYield::learn(const Patch& patch, std::size_t incidence, double missing,
                             double found) {
  const std::size_t at = index(patch, incidence);
  tries_[at] += missing;
  hits_[at] += std::min(found, missing);
  shares_[at] = static_cast<float>(hits_[at] / tries_[at]);
}

double GainCalibration::predict(std::span<const SeenPatch> seen, std::span<const Patch> patches,
                                const SurfaceCells& cells) {
  double sum = 0.0;
  for (const SeenPatch& one : seen) {
    const Patch& patch = patches[one.patch];
    predictions_.push_back({.seen = one,
                            .patch = patch,
                            .gain = patch.missing * yield_.share(patch, one.incidence),
                            .covered_before = cells.cells()[cell_of(one.patch)].covered});
    sum += static_cast<double>(predictions_.back().gain);
  }
  return sum;
}

void GainCalibration::settle(SurfaceCells& cells) {
  outcomes_.clear();
  std::map<Key, Kept> now;
  for (const Prediction& prediction : predictions_) {
    const auto& [seen, patch, gain, covered_before] = prediction;
    const std::uint64_t fresh = cells.cells()[cell_of(seen.patch)].covered & ~covered_before;
    const auto missing = static_cast<double>(patch.missing);
    const double found = std::min(missing, static_cast<double>(std::popcount(fresh)));
    yield_.learn(patch, seen.incidence, missing, found);
    cells.count_observation(cell_of(seen.patch), side_of(seen.patch));
    book(prediction, found);
    Kept& cube = now[cube_of(patch)];
    cube.predicted += static_cast<double>(gain / patch.reliability);
    cube.found += found;
  }
  for (const auto& [cube, seen] : now) {
    Kept& kept = kept_[cube];
    kept.predicted = kFade * kept.predicted + seen.predicted;
    kept.found = kFade * kept.found + seen.found;
  }
  predictions_.clear();
  predicted_ = found_ = 0.0;
  for (const GainOutcome& outcome : outcomes_) {
    predicted_ += outcome.predicted;
    found_ += outcome.found;
  }
}

Key GainCalibration::cube_of(const Patch& patch) const {
  const Eigen::Vector3i at =
      (patch.target_m / static_cast<float>(cube_m_)).array().floor().cast<int>();
  return {at.x(), at.y(), at.z()};
}

void GainCalibration::set_reliability(std::vector<Patch>& patches) const {
  for (Patch& patch : patches) {
    if (patch.missing <= 0.0F) continue;
    const auto kept = kept_.find(cube_of(patch));
    if (kept == kept_.end()) continue;
    const auto& [predicted, found] = kept->second;
    const double share = (found + kTrustVoxels) / (predicted + kTrustVoxels);
    patch.reliability = static_cast<float>(std::min(1.0, share));
  }
}

void GainCalibration::book(const Prediction& prediction, double found) {
  const GainOutcome kind = {
      .source = prediction.patch.source,
      .observations = std::min<std::size_t>(prediction.patch.observations, kObservationBins - 1),
      .incidence = prediction.seen.incidence};
  auto same = std::find_if(outcomes_.begin(), outcomes_.end(), [&](const GainOutcome& other) {
    return other.source == kind.source && other.observations == kind.observations &&
           other.incidence == kind.incidence;
  });
  if (same == outcomes_.end()) same = outcomes_.insert(same, kind);
  ++same->patches;
  same->missing += static_cast<double>(prediction.patch.missing);
  same->predicted += static_cast<double>(prediction.gain);
  same->found += found;
}

}  // namespace gnbv
