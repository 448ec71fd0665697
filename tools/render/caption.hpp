// Words and plain marks on a finished picture; of them its title, figures, legend and scale, and
// what lies over a panel's places. The letters are those of the font file that the environment's
// GNBV_FONT names, else of DejaVu Sans where systems have it; without one, what draws or measures
// words throws BadInput.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "tools/scene/scene.hpp"

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

constexpr Rgb8 kInk = {38, 44, 54};

constexpr double kCaptionBorder = 26.0;  // layout units

/// Pixels of a 1280 x 720 picture, in which everything is laid out; small pictures are coarser.
double layout_unit_px(int width_px, int height_px);

struct Caption {
  std::string title;
  std::string detail;              // one line under the title
  std::vector<LegendItem> legend;  // from the upper left
  double letters = 1.0;            // of a layout unit's size
  int paper_px = 0;                // height of the legend's paper at the lower border
};

/// Title and figures at the top left, the legend in as many rows as it needs.
void draw_caption(Image& image, const Caption& caption);

/// Height (layout units) of paper for a legend that takes `rows` rows of 1280 units.
double legend_paper_height(int rows, double width);

/// The longest round length that fits the lower left of that view's picture.
double scale_length_m(const RenderView& view);

/// A length, true at the focus of the view, at the lower left of an image with such layout units.
void draw_scale(Image& image, const RenderView& view, double unit_px, double length_m);

/// Words on pale paper that begins at the first x and they at the second.
void draw_on_paper(Image& image, const std::string& words, const std::array<double, 2>& x_px,
                   double baseline_px, double unit_px);

/// The panel's lines, then its labels where `has_words`, on the picture of `view` with such layout
/// units.
void draw_place_marks(const Panel& panel, const RenderView& view, double unit_px, bool has_words,
                      Image& image);

}  // namespace gnbv
