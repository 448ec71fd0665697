// Colours of pictures and pages: linear light inside, sRGB at the border.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/image.hpp"

namespace gnbv {

using Rgb = std::array<float, 3>;  // linear, each in [0, 1]

/// 0xRRGGBB as a colour picker shows it.
inline Rgb srgb(std::uint32_t rrggbb) {
  const auto channel = [&](int shift) {
    return srgb_to_linear(static_cast<float>((rrggbb >> shift) & 0xffU) / 255.0F);
  };
  return {channel(16), channel(8), channel(0)};
}

/// Piecewise linear through evenly spaced colours; `t` is clamped to [0, 1].
inline Rgb ramp(std::span<const Rgb> colours, double t) {
  const double x = std::clamp(t, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(x), colours.size() - 2);
  const float f = static_cast<float>(x - static_cast<double>(i));
  Rgb out{};
  for (std::size_t k = 0; k < 3; ++k) {
    out[k] = colours[i][k] * (1.0F - f) + colours[i + 1][k] * f;
  }
  return out;
}

/// A run of colours, evenly spaced, from its low end to its high end; each 0xRRGGBB, so that pages
/// can take them over as they are.
using ColourTable = std::span<const std::uint32_t>;

/// Order along a path: dark violet to orange, monotone in lightness, never as light as the paper
/// white of the background.
inline constexpr std::array<std::uint32_t, 6> kPathTable = {0x2b0f8a, 0x6a0fb0, 0xa3209c,
                                                            0xd03b76, 0xee6a45, 0xf9a01f};

/// Amounts: viridis (van der Walt and Smith, CC0), even in lightness and safe for colour-blind
/// eyes, without its lightest end.
inline constexpr std::array<std::uint32_t, 8> kAmountTable = {
    0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c, 0x28ae80, 0x5ec962, 0xaddc30};

/// Errors: from pale, which is right, over yellow and orange to a dark red; it stands out from
/// shadows.
inline constexpr std::array<std::uint32_t, 6> kErrorTable = {0xdfe5ec, 0xf2e0a0, 0xf5b04e,
                                                             0xe2702c, 0xb5301f, 0x6d0a1c};

inline std::vector<Rgb> linear_colours(ColourTable table) {
  std::vector<Rgb> colours;
  for (const std::uint32_t rrggbb : table) colours.push_back(srgb(rrggbb));
  return colours;
}

inline const std::vector<Rgb>& path_colours() {
  static const std::vector<Rgb> colours = linear_colours(kPathTable);
  return colours;
}
inline Rgb path_ramp(double t) { return ramp(path_colours(), t); }

inline const std::vector<Rgb>& amount_colours() {
  static const std::vector<Rgb> colours = linear_colours(kAmountTable);
  return colours;
}
inline Rgb amount_ramp(double t) { return ramp(amount_colours(), t); }

inline const std::vector<Rgb>& error_colours() {
  static const std::vector<Rgb> colours = linear_colours(kErrorTable);
  return colours;
}

/// Of candidates' utilities: amounts without their ends, which colours of rejections come close to.
inline const std::vector<Rgb>& score_colours() {
  static const std::vector<Rgb> colours(amount_colours().begin() + 2, amount_colours().end() - 1);
  return colours;
}

/// What the colours of errors stand for: those of one run may be millimetres, of another ten times
/// that.
struct ErrorScale {
  double most_m = 0.001;  // of the scale of error_colours(), from 0: rounded_up_125()
  double median_m = 0.0;  // half of the errors are no larger
  double within_m = 0.0;  // and 95 % no larger than this
};

/// 95 % of the errors lie within the scale, and it ends at 1 mm at least.
ErrorScale error_scale(std::span<const double> errors_m);

}  // namespace gnbv
