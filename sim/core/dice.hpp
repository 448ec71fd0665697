// What chance decides about one structure.
#pragma once

#include <algorithm>
#include <cstdint>

#include "sim/core/rng.hpp"

namespace gnbv {

/// Numbers 0, 1, 2, ... of one structure, keyed by its seed and by which of the seed's structures
/// it is. A value: whoever copies it draws the same again.
class Draws {
 public:
  explicit Draws(std::uint64_t seed, std::uint64_t structure = 0)
      : seed_(seed), structure_(structure) {}

  double real(double low, double high) { return low + (high - low) * next(); }
  /// From `low` to `high`, both included.
  int whole(int low, int high) {
    return std::min(high, low + static_cast<int>(next() * (high - low + 1)));
  }
  bool chance(double probability) { return next() < probability; }

 private:
  double next() { return uniform01({seed_, Stream::random_structure, structure_, index_++}); }

  std::uint64_t seed_, structure_, index_ = 0;
};

}  // namespace gnbv
