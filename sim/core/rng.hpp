// Random numbers by key: the same key gives the same number, in any order and on any number of
// threads.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace gnbv {

/// One name a use, so that no two uses share a number.
enum class Stream : std::uint64_t {
  start_pose = 1,
  depth_noise = 2,
  range_noise = 3,
  bench = 4,
  pose_noise = 5,
  lateral_noise = 6,
  random_view = 7,
  surface_sample = 9,
  cover_search = 10,
  random_structure = 11,
  gust = 12,
  dropped_frame = 13,
  tour_search = 20,
  area_sample = 21,
  near_point = 22,
};

struct RandomKey {
  std::uint64_t seed = 0;
  Stream stream = Stream::start_pose;
  std::uint64_t frame = 0;
  std::uint64_t index = 0;
};

/// Finaliser of SplitMix64 (Steele, Lea, Flood 2014), a bijection.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

constexpr std::uint64_t random_bits(const RandomKey& key) {
  std::uint64_t h = mix_bits(key.seed);
  h = mix_bits(h ^ static_cast<std::uint64_t>(key.stream));
  h = mix_bits(h ^ key.frame);
  return mix_bits(h ^ key.index);
}

/// Uniform in [0, 1).
constexpr double uniform01(const RandomKey& key) {
  return static_cast<double>(random_bits(key) >> 11) * 0x1.0p-53;
}

/// Standard normal by Box and Muller, from two numbers that no other key shares.
inline double standard_normal(const RandomKey& key) {
  const std::uint64_t h = random_bits(key);
  const double u = (static_cast<double>(h >> 11) + 1.0) * 0x1.0p-53;  // (0, 1]
  const double v = static_cast<double>(mix_bits(h) >> 11) * 0x1.0p-53;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

/// Draws numbers 0, 1, 2, ... of a seed, a stream and a frame `of` it (a structure, an iteration).
/// A copy draws the same numbers again. Never draw twice in one argument list: the compiler chooses
/// which draw comes first.
class Rng {
 public:
  Rng(std::uint64_t seed, Stream stream, int of)
      : next_{seed, stream, static_cast<std::uint64_t>(of), 0} {}

  /// In [0, 1).
  double uniform() { return uniform01(take()); }
  double real(double low, double high) { return low + (high - low) * uniform(); }
  /// From `low` to `high`, both included.
  int whole(int low, int high) {
    return std::min(high, low + static_cast<int>(uniform() * (high - low + 1)));
  }
  bool chance(double probability) { return uniform() < probability; }
  /// In [0, count).
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(random_bits(take()) % count);
  }

 private:
  RandomKey take() {
    const RandomKey key = next_;
    ++next_.index;
    return key;
  }

  RandomKey next_;
};

}  // namespace gnbv
