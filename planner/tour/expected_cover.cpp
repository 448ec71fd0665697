#include "planner/tour/expected_cover.hpp"

#include "sim/core/error.hpp"

namespace gnbv {

ObservationTable::ObservationTable(const OrienteeringProblem& problem)
    : first_(problem.weight.size() + 1, 0) {
  for (const auto& observations : problem.observations) {
    for (const ItemObservation& one : observations) {
      GNBV_CHECK(one.item < problem.weight.size() && one.success >= 0.0F && one.success < 1.0F,
                 "observation of item {} of {} with success {}", one.item, problem.weight.size(),
                 one.success);
      ++first_[one.item + 1];
    }
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  holders_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t view = 0; view < problem.observations.size(); ++view) {
    for (const ItemObservation& one : problem.observations[view]) {
      holders_[next[one.item]++] = {view, one.success};
    }
  }
}

ExpectedCover::ExpectedCover(const OrienteeringProblem& problem, const ObservationTable& table)
    : problem_(&problem),
      table_(&table),
      gain_(problem.observations.size(), 0.0),
      missed_(problem.weight.size(), 1.0),
      is_chosen_(problem.observations.size(), 0) {
  for (std::size_t view = 0; view < problem.observations.size(); ++view) {
    for (const ItemObservation& one : problem.observations[view]) {
      gain_[view] += static_cast<double>(problem.weight[one.item] * one.success);
    }
  }
}

void ExpectedCover::change(std::uint32_t item, double missed) {
  const double by = static_cast<double>(problem_->weight[item]) * (missed - missed_[item]);
  for (const ObservationTable::Holder& holder : table_->holders(item)) {
    gain_[holder.view] += by * static_cast<double>(holder.success);
  }
  found_ -= by;
  missed_[item] = missed;
}

void ExpectedCover::add(std::uint32_t view) {
  GNBV_CHECK(is_chosen_[view] == 0, "view {} is there already", view);
  is_chosen_[view] = 1;
  for (const ItemObservation& one : problem_->observations[view]) {
    change(one.item, missed_[one.item] * (1.0 - static_cast<double>(one.success)));
  }
}

void ExpectedCover::remove(std::uint32_t view) {
  GNBV_CHECK(is_chosen_[view] != 0, "view {} is not there", view);
  is_chosen_[view] = 0;
  for (const ItemObservation& one : problem_->observations[view]) {
    change(one.item, missed_[one.item] / (1.0 - static_cast<double>(one.success)));
  }
}

double ExpectedCover::loss_without(std::uint32_t view) const {
  double loss = 0.0;
  for (const ItemObservation& one : problem_->observations[view]) {
    const float odds = one.success / (1.0F - one.success);
    loss += static_cast<double>(problem_->weight[one.item] * odds) * missed_[one.item];
  }
  return loss;
}

}  // namespace gnbv
