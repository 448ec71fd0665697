#include "tools/render/pictures.hpp"

#include <algorithm>
#include <array>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::array<const PictureKind*, 7> kKinds = {
    &kPathPicture,   &kProfilePicture,    &kCloudPicture, &kCoveragePicture,
    &kVoxelsPicture, &kCandidatesPicture, &kPlanPicture};

bool has_caption(const PictureOptions& options) {
  return options.has_caption && fits_caption(options.width_px, options.height_px);
}

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

// What a panel leaves free for the words on the whole picture.
FrameMargins margins_of(const PictureKind& kind, const PictureOptions& options,
                        const PanelLayout& layout) {
  if (!has_caption(options)) return {};
  FrameMargins margins = caption_margins(options.width_px, options.height_px, kind.legend_rows);
  if (kind.panels > 1) {  // a note over each panel, the title over the first row's
    const double u = layout_unit_px(options.width_px, options.height_px);
    margins.top = 116.0 * u / layout.view.height_px;
    margins.bottom *= static_cast<double>(options.height_px) / layout.view.height_px;
  }
  return margins;
}

bool leaves_room(const FrameMargins& margins) {
  return margins.left + margins.right < 1.0 && margins.top + margins.bottom < 1.0;
}

// Whether something that has to be seen lies behind the title.
bool meets_title(const RenderView& view, const std::vector<Vec3>& points_world_m) {
  const double u = layout_unit_px(view.width_px, view.height_px);
  return std::any_of(points_world_m.begin(), points_world_m.end(), [&](const Vec3& p_world_m) {
    const std::optional<Vec3> p = project(view, p_world_m);
    return p && p->x() < 520.0 * u && p->y() < 78.0 * u;
  });
}

RenderView frame(const PictureOptions& options, const std::vector<Vec3>& points_world_m,
                 const FrameMargins& margins, int width_px, int height_px) {
  RenderView view = frame_points(points_world_m, options.angles, width_px, height_px, margins);
  if (has_caption(options) && meets_title(view, points_world_m)) {
    FrameMargins below = margins;
    below.top = std::max(margins.top, 82.0 * layout_unit_px(width_px, height_px) / height_px);
    if (leaves_room(below)) {
      view = frame_points(points_world_m, options.angles, width_px, height_px, below);
    }
  }
  if (!options.camera) return view;
  view.T_world_camera = options.camera->T_world_camera;
  view.fov_y_rad = options.camera->fov_y_rad;
  view.focus_m = options.camera->focus_m;
  view.to_light_world = options.camera->to_light_world;
  return view;
}

}  // namespace

std::span<const PictureKind* const> picture_kinds() { return kKinds; }

const PictureKind& picture_kind(std::string_view name) {
  std::string names;
  for (const PictureKind* kind : kKinds) {
    if (kind->name == name) return *kind;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", kind->name);
  }
  throw BadInput(fmt::format("--what {}: no such picture; there are {}, snapshots, movie and all",
                             name, names));
}

PanelLayout lay_out(const PictureKind& kind, std::span<RunSource* const> runs,
                    const PictureOptions& options) {
  std::vector<Vec3> points;
  for (RunSource* const run : runs) kind.frame(*run, options, points);
  std::optional<PanelLayout> best;
  for (int columns = 1; columns <= kind.panels; ++columns) {
    PanelLayout layout{
        .columns = columns, .rows = (kind.panels + columns - 1) / columns, .view = {}};
    layout.view.width_px = (options.width_px + columns - 1) / columns;
    layout.view.height_px = (options.height_px + layout.rows - 1) / layout.rows;
    const FrameMargins margins = margins_of(kind, options, layout);
    if (!leaves_room(margins)) continue;
    layout.view = frame(options, points, margins, layout.view.width_px, layout.view.height_px);
    const bool is_larger = !best || px_per_m_at_focus(layout.view) > px_per_m_at_focus(best->view);
    if (is_larger) best = layout;
  }
  GNBV_CHECK(best.has_value(), "{} px: one row of panels is as high as the picture",
             options.height_px);
  return *best;
}

PictureOptions with_shared_colours(const PictureKind& kind, std::span<RunSource* const> runs,
                                   PictureOptions options) {
  if (kind.colour_range == nullptr || options.colour_range) return options;
  const PictureOptions alone = options;
  for (RunSource* const run : runs) {
    try {
      const std::array<double, 2> own = kind.colour_range(*run, alone);
      const std::array<double, 2> all = options.colour_range.value_or(own);
      options.colour_range = {std::min(all[0], own[0]), std::max(all[1], own[1])};
    } catch (const BadInput&) {  // of what the run lacks; its picture will say so
    }
  }
  return options;
}

namespace {

void draw_labels(const Panel& panel, const RenderView& view, double u, Image& image) {
  for (const PlaceLabel& label : panel.labels) {
    const std::optional<Vec3> p = project(view, label.p_world_m);
    if (!p) continue;
    draw_text(image, label.text, p->x() + 7.0 * u, p->y() - 5.0 * u, 10.0 * u, kInk, 2.5 * u);
  }
}

/// A quarter of the width, framed, in the upper right corner: each pixel the mean of those it
/// covers.
void draw_inset(const Image& inset, double u, Image& image) {
  const int width = image.width_px / 4;
  const int height = width * inset.height_px / std::max(1, inset.width_px);
  const int x0 = image.width_px - width - static_cast<int>(18.0 * u);
  const int y0 = static_cast<int>(18.0 * u);
  if (x0 < 0 || y0 + height > image.height_px) return;
  draw_box(image, {x0 - 2.0 * u, y0 - 2.0 * u}, {x0 + width + 2.0 * u, y0 + height + 2.0 * u},
           {255, 255, 255}, 1.0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int left = x * inset.width_px / width;
      const int right = std::max(left + 1, (x + 1) * inset.width_px / width);
      const int top = y * inset.height_px / height;
      const int bottom = std::max(top + 1, (y + 1) * inset.height_px / height);
      std::array<int, 3> sum{};
      for (int v = top; v < bottom; ++v) {
        for (int h = left; h < right; ++h) {
          for (std::size_t k = 0; k < 3; ++k) sum[k] += inset.at(h, v)[k];
        }
      }
      const int count = (right - left) * (bottom - top);
      for (std::size_t k = 0; k < 3; ++k) {
        image.rgb[3 * (static_cast<std::size_t>(y0 + y) * static_cast<std::size_t>(image.width_px) +
                       static_cast<std::size_t>(x0 + x)) +
                  k] = static_cast<std::uint8_t>(sum[k] / count);
      }
    }
  }
}

DrawnPicture drawn(const Picture& picture, const RunSource& run, const PictureOptions& options,
                   const PanelLayout& layout, Renderer& renderer) {
  const double u = layout_unit_px(options.width_px, options.height_px);
  Image image = blank(options.width_px, options.height_px);
  for (std::size_t i = 0; i < picture.panels.size(); ++i) {
    const int x = static_cast<int>(i) % layout.columns * layout.view.width_px;
    const int y = static_cast<int>(i) / layout.columns * layout.view.height_px;
    const RenderView& view = picture.panels[i].view ? *picture.panels[i].view : layout.view;
    Image panel = renderer.render(picture.panels[i].scene, view);
    if (has_caption(options)) {
      draw_labels(picture.panels[i], view, u, panel);
      const double x_note = 26.0 * u;
      const double height =
          fitting_height_px(picture.panels[i].note, 11.0 * u, panel.width_px - 1.5 * x_note);
      draw_text(panel, picture.panels[i].note, x_note, 92.0 * u, height, kInk, 2.5 * u);
    }
    if (x > 0) draw_line(panel, {0.0, 0.0}, {0.0, 1.0 * panel.height_px}, 3.0 * u, {255, 255, 255});
    if (y > 0) draw_line(panel, {0.0, 0.0}, {1.0 * panel.width_px, 0.0}, 3.0 * u, {255, 255, 255});
    paste(panel, x, y, image);
  }
  if (!picture.inset.rgb.empty()) draw_inset(picture.inset, u, image);
  return {.image = std::move(image),
          .caption = {.title = options.title.empty() ? run_title(run.record()) : options.title,
                      .detail = picture.detail,
                      .legend = picture.legend},
          .view = layout.view,
          .has_caption = has_caption(options)};
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

DrawnPicture draw_without_words(const PictureKind& kind, RunSource& run,
                                const PictureOptions& options, const PanelLayout& layout,
                                Renderer& renderer) {
  return drawn(kind.draw(run, options, layout.view), run, options, layout, renderer);
}

Image with_words(const DrawnPicture& drawn) {
  Image image = drawn.image;
  if (drawn.has_caption) draw_caption(image, drawn.caption, drawn.view);
  return image;
}

Image draw_picture(const PictureKind& kind, RunSource& run, const PictureOptions& options,
                   const PanelLayout& layout, Renderer& renderer) {
  return with_words(draw_without_words(kind, run, options, layout, renderer));
}

Image draw_picture(const Picture& picture, const RunSource& run, const PictureOptions& options,
                   const PanelLayout& layout, Renderer& renderer) {
  return with_words(drawn(picture, run, options, layout, renderer));
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
    cells.push_back(with_words(drawn[i]));
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
