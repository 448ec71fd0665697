// Greedy set cover, lazily: which set to take next, each gain asked for only when it may decide.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnbv {

/// Takes sets until nothing is left to gain; at unit costs never more than ln(largest set) + 1
/// times as many as needed (Chvatal 1979). A gain only falls as items are taken, so that the last
/// known one bounds it, and most need not be counted again (Minoux 1978): the choices are those of
/// the plain greedy algorithm.
class LazyGreedy {
 public:
  /// Keeps the pointers to the sets, which hold items in [0, items), each once.
  LazyGreedy(std::vector<const std::vector<std::uint32_t>*> sets, std::size_t items);

  /// The set with the most gain per cost, the first of equals; nothing when none gains. One cost a
  /// set, all positive.
  std::optional<std::size_t> best(std::span<const double> costs);

  /// The items are there now, whatever set they came from; how many were new.
  std::size_t take(std::span<const std::uint32_t> items);

 private:
  std::size_t gain(std::size_t set) const;

  std::vector<const std::vector<std::uint32_t>*> sets_;
  std::vector<std::uint8_t> is_taken_;
  std::vector<std::size_t> known_gain_;
};

}  // namespace gnbv
