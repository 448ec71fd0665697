// Open tours that trade what their views can be expected to bring against the way between them: an
// orienteering problem whose profits overlap.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "planner/tour/waypoints.hpp"

namespace gnbv {

/// An observation that finds the item with some probability, whatever others do.
struct ItemObservation {
  std::uint32_t item = 0;
  float success = 0.0F;
};

/// Views at the nodes of a roadmap, what they may bring, and the way between the nodes.
struct OrienteeringProblem {
  std::vector<float> weight;                               // of each item
  std::vector<std::vector<ItemObservation>> observations;  // of each view, by ascending item
  std::vector<std::uint32_t> node;                         // of each view
  std::uint32_t start = 0;                                 // the node where a tour begins
  double price = 0.0;         // of a unit of way, in weight: a metre, or a second
  double way_per_view = 0.0;  // what a view costs as if it were way
  RowOf row_m = {};  // asked again and again, many times in each round of a search; may throw
};

/// What chosen views can be expected to find together, and what each further one would add. The
/// expected weight found is the sum of weight (1 - product of the observations' failures). A view
/// that comes or goes costs its items, and for each the views that observe it. Copied, it is a
/// state to return to.
class ExpectedCover {
 public:
  /// Keeps a reference to the problem.
  explicit ExpectedCover(const OrienteeringProblem& problem);

  /// Chooses the view, or lets go of it. Requires a change.
  void set(std::uint32_t view, bool is_chosen);
  bool has(std::uint32_t view) const { return is_chosen_[view] != 0; }

  double found() const { return found_; }
  /// What each view that is not chosen would add; meaningless for those chosen.
  std::span<const double> gains() const { return gain_; }
  /// What would be lost without a chosen view.
  double loss_without(std::uint32_t view) const;

 private:
  struct Observer {
    std::uint32_t view;
    float success;
  };
  const OrienteeringProblem* problem_;
  std::shared_ptr<std::vector<std::vector<Observer>>> observers_;  // of each item; for all copies
  std::vector<double> gain_;
  std::vector<double> missed_;  // of each item: the probability that no chosen view finds it
  std::vector<std::uint8_t> is_chosen_;
  double found_ = 0.0;
};

struct OrienteeringTour {
  std::vector<std::uint32_t> views = {};  // in the order of the tour, at a node by number
  double worth = 0.0;                     // what can be expected to be found less what it costs
};

/// The tour with the greatest worth that a large-neighbourhood search met (Shaw 1998; Ropke,
/// Pisinger 2006), begun with `from`. Each iteration takes views out (views_to_remove()), puts
/// others in by what they bring per metre of detour at a random price of a view, drops those that
/// do not pay, and accepts the result as annealing does: at a loss of 0.6 m at first, of 0.01 m in
/// the end. Without iterations the greedy tour. Deterministic by the seed.
OrienteeringTour solve(const OrienteeringProblem& problem, std::span<const std::uint32_t> from,
                       int iterations, std::uint64_t seed);

}  // namespace gnbv
