// Points in a block of bytes.
#pragma once

#include <span>

#include "tools/report/byte_pack.hpp"

namespace gnbv {

struct PackedPoints {
  Vec3f min_m = Vec3f::Zero();
  Vec3f size_m = Vec3f::Zero();
  ByteSlice steps;  // uint16 (n, 3), see QuantisedPoints
};

inline PackedPoints pack_points(std::span<const Vec3f> points_m, BytePack& bytes) {
  const QuantisedPoints q = quantised(points_m);
  return {.min_m = q.min_m, .size_m = q.size_m, .steps = bytes.add(q.steps)};
}

}  // namespace gnbv
