#include "tools/render/place_marks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnbv {
namespace {

constexpr double kLetter = 10.0;
constexpr Rgb8 kWhite = {255, 255, 255};

using Place = std::array<double, 2>;  // px

double away_px(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

void draw_place_line(const PlaceLine& line, const RenderView& view, double u, Image& image) {
  constexpr double kEdge = 1.2;
  const std::optional<Vec3> from = project(view, line.from_world_m);
  const std::optional<Vec3> to = project(view, line.to_world_m);
  if (!from || !to) return;
  for (const auto& [colour, more] : {std::pair{kWhite, 2.0 * kEdge}, {line.colour, 0.0}}) {
    draw_line(image, {from->x(), from->y()}, {to->x(), to->y()}, (line.width + more) * u, colour);
  }
}

void draw_badge(const std::string& text, const Rgb8& badge, const Place& at, double u,
                Image& image) {
  const double width_px = text_width_px(text, kLetter * u);
  const double half_px = std::max(0.0, 0.5 * width_px - 3.5 * u);
  for (const auto& [colour, more] : {std::pair{kWhite, 3.0}, {badge, 0.0}}) {
    draw_line(image, {at[0] - half_px, at[1]}, {at[0] + half_px, at[1]}, (17.0 + more) * u, colour);
  }
  draw_text(image, text, at[0] - 0.5 * width_px, at[1] + 0.5 * kLetter * u, kLetter * u, kWhite);
}

/// Beside a place, in the direction that leaves the most room to all that is taken.
Place aside_of(const Place& place, const std::vector<Place>& taken, double u, const Image& image) {
  constexpr double kAside = 34.0;
  constexpr double kEnough = 60.0;
  constexpr int kDirections = 16;
  Place best = place;
  double best_room = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < kDirections; ++i) {
    const double angle_rad = 2.0 * kPi * i / kDirections;
    const Place at = {place[0] + kAside * u * std::cos(angle_rad),
                      place[1] - kAside * u * std::sin(angle_rad)};
    double room = std::min({at[0], at[1], image.width_px - at[0], image.height_px - at[1]});
    for (const Place& other : taken) room = std::min(room, away_px(at, other));
    room = std::min(room, kEnough * u);
    if (room <= best_room) continue;
    best_room = room;
    best = at;
  }
  return best;
}

void draw_aside(const PlaceLabel& label, const Place& place, const Place& at, double u,
                Image& image) {
  for (const auto& [colour, more] : {std::pair{kWhite, 2.0}, {*label.badge, 0.0}}) {
    draw_line(image, place, at, (1.4 + more) * u, colour);
    draw_line(image, place, place, (5.0 + more) * u, colour);
  }
  draw_badge(label.text, *label.badge, at, u, image);
}

void draw_words(const std::string& text, const Place& place, double u, Image& image) {
  const double width_px = text_width_px(text, kLetter * u);
  const double beside_px = 12.0 * u;
  const bool has_room = place[0] + beside_px + width_px < image.width_px;
  const double x = has_room ? place[0] + beside_px : place[0] - beside_px - width_px;
  draw_text(image, text, x, place[1] - 5.0 * u, kLetter * u, kInk, 2.5 * u);
}

}  // namespace

void draw_place_marks(const Panel& panel, const RenderView& view, double unit_px, bool has_words,
                      Image& image) {
  std::vector<Place> taken;
  for (const PlaceLine& line : panel.lines) {
    draw_place_line(line, view, unit_px, image);
    for (const Vec3& end_m : {line.from_world_m, line.to_world_m}) {
      if (const auto px = project(view, end_m)) taken.push_back({px->x(), px->y()});
    }
  }
  if (!has_words) return;
  for (const PlaceLabel& label : panel.labels) {
    const std::optional<Vec3> px = project(view, label.p_world_m);
    if (!px) continue;
    const Place place = {px->x(), px->y()};
    if (!label.badge) {
      draw_words(label.text, place, unit_px, image);
    } else if (!label.is_aside) {
      draw_badge(label.text, *label.badge, place, unit_px, image);
    } else {
      const Place at = aside_of(place, taken, unit_px, image);
      taken.push_back(at);
      draw_aside(label, place, at, unit_px, image);
    }
  }
}

}  // namespace gnbv
