// What views chosen so far can be expected to find together, and what each further one would add.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/tour/orienteering.hpp"

namespace gnbv {

/// For each item the observations of it.
class ObservationTable {
 public:
  explicit ObservationTable(const OrienteeringProblem& problem);

  struct Holder {
    std::uint32_t view;
    float success;
  };
  std::span<const Holder> holders(std::uint32_t item) const {
    return std::span(holders_).subspan(first_[item], first_[item + 1] - first_[item]);
  }

 private:
  std::vector<std::size_t> first_;  // holder of each item
  std::vector<Holder> holders_;
};

/// Expected weight found is the sum of weight (1 - product of the observations' failures). A view
/// that comes or goes costs its items, and for each the views that observe it. Copied, it is a
/// state to return to.
class ExpectedCover {
 public:
  ExpectedCover(const OrienteeringProblem& problem, const ObservationTable& table);

  void add(std::uint32_t view);
  void remove(std::uint32_t view);
  bool has(std::uint32_t view) const { return is_chosen_[view] != 0; }

  double found() const { return found_; }
  /// What each view that is not chosen would add; meaningless for those chosen.
  std::span<const double> gains() const { return gain_; }
  /// What would be lost without a chosen view.
  double loss_without(std::uint32_t view) const;

 private:
  void change(std::uint32_t item, double missed);

  const OrienteeringProblem* problem_;
  const ObservationTable* table_;
  std::vector<double> gain_;
  std::vector<double> missed_;  // of each item: the probability that no chosen view finds it
  std::vector<std::uint8_t> is_chosen_;
  double found_ = 0.0;
};

}  // namespace gnbv
