#include "tools/report/byte_pack.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv {

QuantisedPoints quantised(std::span<const Vec3f> points_m) {
  QuantisedPoints out;
  if (points_m.empty()) return out;
  Eigen::AlignedBox3f box;
  for (const Vec3f& p : points_m) box.extend(p);
  out.min_m = box.min();
  out.size_m = box.sizes();
  out.steps.reserve(3 * points_m.size());
  for (const Vec3f& p : points_m) {
    for (int axis = 0; axis < 3; ++axis) {
      const float size_m = out.size_m[axis];
      const float share = size_m > 0.0F ? (p[axis] - out.min_m[axis]) / size_m : 0.0F;
      const float step = std::round(std::clamp(share, 0.0F, 1.0F) * 65535.0F);
      out.steps.push_back(static_cast<std::uint16_t>(step));
    }
  }
  return out;
}

Vec3f restored_point(const QuantisedPoints& points, std::size_t i) {
  Vec3f p;
  for (int axis = 0; axis < 3; ++axis) {
    const auto step = points.steps[3 * i + static_cast<std::size_t>(axis)];
    p[axis] = points.min_m[axis] + points.size_m[axis] * (static_cast<float>(step) / 65535.0F);
  }
  return p;
}

}  // namespace gnbv
