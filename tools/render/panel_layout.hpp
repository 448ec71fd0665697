// Where the panels of a picture lie, and from where they are seen.
#pragma once

#include <array>
#include <span>

#include "tools/render/picture.hpp"

namespace gnbv {

/// All panels are of one size, row by row. Words have paper of their own, which no panel reaches:
/// title and figures above all panels, where there are several a note over each, the legend below.
struct PanelLayout {
  int columns = 1;
  int rows = 1;
  RenderView view = {};  // of each panel
  int gap_px = 0;        // between columns
  int head_px = 0;       // of the paper above all panels
  int note_px = 0;       // over each panel
  int foot_px = 0;       // below all
  /// The upper left corner of the i-th panel.
  std::array<int, 2> place_px(std::size_t i) const;
};

/// What a layout has to have room for.
struct LayoutNeeds {
  int panels = 1;
  int legend_rows = 1;        // of a picture of 1280 units
  ViewAngles angles = {};     // unless others are asked for
  double inset_aspect = 0.0;  // height by width of what lies in the upper right corner; 0: nothing
};

constexpr double kInsetShare = 0.25;   // of the picture's width
constexpr double kInsetBorder = 18.0;  // layout units
constexpr double kInsetWords = 22.0;   // of the paper below it

/// The camera of the options, or the nearest one that shows all those points, clear of scale and
/// inset. Of the layouts of several panels, the one that shows them largest.
PanelLayout lay_out(std::span<const Vec3> points_world_m, const LayoutNeeds& needs,
                    const PictureOptions& options);

/// The same for one kind of picture of all those runs.
PanelLayout lay_out(const PictureKind& kind, std::span<RunSource* const> runs,
                    const PictureOptions& options);

}  // namespace gnbv
