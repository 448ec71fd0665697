// Title, figures, legend and scale of a finished picture.
#pragma once

#include <string>
#include <vector>

#include "tools/render/lettering.hpp"
#include "tools/render/view.hpp"

namespace gnbv {

constexpr Rgb8 kInk = {38, 44, 54};
constexpr Rgb8 kPaleInk = {92, 100, 112};

/// What one colour, or one run of colours, means.
struct LegendItem {
  enum class Mark { line, dot, ring, square, pyramid };
  std::string label = {};
  std::vector<Rgb> colours = {};  // one, or those of a bar from its low end to its high end
  Mark mark = Mark::square;       // of a single colour
  std::string label_before = {};  // of a bar: at its low end; of others: of the row it begins
  bool begins_row = false;        // on paper of its own
  std::string label_middle = {};  // of a bar: what its middle stands for, set upon it

  bool operator==(const LegendItem&) const = default;
};

struct Caption {
  std::string title;
  std::string detail;              // one line under the title
  std::vector<LegendItem> legend;  // from left to right
  bool has_scale = true;
  bool has_sheet = false;  // under title and detail, as the legend has one
  double letters = 1.0;    // of a layout unit's size
  /// Height of the paper below a picture of panels, where its legend has a place of its own, read
  /// from the upper left; 0: the legend lies on the picture.
  int paper_px = 0;
};

constexpr double kCaptionBorder = 26.0;  // layout units

/// Pixels of a 1280 x 720 picture, in which everything is laid out; small pictures are coarser.
double layout_unit_px(int width_px, int height_px);

/// Whether a picture is large enough for words.
bool fits_caption(int width_px, int height_px);

/// Borders that leave room for a caption in such layout units whose legend takes `legend_rows` rows
/// of 1280 of them.
FrameMargins caption_margins(int width_px, int height_px, double unit_px, int legend_rows = 1);

/// Height (layout units) of paper for a legend that takes `rows` rows of 1280 units.
double legend_paper_height(int rows, double width);

/// The longest round length that fits the lower left of that view's picture.
double scale_length_m(const RenderView& view);

/// A length, true at the focus of the view, at the lower left of an image with such layout units.
/// Returns the x where it ends.
double draw_scale(Image& image, const RenderView& view, double unit_px, double length_m);

/// Pixels a metre at the depth of the view's subject.
double px_per_m_at_focus(const RenderView& view);

/// Title and figures at the top left, the scale at the bottom left (true at the focus of `view`,
/// the middle of what is framed), the legend on a sheet at the bottom right or on its own paper, in
/// as many rows as it needs.
void draw_caption(Image& image, const Caption& caption, const RenderView& view);

}  // namespace gnbv
