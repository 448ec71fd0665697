#include "planner/tour/expected_cover.hpp"

#include "sim/core/error.hpp"

namespace gnbv {

LookTable::LookTable(const PrizeTask& task) : first_(task.weight.size() + 1, 0) {
  for (const auto& looks : task.looks) {
    first_look_.push_back(odds_.size());
    for (const ItemLook& look : looks) {
      GNBV_CHECK(look.item < task.weight.size() && look.success >= 0.0F && look.success < 1.0F,
                 "look at item {} of {} with success {}", look.item, task.weight.size(),
                 look.success);
      ++first_[look.item + 1];
      odds_.push_back(look.success / (1.0F - look.success));
    }
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  holders_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t view = 0; view < task.looks.size(); ++view) {
    for (const ItemLook& look : task.looks[view]) {
      holders_[next[look.item]++] = {view, look.success};
    }
  }
}

ExpectedCover::ExpectedCover(const PrizeTask& task, const LookTable& table)
    : task_(&task),
      table_(&table),
      gain_(task.looks.size(), 0.0),
      missed_(task.weight.size(), 1.0),
      is_chosen_(task.looks.size(), 0) {
  for (std::size_t view = 0; view < task.looks.size(); ++view) {
    for (const ItemLook& look : task.looks[view]) {
      gain_[view] += static_cast<double>(task.weight[look.item] * look.success);
    }
  }
}

void ExpectedCover::change(std::uint32_t item, double missed) {
  const double by = static_cast<double>(task_->weight[item]) * (missed - missed_[item]);
  for (const LookTable::Holder& holder : table_->holders(item)) {
    gain_[holder.view] += by * static_cast<double>(holder.success);
  }
  found_ -= by;
  missed_[item] = missed;
}

void ExpectedCover::add(std::uint32_t view) {
  GNBV_CHECK(is_chosen_[view] == 0, "view {} is there already", view);
  is_chosen_[view] = 1;
  for (const ItemLook& look : task_->looks[view]) {
    change(look.item, missed_[look.item] * (1.0 - static_cast<double>(look.success)));
  }
}

void ExpectedCover::remove(std::uint32_t view) {
  GNBV_CHECK(is_chosen_[view] != 0, "view {} is not there", view);
  is_chosen_[view] = 0;
  for (const ItemLook& look : task_->looks[view]) {
    change(look.item, missed_[look.item] / (1.0 - static_cast<double>(look.success)));
  }
}

double ExpectedCover::loss_without(std::uint32_t view) const {
  double loss = 0.0;
  const float* odds = table_->odds(view);
  for (const ItemLook& look : task_->looks[view]) {
    loss += static_cast<double>(task_->weight[look.item] * *odds++) * missed_[look.item];
  }
  return loss;
}

}  // namespace gnbv
