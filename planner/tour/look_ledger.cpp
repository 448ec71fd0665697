#include "planner/tour/look_ledger.hpp"

#include <algorithm>
#include <bit>

namespace gnbv {
namespace {

constexpr double kFade = 0.9;  // a view: some ten count

}  // namespace

double LookLedger::promise(std::span<const SeenPatch> seen, std::span<const Patch> patches,
                           const SurfaceCells& cells) {
  double sum = 0.0;
  for (const SeenPatch& look : seen) {
    const Patch& patch = patches[look.patch];
    promises_.push_back({.patch = look.patch,
                         .source = patch.source,
                         .looks = patch.looks,
                         .incidence = look.incidence,
                         .missing = patch.missing,
                         .promised = patch.missing * success_.share(patch, look.incidence),
                         .covered_before = cells.cells()[cell_of(look.patch)].covered});
    sum += static_cast<double>(promises_.back().promised);
  }
  return sum;
}

void LookLedger::settle(SurfaceCells& cells) {
  outcomes_.clear();
  for (const Promise& look : promises_) {
    const std::uint64_t fresh = cells.cells()[cell_of(look.patch)].covered & ~look.covered_before;
    const auto missing = static_cast<double>(look.missing);
    const double found = std::min(missing, static_cast<double>(std::popcount(fresh)));
    success_.learn(look.source, look.looks, look.incidence, missing, found);
    cells.count_look(cell_of(look.patch), side_of(look.patch));
    book(look, found);
  }
  promises_.clear();
  lately_promised_ = kFade * lately_promised_ + promised();
  lately_found_ = kFade * lately_found_ + found();
}

double LookLedger::reality(double doubt) const {
  const double promised = lately_promised_ + doubt;
  return promised > 0.0 ? std::min(1.0, (lately_found_ + doubt) / promised) : 1.0;
}

void LookLedger::book(const Promise& promise, double found) {
  const std::size_t looks = std::min<std::size_t>(promise.looks, kLookBins - 1);
  auto same = std::find_if(outcomes_.begin(), outcomes_.end(), [&](const LookOutcome& outcome) {
    return outcome.source == promise.source && outcome.looks == looks &&
           outcome.incidence == promise.incidence;
  });
  if (same == outcomes_.end()) {
    outcomes_.push_back({.source = promise.source, .looks = looks, .incidence = promise.incidence});
    same = outcomes_.end() - 1;
  }
  ++same->patches;
  same->missing += static_cast<double>(promise.missing);
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
