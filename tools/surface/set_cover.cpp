#include "tools/surface/set_cover.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

struct Bid {
  double gain_per_cost = 0.0;
  std::size_t set = 0;
  bool is_fresh = false;
  bool operator<(const Bid& other) const {  // the top of the queue is the greatest of all
    return gain_per_cost != other.gain_per_cost ? gain_per_cost < other.gain_per_cost
                                                : set > other.set;
  }
};

}  // namespace

LazyGreedy::LazyGreedy(std::vector<const std::vector<std::uint32_t>*> sets, std::size_t items)
    : sets_(std::move(sets)), is_taken_(items, 0) {
  for (const auto* set : sets_) {
    for (const std::uint32_t item : *set) GNBV_CHECK(item < items, "item {} of {}", item, items);
    known_gain_.push_back(set->size());
  }
}

std::size_t LazyGreedy::gain(std::size_t set) const {
  return static_cast<std::size_t>(
      std::count_if(sets_[set]->begin(), sets_[set]->end(),
                    [&](std::uint32_t item) { return is_taken_[item] == 0; }));
}

std::optional<std::size_t> LazyGreedy::best(std::span<const double> costs) {
  GNBV_CHECK(costs.size() == sets_.size(), "{} costs of {} sets", costs.size(), sets_.size());
  const auto bid = [&](std::size_t set, bool is_fresh) {
    return Bid{static_cast<double>(known_gain_[set]) / costs[set], set, is_fresh};
  };
  std::vector<Bid> bids;
  for (std::size_t set = 0; set < sets_.size(); ++set) {
    GNBV_CHECK(costs[set] > 0.0, "set {} costs {}", set, costs[set]);
    if (known_gain_[set] > 0) bids.push_back(bid(set, false));
  }
  std::priority_queue<Bid> queue(std::less<Bid>{}, std::move(bids));
  while (!queue.empty()) {
    const Bid top = queue.top();
    if (top.is_fresh) return top.set;
    queue.pop();
    known_gain_[top.set] = gain(top.set);
    if (known_gain_[top.set] > 0) queue.push(bid(top.set, true));
  }
  return std::nullopt;
}

std::size_t LazyGreedy::take(std::span<const std::uint32_t> items) {
  std::size_t count = 0;
  for (const std::uint32_t item : items) {
    count += is_taken_[item] == 0 ? 1 : 0;
    is_taken_[item] = 1;
  }
  return count;
}

}  // namespace gnbv
