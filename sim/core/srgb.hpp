// sRGB (IEC 61966-2-1): its bytes, and the way to linear light, one channel in [0, 1] each.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace gnbv {

using Rgb8 = std::array<std::uint8_t, 3>;  // red, green, blue as in an image file

inline float srgb_to_linear(float s) {
  return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
}

inline float linear_to_srgb(float l) {
  return l <= 0.0031308F ? 12.92F * l : 1.055F * std::pow(l, 1.0F / 2.4F) - 0.055F;
}

}  // namespace gnbv
