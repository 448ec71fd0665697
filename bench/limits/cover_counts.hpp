// Which items chosen sets hold together, and what each further set would add: kept up to date while
// sets come and go, so that a search may ask at any time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gnbv {

/// Sets of items, and for each item the sets that hold it.
class CoverSets {
 public:
  /// Keeps the span of the sets, which hold items in [0, items), each once.
  CoverSets(std::span<const std::vector<std::uint32_t>> sets, std::size_t items);

  std::size_t size() const { return sets_.size(); }
  std::size_t items() const { return first_.size() - 1; }
  std::span<const std::uint32_t> items_of(std::size_t set) const { return sets_[set]; }
  std::span<const std::uint32_t> sets_with(std::size_t item) const {
    return std::span(holders_).subspan(first_[item], first_[item + 1] - first_[item]);
  }

 private:
  std::span<const std::vector<std::uint32_t>> sets_;
  std::vector<std::size_t> first_;  // of each item, and the end of the last: into holders_
  std::vector<std::uint32_t> holders_;
};

/// Chosen sets. A set that comes or goes costs its items, and for each item that is covered now and
/// was not, or the other way round, the sets that hold it. Copied, it is a state to return to.
class CoverCounts {
 public:
  /// Keeps a reference to the sets. The `given` items, each once, are covered for ever.
  CoverCounts(const CoverSets& sets, std::span<const std::uint32_t> given);

  /// A set that is not chosen; how many items it adds.
  std::size_t add(std::uint32_t set);
  /// A set that is chosen.
  void remove(std::uint32_t set);

  bool is_chosen(std::uint32_t set) const { return is_chosen_[set] != 0; }
  std::size_t covered() const { return covered_; }
  /// How many items of each set nobody covers.
  std::span<const std::uint32_t> gains() const { return gain_; }
  /// How many items this one covers alone: none unless it is chosen.
  std::size_t alone(std::uint32_t set) const { return alone_[set]; }

 private:
  void cover(std::uint32_t item);
  void uncover(std::uint32_t item);

  const CoverSets* sets_;
  std::vector<std::uint16_t> count_;   // chosen sets that hold an item
  std::vector<std::uint32_t> holder_;  // exclusive or of them: their only one where count_ is 1
  std::vector<std::uint32_t> gain_;
  std::vector<std::uint32_t> alone_;  // one more than there are sets, for what is given
  std::vector<std::uint8_t> is_chosen_;
  std::size_t covered_ = 0;
};

}  // namespace gnbv
