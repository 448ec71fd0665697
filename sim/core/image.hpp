// Pictures, 8-bit sRGB (IEC 61966-2-1) and 16-bit grey, and their PNG files.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "sim/core/file.hpp"

namespace gnbv {

using Rgb8 = std::array<std::uint8_t, 3>;  // red, green, blue

/// One channel in [0, 1], to linear light and back.
inline float srgb_to_linear(float s) {
  return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
}
inline float linear_to_srgb(float l) {
  return l <= 0.0031308F ? 12.92F * l : 1.055F * std::pow(l, 1.0F / 2.4F) - 0.055F;
}
inline std::uint8_t srgb_byte(float linear) {
  return static_cast<std::uint8_t>(std::lround(255.0F * linear_to_srgb(linear)));
}

/// srgb_byte() by a table, of any number: up to half a level off.
class SrgbTable {
 public:
  SrgbTable() {
    for (std::size_t i = 0; i <= kSteps; ++i) bytes_[i] = srgb_byte(static_cast<float>(i) / kSteps);
  }
  std::uint8_t operator()(float linear) const {
    return bytes_[static_cast<std::size_t>(std::lround(std::clamp(linear, 0.0F, 1.0F) * kSteps))];
  }

 private:
  static constexpr int kSteps = 4096;
  std::array<std::uint8_t, kSteps + 1> bytes_{};
};

/// RGB8, sRGB-encoded, rows from top to bottom without padding.
struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;  // (height, width, 3)

  Rgb8 at(int x, int y) const {
    const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                               static_cast<std::size_t>(x));
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

/// 16 bits a pixel, linear: depth in millimetres.
struct GreyImage16 {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint16_t> values;  // (height, width)
};

/// By write_file_atomically(), and throw as it does.
void write_png(const Image& image, const std::filesystem::path& path,
               Lasting lasting = Lasting::power_failures);
void write_png(const GreyImage16& image, const std::filesystem::path& path,
               Lasting lasting = Lasting::power_failures);

/// Any PNG as RGB8. Throws BadInput naming the path.
Image read_png(const std::filesystem::path& path);

/// A PNG of 16 grey bits a pixel, values as they are. Throws BadInput naming the path.
GreyImage16 read_png_grey16(const std::filesystem::path& path);

}  // namespace gnbv
