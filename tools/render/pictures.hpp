// Pictures of runs: the table of their kinds, and how they become images.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "tools/render/panel_layout.hpp"

namespace gnbv {

std::span<const PictureKind* const> picture_kinds();

/// Throws BadInput naming all kinds.
const PictureKind& picture_kind(std::string_view name);

/// The options with what the ends of the colours stand for in all of those runs, so that a colour
/// means the same in each picture. Runs that lack what it takes are left out.
PictureOptions with_shared_colours(const PictureKind& kind, std::span<RunSource* const> runs,
                                   PictureOptions options);

/// The options with one direction for the second panels of all of those runs, so that pictures in a
/// row can be compared. `view` is that of the first panels.
PictureOptions with_shared_angles(const PictureKind& kind, std::span<RunSource* const> runs,
                                  PictureOptions options, const RenderView& view);

/// An image, and the words that belong on it.
struct DrawnPicture {
  Image image;
  Caption caption;
  RenderView view;  // where the scale is true
  bool has_caption = true;
};

/// One picture of one run. Throws BadInput as Renderer does, and for what the run lacks.
DrawnPicture draw_without_words(const PictureKind& kind, RunSource& run,
                                const PictureOptions& options, const PanelLayout& layout,
                                Renderer& renderer);
Image with_words(const DrawnPicture& drawn);

/// Both at once.
Image draw_picture(const PictureKind& kind, RunSource& run, const PictureOptions& options,
                   const PanelLayout& layout, Renderer& renderer);

/// An image of a picture that is already there.
Image draw_picture(const Picture& picture, const RunSource& run, const PictureOptions& options,
                   const PanelLayout& layout, Renderer& renderer);

/// The same as the cells of a sheet with so many columns: titles begin with (a), (b), ..., and a
/// legend that the cells of a row have in common stands on the last of them.
std::vector<Image> sheet_cells(std::vector<DrawnPicture> drawn, int columns);

/// Images of one size on one sheet, `columns` of them in each row; an empty one leaves its place
/// white. Requires one that is not empty.
Image contact_sheet(std::span<const Image> images, int columns);

}  // namespace gnbv
