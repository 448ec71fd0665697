#include "tools/render/pictures.hpp"

#include <algorithm>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

// What lies beyond the right and the lower border is cut off.
void paste(const Image& image, int x, int y, Image& onto) {
  const int columns = std::min(image.width_px, onto.width_px - x);
  for (int row = 0; row < std::min(image.height_px, onto.height_px - y); ++row) {
    const auto from = image.rgb.begin() + 3 * static_cast<std::ptrdiff_t>(row) * image.width_px;
    std::copy_n(from, 3 * columns,
                onto.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y + row) * onto.width_px + x));
  }
}

Image blank(int width_px, int height_px) {
  Image image{width_px, height_px, {}};
  image.rgb.assign(3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px),
                   255);
  return image;
}

/// A quarter of the width, framed, in the upper right corner, with words below it where there are
/// any: each pixel the mean of those it covers.
void draw_inset(const Image& inset, const std::string& words, int top_px, double u, Image& image) {
  const int width = static_cast<int>(kInsetShare * image.width_px);
  const int height = width * inset.height_px / std::max(1, inset.width_px);
  const int x0 = image.width_px - width - static_cast<int>(kInsetBorder * u);
  const int y0 = top_px + static_cast<int>(kInsetBorder * u);
  if (x0 < 0 || y0 + height > image.height_px) return;
  const double below = words.empty() ? 2.0 : kInsetWords;
  draw_box(image, {x0 - 2.0 * u, y0 - 2.0 * u}, {x0 + width + 2.0 * u, y0 + height + below * u},
           {255, 255, 255}, 1.0);
  const double letter_px = fitting_height_px(words, 10.0 * u, width - 12.0 * u);
  draw_text(image, words, x0 + 6.0 * u, y0 + height + 16.0 * u, letter_px, kInk);
  const auto covered = [](int px, int size_px, int of_px) {  // the first, and the one past the last
    const int first = px * of_px / size_px;
    return std::pair{first, std::max(first + 1, (px + 1) * of_px / size_px)};
  };
  Image small = blank(width, height);
  for (std::size_t i = 0; i < small.rgb.size(); ++i) {
    const int pixel = static_cast<int>(i / 3);
    const auto [left, right] = covered(pixel % width, width, inset.width_px);
    const auto [top, bottom] = covered(pixel / width, height, inset.height_px);
    int sum = 0;
    for (int v = top; v < bottom; ++v) {
      for (int h = left; h < right; ++h) sum += inset.at(h, v)[i % 3];
    }
    small.rgb[i] = static_cast<std::uint8_t>(sum / ((right - left) * (bottom - top)));
  }
  paste(small, x0, y0, image);
}

/// That of the first panel where the two are nearly as large: a longer one would say otherwise.
double scale_of_panel_m(const RenderView& view, const RenderView& first) {
  constexpr double kNearly = 1.6;
  const double ratio = px_per_m_at_focus(view) / px_per_m_at_focus(first);
  const bool is_alike = ratio < kNearly && ratio > 1.0 / kNearly;
  return scale_length_m(is_alike ? first : view);
}

/// A panel in its place, with its words where the picture has any.
void draw_panel(const Panel& panel, std::size_t i, const PictureOptions& options,
                const PanelLayout& layout, Renderer& renderer, Image& image) {
  const double u = unit_px(options);
  const RenderView& view = panel.view ? *panel.view : layout.view;
  const auto [x, y] = layout.place_px(i);
  Image drawn = renderer.render(panel.scene, view);
  draw_place_marks(panel, view, u, has_words(options), drawn);
  // the others are seen as the first is, unless they say so
  if (has_words(options) && (i == 0 || panel.view)) {
    draw_scale(drawn, view, u, scale_of_panel_m(view, layout.view));
  }
  paste(drawn, x, y, image);
  if (layout.note_px == 0) return;
  const double height =
      fitting_height_px(panel.note, 11.0 * u, view.width_px - 2.0 * kCaptionBorder * u);
  draw_text(image, panel.note, x + kCaptionBorder * u, y - 8.0 * u, height, kInk);
}

/// (a), (b), ... (z), (aa), ...
std::string letter_of(std::size_t i) {
  std::string letters(1, static_cast<char>('a' + i % 26));
  for (i /= 26; i > 0; i = (i - 1) / 26) {
    letters.insert(letters.begin(), static_cast<char>('a' + (i - 1) % 26));
  }
  return "(" + letters + ")";
}

}  // namespace

DrawnPicture draw_without_words(const Picture& picture, const std::string& title,
                                const PictureOptions& options, const PanelLayout& layout,
                                Renderer& renderer) {
  Image image = blank(options.width_px, options.height_px);
  for (std::size_t i = 0; i < picture.panels.size(); ++i) {
    draw_panel(picture.panels[i], i, options, layout, renderer, image);
  }
  if (!picture.inset.rgb.empty()) {
    draw_inset(picture.inset, has_words(options) ? picture.inset_words : "", layout.head_px,
               unit_px(options), image);
  }
  return {.image = std::move(image),
          .caption = {.title = title,
                      .detail = picture.detail,
                      .legend = picture.legend,
                      .letters = options.letters,
                      .paper_px = layout.foot_px},
          .has_caption = has_words(options)};
}

Image with_words(const DrawnPicture& drawn) {
  Image image = drawn.image;
  if (drawn.has_caption) draw_caption(image, drawn.caption);
  return image;
}

std::string title_of(const RunSource& run, const PictureOptions& options) {
  return options.title.empty() ? run_title(run.record()) : options.title;
}

Image draw_picture(const Picture& picture, const RunSource& run, const PictureOptions& options,
                   const PanelLayout& layout, Renderer& renderer) {
  return with_words(draw_without_words(picture, title_of(run, options), options, layout, renderer));
}

Image draw_picture(const PictureKind& kind, RunSource& run, const PictureOptions& options,
                   const PanelLayout& layout, Renderer& renderer) {
  return draw_picture(kind.draw(run, options, layout.view), run, options, layout, renderer);
}

std::vector<Image> sheet_cells(std::vector<DrawnPicture> drawn, int columns) {
  std::size_t letter = 0;
  std::vector<Image> cells;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn[i].image.rgb.empty()) {
      cells.emplace_back();
      continue;
    }
    Caption& caption = drawn[i].caption;
    caption.title.insert(0, letter_of(letter++) + "  ");
    const bool is_rows_last = (i + 1) % static_cast<std::size_t>(columns) == 0;
    const bool is_said_again =
        !is_rows_last && i + 1 < drawn.size() && drawn[i + 1].caption.legend == caption.legend;
    if (is_said_again) caption.legend.clear();
    Image& cell = cells.emplace_back(with_words(drawn[i]));
    if (i % static_cast<std::size_t>(columns) == 0) continue;
    // what lies at its left is another picture
    const double line_px = 6.0 * layout_unit_px(cell.width_px, cell.height_px);
    draw_box(cell, {0.0, 0.0}, {line_px, 1.0 * cell.height_px}, {255, 255, 255}, 1.0);
  }
  return cells;
}

Image contact_sheet(std::span<const Image> images, int columns) {
  const auto is_there = [](const Image& image) { return !image.rgb.empty(); };
  const auto first = std::find_if(images.begin(), images.end(), is_there);
  GNBV_CHECK(first != images.end() && columns > 0, "{} images in {} columns", images.size(),
             columns);
  const int rows = (static_cast<int>(images.size()) + columns - 1) / columns;
  const int width_px = first->width_px;
  const int height_px = first->height_px;
  Image sheet = blank(columns * width_px, rows * height_px);
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (!is_there(images[i])) continue;
    GNBV_CHECK(images[i].width_px == width_px && images[i].height_px == height_px,
               "image {} is of another size", i);
    paste(images[i], static_cast<int>(i) % columns * width_px,
          static_cast<int>(i) / columns * height_px, sheet);
  }
  return sheet;
}

}  // namespace gnbv
