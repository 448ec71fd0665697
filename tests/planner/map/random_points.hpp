// Random numbers of the map tests; the seed is in the test, so a failure repeats.
#pragma once

#include <vector>

#include "sim/core/pose.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {

class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * uniform01({seed_, Stream::bench, 0, next_++});
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  Vec3f point_in(const Box3& box_m) {
    Vec3f p_m;
    for (int a = 0; a < 3; ++a) {
      p_m[a] = static_cast<float>(uniform(box_m.min()[a], box_m.max()[a]));
    }
    return p_m;
  }

 private:
  std::uint64_t seed_;
  std::uint64_t next_ = 0;
};

/// A bumpy sheet a metre wide near the origin with some clutter: several points a leaf, and all
/// neighbour distances.
inline std::vector<Vec3f> random_sheet(Random& random, const Box3& box_m, int count) {
  std::vector<Vec3f> points;
  const Vec3f corner_m = random.point_in(Box3(Vec3(-2, -2, 0.2), Vec3(1, 1, 1.2)));
  for (int i = 0; i < count; ++i) {
    Vec3f p_m = corner_m + random.point_in(Box3(Vec3::Zero(), Vec3(1.0, 1.0, 0.03)));
    if (random.chance(0.2)) p_m = random.point_in(box_m);
    points.push_back(p_m);
  }
  return points;
}

}  // namespace gnbv
