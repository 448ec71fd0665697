// How pictures of runs become images, alone and on sheets.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/render/caption.hpp"
#include "tools/render/panel_layout.hpp"
#include "tools/render/renderer.hpp"

namespace gnbv {

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
