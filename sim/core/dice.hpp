// Numbers that are drawn one after the other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "sim/core/rng.hpp"

namespace gnbv {

/// Numbers 0, 1, 2, ... of a seed, a stream and one of the things in it: a structure, an iteration.
/// A value: whoever copies it draws the same again. Never two draws in one argument list: which is
/// the first would be the compiler's choice.
class Dice {
 public:
  Dice(std::uint64_t seed, Stream stream, int of)
      : seed_(seed), stream_(stream), of_(static_cast<std::uint64_t>(of)) {}

  /// In [0, 1).
  double uniform() { return uniform01(next()); }
  double real(double low, double high) { return low + (high - low) * uniform(); }
  /// From `low` to `high`, both included.
  int whole(int low, int high) {
    return std::min(high, low + static_cast<int>(uniform() * (high - low + 1)));
  }
  bool chance(double probability) { return uniform() < probability; }
  /// In [0, count).
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(random_bits(next()) % count);
  }

 private:
  RandomKey next() { return {seed_, stream_, of_, drawn_++}; }

  std::uint64_t seed_;
  Stream stream_;
  std::uint64_t of_;
  std::uint64_t drawn_ = 0;
};

}  // namespace gnbv
