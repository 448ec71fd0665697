#include "tools/render/caption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/core/text.hpp"

namespace gnbv {
namespace {

// all lengths here are in layout units
constexpr double kBorder = kCaptionBorder;
constexpr Rgb8 kPaleInk = {92, 100, 112};
constexpr Rgb8 kWhite = {255, 255, 255};
constexpr double kLetter = 10.0;
constexpr double kRow = 22.0;
constexpr double kBar = 120.0;
constexpr double kGap = 20.0;         // between items
constexpr double kPaperBorder = 7.0;  // above and below the legend

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
  const Rgb8 ink = luminance > kPale ? kInk : kWhite;
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
      draw_line(image, {middle, y}, {middle, y}, 4.5 * u, kWhite);
      break;
    case LegendItem::Mark::square:
      // white would not show on the paper
      draw_box(image, {middle - 5.0 * u, y - 5.0 * u}, {middle + 5.0 * u, y + 5.0 * u},
               is_pale(colour) ? kPaleInk : colour, 1.0);
      draw_box(image, {middle - 4.0 * u, y - 4.0 * u}, {middle + 4.0 * u, y + 4.0 * u}, colour,
               1.0);
      break;
  }
}

/// An item's place: where it begins, and the middle of its row.
struct Placed {
  const LegendItem* item;
  double x;
  double y;
};

// From the left, the first item highest, in the middle of the paper; where it is too low for all
// rows, the first ones lie above it.
std::vector<Placed> placed(const Image& image, const Caption& caption, double u) {
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

void draw_legend(Image& image, const Caption& caption, double u) {
  const std::vector<Placed> places = placed(image, caption, u);
  if (places.empty()) return;
  const double top = std::min<double>(image.height_px - caption.paper_px,
                                      places.front().y - (0.5 * kRow + kPaperBorder) * u);
  draw_box(image, {0.0, top}, {1.0 * image.width_px, 1.0 * image.height_px}, kWhite, 1.0);
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

constexpr double kBadge = 17.0;

using Place = std::array<double, 2>;  // px

void draw_place_line(const PlaceLine& line, const RenderView& view, double u, Image& image) {
  constexpr double kEdge = 1.2;
  const std::optional<Vec3> from = project(view, line.from_world_m);
  const std::optional<Vec3> to = project(view, line.to_world_m);
  if (!from || !to) return;
  for (const auto& [colour, more] : {std::pair{kWhite, 2.0 * kEdge}, {to_rgb8(line.colour), 0.0}}) {
    draw_line(image, {from->x(), from->y()}, {to->x(), to->y()}, (line.width + more) * u, colour);
  }
}

void draw_badge(const std::string& text, const Rgb8& badge, const Place& at, double u,
                Image& image) {
  const double width_px = text_width_px(text, kLetter * u);
  const double half_px = std::max(0.0, 0.5 * width_px - 3.5 * u);
  for (const auto& [colour, more] : {std::pair{kWhite, 3.0}, {badge, 0.0}}) {
    draw_line(image, {at[0] - half_px, at[1]}, {at[0] + half_px, at[1]}, (kBadge + more) * u,
              colour);
  }
  draw_text(image, text, at[0] - 0.5 * width_px, at[1] + 0.5 * kLetter * u, kLetter * u, kWhite);
}

void draw_words(const std::string& text, const Place& place, double u, Image& image) {
  const double width_px = text_width_px(text, kLetter * u);
  const double beside_px = 12.0 * u;
  const bool has_room = place[0] + beside_px + width_px < image.width_px;
  const double x = has_room ? place[0] + beside_px : place[0] - beside_px - width_px;
  draw_on_paper(image, text, {x, x}, place[1] + 0.5 * kLetter * u, u);
}

}  // namespace

double layout_unit_px(int width_px, int height_px) {
  return std::max(0.7, std::min(width_px / 1280.0, height_px / 720.0));
}

double legend_paper_height(int rows, double width) {
  return kRow * std::ceil(rows * std::max(1.0, 1280.0 / width)) + 2.0 * kPaperBorder;
}

double scale_length_m(const RenderView& view) {
  return rounded_down_125(0.16 * view.width_px / px_per_m_at_focus(view));
}

void draw_scale(Image& image, const RenderView& view, double u, double length_m) {
  const double y = image.height_px - 24.0 * u;
  const double x0 = kBorder * u;
  const double x1 = x0 + length_m * px_per_m_at_focus(view);
  draw_on_paper(image, fmt::format("{} m at mid-depth", length_m), {x0, x1 + 10.0 * u}, y + 5.0 * u,
                u);
  draw_line(image, {x0, y}, {x1, y}, 2.0 * u, kInk);
  for (const double x : {x0, x1}) {
    draw_line(image, {x, y - 5.0 * u}, {x, y + 5.0 * u}, 2.0 * u, kInk);
  }
}

void draw_on_paper(Image& image, const std::string& words, const std::array<double, 2>& x_px,
                   double baseline_px, double u) {
  const double end_px = x_px[1] + text_width_px(words, kLetter * u);
  draw_box(image, {x_px[0] - 5.0 * u, baseline_px - (kLetter + 5.0) * u},
           {end_px + 5.0 * u, baseline_px + 5.0 * u}, {240, 242, 245}, 0.8);
  draw_text(image, words, x_px[1], baseline_px, kLetter * u, kInk);
}

void draw_caption(Image& image, const Caption& caption) {
  const double u = caption.letters * layout_unit_px(image.width_px, image.height_px);
  const double width = image.width_px - 2.0 * kBorder * u;
  const double title_px = fitting_height_px(caption.title, 15.0 * u, width);
  const double detail_px = fitting_height_px(caption.detail, kLetter * u, width);
  draw_text(image, caption.title, kBorder * u, 36.0 * u, title_px, kInk);
  draw_text(image, caption.detail, kBorder * u, 60.0 * u, detail_px, kPaleInk);
  draw_legend(image, caption, u);
}

void draw_place_marks(const Panel& panel, const RenderView& view, double unit_px, bool has_words,
                      Image& image) {
  for (const PlaceLine& line : panel.lines) draw_place_line(line, view, unit_px, image);
  if (!has_words) return;
  std::vector<Place> taken;  // by badges
  for (const PlaceLabel& label : panel.labels) {
    const std::optional<Vec3> px = project(view, label.p_world_m);
    if (!px) continue;
    const Place place = {px->x(), px->y()};
    const bool is_taken = std::any_of(taken.begin(), taken.end(), [&](const Place& other) {
      return std::hypot(place[0] - other[0], place[1] - other[1]) < kBadge * unit_px;
    });
    if (!label.badge) {
      draw_words(label.text, place, unit_px, image);
    } else if (!is_taken) {
      taken.push_back(place);
      draw_badge(label.text, to_rgb8(*label.badge), place, unit_px, image);
    }
  }
}

}  // namespace gnbv
