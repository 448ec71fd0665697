#include "tools/render/caption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnbv {
namespace {

// all lengths here are in layout units
constexpr double kBorder = kCaptionBorder;
constexpr double kLetter = 10.0;
constexpr double kRow = 22.0;
constexpr double kBar = 120.0;
constexpr double kGap = 20.0;  // between items
constexpr double kHalo = 2.5;
constexpr double kPaperBorder = 7.0;  // above and below the legend
constexpr Rgb8 kSheet = {246, 248, 250};
constexpr double kSheetOpacity = 0.92;

// The longest of 1, 2, 5, 10 ... m that stays under `limit_m`.
double round_length_m(double limit_m) {
  const double power = std::pow(10.0, std::floor(std::log10(limit_m)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= limit_m) return step * power;
  }
  return power;
}

bool is_bar(const LegendItem& item) { return item.colours.size() > 1; }

double mark_width(const LegendItem& item) {
  if (is_bar(item)) return kBar;
  switch (item.mark) {
    case LegendItem::Mark::line:
      return 30.0;
    case LegendItem::Mark::pyramid:
      return 20.0;
    default:
      return 10.0;
  }
}

double item_width(const LegendItem& item) {
  const double before =
      item.label_before.empty() ? 0.0 : text_width_px(item.label_before, kLetter) + 10.0;
  return before + mark_width(item) + 10.0 + text_width_px(item.label, kLetter);
}

bool is_pale(const Rgb8& colour) { return *std::min_element(colour.begin(), colour.end()) > 225; }

void draw_square(Image& image, const std::array<double, 2>& middle, double half_px,
                 const Rgb8& colour) {
  for (double dy = -half_px; dy <= half_px; dy += 0.5) {
    draw_line(image, {middle[0] - half_px, middle[1] + dy}, {middle[0] + half_px, middle[1] + dy},
              1.0, colour);
  }
}

// As high as the number on it asks for, which is white on what is dark and ink on what is not.
void draw_bar(Image& image, const LegendItem& item, double x, double y, double u) {
  const double whole = kBar * u;
  const double half = (item.label_middle.empty() ? 3.0 : 8.0) * u;
  for (double at = 0.0; at < whole; at += 1.0) {
    draw_box(image, {x + at, y - half}, {x + std::min(at + 1.0, whole), y + half},
             to_rgb8(ramp(item.colours, at / whole)), 1.0);
  }
  if (item.label_middle.empty()) return;
  const Rgb middle = ramp(item.colours, 0.5);
  const double luminance = 0.2126 * middle[0] + 0.7152 * middle[1] + 0.0722 * middle[2];
  constexpr double kPale = 0.35;
  const Rgb8 ink = luminance > kPale ? kInk : Rgb8{255, 255, 255};
  const double width = text_width_px(item.label_middle, kLetter * u);
  draw_text(image, item.label_middle, x + 0.5 * (whole - width), y + 5.0 * u, kLetter * u, ink);
}

// From its apex at the left to the far side that it opens to.
void draw_pyramid(Image& image, double x, double y, double u, const Rgb8& colour) {
  const std::array<double, 2> apex = {x + 1.0 * u, y};
  const std::array<std::array<double, 2>, 4> far = {{{x + 14.0 * u, y - 7.0 * u},
                                                     {x + 19.0 * u, y - 3.0 * u},
                                                     {x + 19.0 * u, y + 7.0 * u},
                                                     {x + 14.0 * u, y + 3.0 * u}}};
  for (std::size_t i = 0; i < far.size(); ++i) {
    draw_line(image, apex, far[i], 1.5 * u, colour);
    draw_line(image, far[i], far[(i + 1) % far.size()], 1.5 * u, colour);
  }
}

void draw_mark(Image& image, const LegendItem& item, double x, double y, double u) {
  if (is_bar(item)) return draw_bar(image, item, x, y, u);
  const double end = x + mark_width(item) * u;
  const Rgb8 colour = to_rgb8(item.colours.front());
  const double middle = 0.5 * (x + end);
  switch (item.mark) {
    case LegendItem::Mark::line:
      draw_line(image, {x, y}, {end, y}, 4.0 * u, colour);
      break;
    case LegendItem::Mark::dot:
      draw_line(image, {middle, y}, {middle, y}, 10.0 * u, colour);
      break;
    case LegendItem::Mark::pyramid:
      draw_pyramid(image, x, y, u, colour);
      break;
    case LegendItem::Mark::ring:
      draw_line(image, {middle, y}, {middle, y}, 11.0 * u, colour);
      draw_line(image, {middle, y}, {middle, y}, 4.5 * u, {255, 255, 255});
      break;
    case LegendItem::Mark::square:
      // white would not show on the sheet
      draw_square(image, {middle, y}, 5.0 * u, is_pale(colour) ? kPaleInk : colour);
      draw_square(image, {middle, y}, 4.0 * u, colour);
      break;
  }
}

/// An item's place: where it begins, and the middle of its row.
struct Placed {
  const LegendItem* item;
  double x;
  double y;
};

// From the right, the last item lowest; what meets the scale goes above it.
std::vector<Placed> placed(const Image& image, const std::vector<LegendItem>& legend, double u,
                           double bottom, double left_limit) {
  std::vector<Placed> places;
  double right = image.width_px - kBorder * u;
  double y = bottom;
  bool is_row_empty = true;
  for (std::size_t i = legend.size(); i-- > 0;) {
    const double width = item_width(legend[i]) * u;
    const double limit = y == bottom ? left_limit + kGap * u : kBorder * u;
    const bool may_move = !is_row_empty || y == bottom;
    if (may_move && right - width < limit) {
      right = image.width_px - kBorder * u;
      y -= kRow * u;
    }
    places.push_back({&legend[i], right - width, y});
    right -= width + kGap * u;
    is_row_empty = false;
  }
  return places;
}

// From the left, the first item highest, in the middle of the paper; where it is too low for all
// rows, the first ones lie above it.
std::vector<Placed> placed_on_paper(const Image& image, const Caption& caption, double u) {
  std::vector<Placed> places;
  double x = kBorder * u;
  double y = 0.0;
  for (const LegendItem& item : caption.legend) {
    const double width = item_width(item) * u;
    const bool is_full = x + width > image.width_px - kBorder * u;
    if (!places.empty() && (item.begins_row || is_full)) {
      x = kBorder * u;
      y += kRow * u;
    }
    places.push_back({&item, x, y});
    x += width + kGap * u;
  }
  const double middle = image.height_px - 0.5 * caption.paper_px - 0.5 * y;
  const double lowest = image.height_px - (kPaperBorder + 0.5 * kRow) * u - y;
  for (Placed& place : places) place.y += std::min(middle, lowest);
  return places;
}

void draw_items(Image& image, const std::vector<Placed>& places, double u) {
  for (const auto& [item, x_begin, y] : places) {
    double x = x_begin;
    if (!item->label_before.empty()) {
      x = draw_text(image, item->label_before, x, y + 5.0 * u, kLetter * u, kInk) + 10.0 * u;
    }
    draw_mark(image, *item, x, y, u);
    draw_text(image, item->label, x + (mark_width(*item) + 10.0) * u, y + 5.0 * u, kLetter * u,
              kInk);
  }
}

// On paper of its own: what lies behind it would be read as part of it.
void draw_legend(Image& image, const std::vector<Placed>& places, double u) {
  const double right = image.width_px - (kBorder - 12.0) * u;
  for (std::size_t i = 0; i < places.size(); ++i) {  // the last of a row is the leftmost
    if (i + 1 < places.size() && places[i + 1].y == places[i].y) continue;
    const double y = places[i].y;
    draw_box(image, {places[i].x - 12.0 * u, y - 0.5 * kRow * u}, {right, y + 0.5 * kRow * u},
             kSheet, kSheetOpacity);
  }
  draw_items(image, places, u);
}

void draw_legend_on_paper(Image& image, const Caption& caption, double u) {
  const std::vector<Placed> places = placed_on_paper(image, caption, u);
  if (places.empty()) return;
  const double top = std::min<double>(image.height_px - caption.paper_px,
                                      places.front().y - (0.5 * kRow + kPaperBorder) * u);
  draw_box(image, {0.0, top}, {1.0 * image.width_px, 1.0 * image.height_px}, {255, 255, 255}, 1.0);
  draw_items(image, places, u);
}

}  // namespace

double layout_unit_px(int width_px, int height_px) {
  return std::max(0.7, std::min(width_px / 1280.0, height_px / 720.0));
}

bool fits_caption(int width_px, int height_px) { return width_px >= 320 && height_px >= 240; }

FrameMargins caption_margins(int width_px, int height_px, double unit_px, int legend_rows) {
  const double u = unit_px / height_px;
  const double rows = std::ceil(legend_rows * std::max(1.0, 1280.0 * unit_px / width_px) - 0.01);
  // the title fills a corner that wide pictures leave free anyway
  const bool is_wide = 3 * width_px > 4 * height_px;
  FrameMargins margins;
  margins.top = (is_wide ? 34.0 : 82.0) * u;
  margins.bottom = (32.0 + kRow * rows) * u;
  return margins;
}

double legend_paper_height(int rows, double width) {
  return kRow * std::ceil(rows * std::max(1.0, 1280.0 / width)) + 2.0 * kPaperBorder;
}

double scale_length_m(const RenderView& view) {
  return round_length_m(0.16 * view.width_px / px_per_m_at_focus(view));
}

double draw_scale(Image& image, const RenderView& view, double u, double length_m) {
  const double bottom = image.height_px - 24.0 * u;
  const double px_per_m = px_per_m_at_focus(view);
  const double x0 = kBorder * u;
  const double x1 = x0 + length_m * px_per_m;
  constexpr Rgb8 kPaper = {228, 231, 235};  // a halo, as that of the words
  for (const auto& [colour, width] : {std::pair{kPaper, 2.0 + 2.0 * kHalo}, {kInk, 2.0}}) {
    draw_line(image, {x0, bottom}, {x1, bottom}, width * u, colour);
    for (const double x : {x0, x1}) {
      draw_line(image, {x, bottom - 5.0 * u}, {x, bottom + 5.0 * u}, width * u, colour);
    }
  }
  return draw_text(image, fmt::format("{} m at mid-depth", length_m), x1 + 10.0 * u,
                   bottom + 5.0 * u, kLetter * u, kInk, kHalo * u);
}

double px_per_m_at_focus(const RenderView& view) {
  return 0.5 * view.height_px / std::tan(0.5 * view.fov_y_rad) / view.focus_m;
}

void draw_caption(Image& image, const Caption& caption, const RenderView& view) {
  const double u = caption.letters * layout_unit_px(image.width_px, image.height_px);
  const double width = image.width_px - 2.0 * kBorder * u;
  const double halo = caption.paper_px > 0 || caption.has_sheet ? 0.0 : kHalo * u;
  const double title_px = fitting_height_px(caption.title, 15.0 * u, width);
  const double detail_px = fitting_height_px(caption.detail, kLetter * u, width);
  if (caption.has_sheet) {
    const double longest_px =
        std::max(text_width_px(caption.title, title_px), text_width_px(caption.detail, detail_px));
    draw_box(image, {(kBorder - 12.0) * u, 16.0 * u}, {(kBorder + 12.0) * u + longest_px, 76.0 * u},
             kSheet, kSheetOpacity);
  }
  draw_text(image, caption.title, kBorder * u, 40.0 * u, title_px, kInk, halo);
  draw_text(image, caption.detail, kBorder * u, 64.0 * u, detail_px, kPaleInk, halo);
  if (caption.paper_px > 0) return draw_legend_on_paper(image, caption, u);
  const double scale_end =
      caption.has_scale ? draw_scale(image, view, u, scale_length_m(view)) : 0.0;
  draw_legend(image, placed(image, caption.legend, u, image.height_px - 24.0 * u, scale_end), u);
}

}  // namespace gnbv
