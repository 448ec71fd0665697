// Colours of the pictures: linear light inside, sRGB at the border.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/srgb.hpp"

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

/// Order along a path: dark violet to orange, monotone in lightness, never as light as the paper
/// white of the background.
inline std::vector<Rgb> path_colours() {
  return {srgb(0x2b0f8a), srgb(0x6a0fb0), srgb(0xa3209c),
          srgb(0xd03b76), srgb(0xee6a45), srgb(0xf9a01f)};
}
inline Rgb path_ramp(double t) {
  static const std::vector<Rgb> colours = path_colours();
  return ramp(colours, t);
}

/// Amounts: viridis (van der Walt and Smith, CC0), even in lightness and safe for colour-blind
/// eyes, without its lightest end.
inline std::vector<Rgb> amount_colours() {
  return {srgb(0x440154), srgb(0x472d7b), srgb(0x3b528b), srgb(0x2c728e),
          srgb(0x21918c), srgb(0x28ae80), srgb(0x5ec962), srgb(0xaddc30)};
}
inline Rgb amount_ramp(double t) {
  static const std::vector<Rgb> colours = amount_colours();
  return ramp(colours, t);
}

}  // namespace gnbv
