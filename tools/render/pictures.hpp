// How pictures of runs become images: where the panels of one lie and from where they are seen; and
// how they are drawn, alone and on sheets.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tools/render/caption.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/renderer.hpp"

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

/// An image, and the words that belong on it.
struct DrawnPicture {
  Image image = {};
  Caption caption = {};
  bool has_caption = true;
};

/// A picture's panels, scales and notes, and its inset. Throws BadInput as Renderer does.
DrawnPicture draw_without_words(const Picture& picture, const std::string& title,
                                const PictureOptions& options, const PanelLayout& layout,
                                Renderer& renderer);
Image with_words(const DrawnPicture& drawn);

/// Both at once, under the title that was asked for or the run's.
Image draw_picture(const Picture& picture, const RunSource& run, const PictureOptions& options,
                   const PanelLayout& layout, Renderer& renderer);

/// One picture of one run. Throws BadInput for what the run lacks.
Image draw_picture(const PictureKind& kind, RunSource& run, const PictureOptions& options,
                   const PanelLayout& layout, Renderer& renderer);

/// The title that was asked for, or else the run's.
std::string title_of(const RunSource& run, const PictureOptions& options);

/// Finished pictures as the cells of a sheet with so many columns: titles begin with (a), (b), ...,
/// and a legend that the cells of a row have in common stands on the last of them.
std::vector<Image> sheet_cells(std::vector<DrawnPicture> drawn, int columns);

/// Images of one size on one sheet, `columns` of them in each row; an empty one leaves its place
/// white. Requires one that is not empty.
Image contact_sheet(std::span<const Image> images, int columns);

}  // namespace gnbv
