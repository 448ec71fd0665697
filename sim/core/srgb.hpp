// Between linear light and sRGB (IEC 61966-2-1), one channel in [0, 1] each.
#pragma once

#include <cmath>

namespace gnbv {

inline float srgb_to_linear(float s) {
  return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
}

inline float linear_to_srgb(float l) {
  return l <= 0.0031308F ? 12.92F * l : 1.055F * std::pow(l, 1.0F / 2.4F) - 0.055F;
}

}  // namespace gnbv
