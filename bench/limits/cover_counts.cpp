#include "bench/limits/cover_counts.hpp"

#include <limits>

#include "sim/core/error.hpp"

namespace gnbv {

CoverSets::CoverSets(std::span<const std::vector<std::uint32_t>> sets, std::size_t items)
    : sets_(sets), first_(items + 1, 0) {
  for (const auto& set : sets_) {
    for (const std::uint32_t item : set) {
      GNBV_CHECK(item < items, "item {} of {}", item, items);
      ++first_[item + 1];
    }
  }
  for (std::size_t item = 0; item < items; ++item) first_[item + 1] += first_[item];
  holders_.resize(first_[items]);
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t set = 0; set < sets_.size(); ++set) {
    for (const std::uint32_t item : sets_[set]) {
      holders_[next[item]++] = static_cast<std::uint32_t>(set);
    }
  }
}

CoverCounts::CoverCounts(const CoverSets& sets, std::span<const std::uint32_t> given)
    : sets_(&sets),
      count_(sets.items(), 0),
      holder_(sets.items(), 0),
      alone_(sets.size() + 1, 0),
      is_chosen_(sets.size(), 0) {
  for (std::size_t set = 0; set < sets.size(); ++set) {
    gain_.push_back(static_cast<std::uint32_t>(sets.items_of(set).size()));
  }
  const auto nobody = static_cast<std::uint32_t>(sets.size());
  for (const std::uint32_t item : given) {
    GNBV_CHECK(item < count_.size() && count_[item] == 0, "given item {} of {}", item,
               count_.size());
    count_[item] = 1;
    holder_[item] = nobody;
    ++alone_[nobody];
    cover(item);
  }
}

void CoverCounts::cover(std::uint32_t item) {
  for (const std::uint32_t set : sets_->sets_with(item)) --gain_[set];
  ++covered_;
}

void CoverCounts::uncover(std::uint32_t item) {
  for (const std::uint32_t set : sets_->sets_with(item)) ++gain_[set];
  --covered_;
}

std::size_t CoverCounts::add(std::uint32_t set) {
  GNBV_CHECK(is_chosen_[set] == 0, "set {} is there already", set);
  const std::size_t before = covered_;
  is_chosen_[set] = 1;
  for (const std::uint32_t item : sets_->items_of(set)) {
    GNBV_CHECK(count_[item] < std::numeric_limits<std::uint16_t>::max(), "item {}", item);
    if (count_[item] == 0) {
      ++alone_[set];
      cover(item);
    } else if (count_[item] == 1) {
      --alone_[holder_[item]];
    }
    ++count_[item];
    holder_[item] ^= set;
  }
  return covered_ - before;
}

void CoverCounts::remove(std::uint32_t set) {
  GNBV_CHECK(is_chosen_[set] != 0, "set {} is not there", set);
  is_chosen_[set] = 0;
  for (const std::uint32_t item : sets_->items_of(set)) {
    --count_[item];
    holder_[item] ^= set;
    if (count_[item] == 0) {
      --alone_[set];
      uncover(item);
    } else if (count_[item] == 1) {
      ++alone_[holder_[item]];
    }
  }
}

}  // namespace gnbv
