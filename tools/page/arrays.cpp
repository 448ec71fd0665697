#include "tools/page/arrays.hpp"

#include <algorithm>
#include <cmath>

namespace gnbv::page {

std::size_t Arrays::append(const void* data, std::size_t size) {
  constexpr std::size_t kAligned = sizeof(double);
  const std::size_t at = (bytes_.size() + kAligned - 1) / kAligned * kAligned;
  bytes_.resize(at + size);
  if (size > 0) std::memcpy(bytes_.data() + at, data, size);
  return at;
}

Points Arrays::add_points(std::span<const Vec3f> points_m) {
  Eigen::AlignedBox3f box;
  for (const Vec3f& p : points_m) box.extend(p);
  std::vector<std::uint16_t> steps;
  steps.reserve(3 * points_m.size());
  for (const Vec3f& p : points_m) {
    for (int axis = 0; axis < 3; ++axis) {
      const float size_m = box.sizes()[axis];
      const float share = size_m > 0.0F ? (p[axis] - box.min()[axis]) / size_m : 0.0F;
      const float step = std::round(std::clamp(share, 0.0F, 1.0F) * 65535.0F);
      steps.push_back(static_cast<std::uint16_t>(step));
    }
  }
  Points out{.at = append(steps.data(), sizeof(std::uint16_t) * steps.size()),
             .rows = points_m.size()};
  for (std::size_t axis = 0; axis < 3 && !points_m.empty(); ++axis) {
    out.min_m[axis] = box.min()[static_cast<Eigen::Index>(axis)];
    out.size_m[axis] = box.sizes()[static_cast<Eigen::Index>(axis)];
  }
  return out;
}

Numbers Arrays::add_numbers(std::span<const std::uint32_t> numbers) {
  std::vector<std::uint8_t> coded;
  for (std::uint32_t number : numbers) {
    for (; number >= 128; number >>= 7U) coded.push_back(static_cast<std::uint8_t>(number | 128U));
    coded.push_back(static_cast<std::uint8_t>(number));
  }
  return {append(coded.data(), coded.size()), numbers.size()};
}

}  // namespace gnbv::page
