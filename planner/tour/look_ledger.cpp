#include "planner/tour/look_ledger.hpp"

#include <algorithm>
#include <bit>

namespace gnbv {
namespace {

constexpr double kFade = 0.8;          // of what a cube kept, each time a view looks into it
constexpr double kTrustVoxels = 32.0;  // that a cube is believed to have promised and kept before

}  // namespace

double LookLedger::promise(std::span<const SeenPatch> seen, std::span<const Patch> patches,
                           const SurfaceCells& cells) {
  double sum = 0.0;
  for (const SeenPatch& look : seen) {
    const Patch& patch = patches[look.patch];
    promises_.push_back({.look = look,
                         .patch = patch,
                         .promised = patch.missing * success_.share(patch, look.incidence),
                         .covered_before = cells.cells()[cell_of(look.patch)].covered});
    sum += static_cast<double>(promises_.back().promised);
  }
  return sum;
}

void LookLedger::settle(SurfaceCells& cells) {
  outcomes_.clear();
  std::map<Key, Kept> now;
  for (const Promise& promise : promises_) {
    const auto& [look, patch, promised, covered_before] = promise;
    const std::uint64_t fresh = cells.cells()[cell_of(look.patch)].covered & ~covered_before;
    const auto missing = static_cast<double>(patch.missing);
    const double found = std::min(missing, static_cast<double>(std::popcount(fresh)));
    success_.learn(patch, look.incidence, missing, found);
    cells.count_look(cell_of(look.patch), side_of(look.patch));
    book(promise, found);
    Kept& cube = now[cube_of(patch)];
    cube.promised += static_cast<double>(promised / patch.credit);
    cube.found += found;
  }
  for (const auto& [cube, seen] : now) {
    Kept& kept = kept_[cube];
    kept.promised = kFade * kept.promised + seen.promised;
    kept.found = kFade * kept.found + seen.found;
  }
  promises_.clear();
}

Key LookLedger::cube_of(const Patch& patch) const {
  const Eigen::Vector3i at =
      (patch.target_m / static_cast<float>(cube_m_)).array().floor().cast<int>();
  return {at.x(), at.y(), at.z()};
}

void LookLedger::give_credit(std::vector<Patch>& patches) const {
  if (method_ == TourSuccess::fixed) return;
  for (Patch& patch : patches) {
    if (patch.missing <= 0.0F) continue;
    const auto kept = kept_.find(cube_of(patch));
    if (kept == kept_.end()) continue;
    const auto& [promised, found] = kept->second;
    const double share = (found + kTrustVoxels) / (promised + kTrustVoxels);
    patch.credit = static_cast<float>(std::min(1.0, share));
  }
}

void LookLedger::book(const Promise& promise, double found) {
  const std::size_t looks = std::min<std::size_t>(promise.patch.looks, kLookBins - 1);
  const PatchSource source = promise.patch.source;
  const std::size_t incidence = promise.look.incidence;
  auto same = std::find_if(outcomes_.begin(), outcomes_.end(), [&](const LookOutcome& outcome) {
    return outcome.source == source && outcome.looks == looks && outcome.incidence == incidence;
  });
  if (same == outcomes_.end()) {
    outcomes_.push_back({.source = source, .looks = looks, .incidence = incidence});
    same = outcomes_.end() - 1;
  }
  ++same->patches;
  same->missing += static_cast<double>(promise.patch.missing);
  same->promised += static_cast<double>(promise.promised);
  same->found += found;
}

double LookLedger::promised() const {
  double sum = 0.0;
  for (const LookOutcome& outcome : outcomes_) sum += outcome.promised;
  return sum;
}

double LookLedger::found() const {
  double sum = 0.0;
  for (const LookOutcome& outcome : outcomes_) sum += outcome.found;
  return sum;
}

}  // namespace gnbv
