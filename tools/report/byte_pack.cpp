#include "tools/report/byte_pack.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace gnbv {

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  std::size_t out = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;  // 24 bits, the missing ones 0
    for (std::size_t k = 0; k < 3; ++k) three = three << 8U | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k <= count; ++k) text[out + k] = kDigits[three >> (18 - 6 * k) & 63U];
    out += 4;
  }
  return text;
}

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
