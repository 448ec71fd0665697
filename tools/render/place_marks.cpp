// Lines and words of a panel that lie over its scene.
#include <algorithm>
#include <cmath>

#include "tools/render/caption.hpp"

namespace gnbv {
namespace {

constexpr double kLetter = 10.0;
constexpr double kBadge = 17.0;
constexpr Rgb8 kWhite = {255, 255, 255};

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
