// Where the panels of a picture lie, and from where they are seen.
#pragma once

#include <array>
#include <span>

#include "tools/render/picture.hpp"

namespace gnbv {

/// All panels are of one size, row by row. Words of a picture with several of them have paper of
/// their own, which no panel reaches: title and figures above them, a note over each, the legend
/// below.
struct PanelLayout {
  int columns = 1;
  int rows = 1;
  RenderView view;  // of each panel
  int gap_px = 0;   // between columns
  int head_px = 0;  // of the paper above all panels
  int note_px = 0;  // over each panel
  int foot_px = 0;  // below all
  /// The upper left corner of the i-th panel.
  std::array<int, 2> place_px(std::size_t i) const;
};

/// Metres, at the subject of one panel of a picture, of what its lines are measured in: the same
/// share of the picture's layout unit however large it is.
double panel_unit_m(const PictureOptions& options, const RenderView& panel);

/// Whether a picture shows words at all.
bool has_words(const PictureOptions& options);

/// The one camera for that kind of picture of all those runs: of the options, or the nearest one
/// that shows everything that has to be seen in any of them, clear of the words and the inset
/// wherever that can be had. Of the layouts of several panels, the one that shows it largest.
PanelLayout lay_out(const PictureKind& kind, std::span<RunSource* const> runs,
                    const PictureOptions& options);

}  // namespace gnbv
