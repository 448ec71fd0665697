// Words and plain marks on a finished picture. The letters are those of the font file that the
// environment's GNBV_FONT names, else of DejaVu Sans where systems have it; without one, what draws
// or measures words throws BadInput.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "sim/core/image.hpp"
#include "tools/scene/colour.hpp"

namespace gnbv {

Rgb8 to_rgb8(const Rgb& linear);

/// A round-ended line between two points (px, 0, 0 is the top left corner), `width_px` wide,
/// antialiased and clipped to the picture.
void draw_line(Image& image, const std::array<double, 2>& from_px,
               const std::array<double, 2>& to_px, double width_px, const Rgb8& colour);

/// A rectangle between two corners (px), blended over the picture and clipped to it.
void draw_box(Image& image, const std::array<double, 2>& from_px,
              const std::array<double, 2>& to_px, const Rgb8& colour, double opacity);

/// UTF-8, each code point its own letter; bytes that are none appear as the replacement character.
/// `height_px` is that of a capital. Returns the x where the text ends.
double draw_text(Image& image, std::string_view text, double x_px, double baseline_px,
                 double height_px, const Rgb8& colour);

/// Width of what draw_text() would draw.
double text_width_px(std::string_view text, double height_px);

/// `height_px`, or as much less as makes the text no wider than `width_px`.
double fitting_height_px(std::string_view text, double height_px, double width_px);

}  // namespace gnbv
