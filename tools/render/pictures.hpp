// Pictures of runs: the table of their kinds, and how they become images.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "tools/render/picture.hpp"

namespace gnbv {

std::span<const PictureKind* const> picture_kinds();

/// Throws BadInput naming all kinds.
const PictureKind& picture_kind(std::string_view name);

/// How a picture of several panels lays them out: all of one size, row by row.
struct PanelLayout {
  int columns = 1;
  int rows = 1;
  RenderView view;  // of each panel
};

/// The one camera for that kind of picture of all those runs: of the options, or the nearest one
/// that shows everything that has to be seen in any of them. Of the layouts of several panels, the
/// one that shows it largest.
PanelLayout lay_out(const PictureKind& kind, std::span<RunSource* const> runs,
                    const PictureOptions& options);

/// One image of one run. Throws BadInput as Renderer does, and for what the run lacks.
Image draw_picture(const PictureKind& kind, RunSource& run, const PictureOptions& options,
                   const PanelLayout& layout, Renderer& renderer);

/// An image of a picture that is already there.
Image draw_picture(const Picture& picture, const RunSource& run, const PictureOptions& options,
                   const PanelLayout& layout, Renderer& renderer);

/// Images of one size on one sheet, `columns` of them in each row; an empty one leaves its place
/// white. Requires one that is not empty.
Image contact_sheet(std::span<const Image> images, int columns);

}  // namespace gnbv
