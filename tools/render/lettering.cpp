#include "tools/render/lettering.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnbv {
namespace {

using Point = std::array<double, 2>;
using Stroke = std::vector<Point>;

// Strokes of each glyph from ' ' to '~', apart by spaces; a stroke is a chain of points, two digits
// x, y each. Baseline y = 3, small letters end at 7, capitals at 9, descenders at 1. With '~'
// before it, a chain is the control polygon of a quadratic B-spline that starts and ends in its
// ends.
constexpr std::array<std::string_view, 95> kGlyphs = {
    "",                                  // space
    "0905 0303",                         // !
    "0907 2927",                         // "
    "1218 3238 0747 0343",               // #
    "~5859090656530304 2921",            // $
    "~190907272919 ~453533535545 0359",  // %
    "~5507182939280403235355",           // &
    "0907",                              // '
    "~29080422",                         // (
    "~09282402",                         // )
    "2824 0745 0547",                    // *
    "0646 2824",                         // +
    "1302",                              // ,
    "0636",                              // -
    "0303",                              // .
    "0239",                              // /
    "~294943030929",                     // 0
    "082923",                            // 1
    "~0809494603 0343",                  // 2
    "~0809494626 ~2646430304",           // 3
    "33390545",                          // 4
    "490906 ~061747430304",              // 5
    "~274743030727 ~050939",             // 6
    "094913",                            // 7
    "~294946060929 ~264643030626",       // 8
    "~294945050929 ~474313",             // 9
    "0303 0707",                         // :
    "1302 1717",                         // ;
    "480644",                            // <
    "0747 0545",                         // =
    "084604",                            // >
    "~080949462625 2323",                // ?
    "~575547363744454656585909030353",   // @
    "033963 1555",                       // A
    "0309 ~092949462606 ~062656532303",  // B
    "~584909034354",                     // C
    "0309 ~092959532303",                // D
    "49090343 0636",                     // E
    "490903 0636",                       // F
    "~584909035356 5636",                // G
    "0309 4943 0646",                    // H
    "0309",                              // I
    "~3935330305",                       // J
    "0309 4905 1643",                    // K
    "090343",                            // L
    "0309346963",                        // M
    "03094349",                          // N
    "~295953030929",                     // O
    "0309 ~092959562606",                // P
    "~295953030929 3552",                // Q
    "0309 ~092959562606 2653",           // R
    "~5859090656530304",                 // S
    "0949 2923",                         // T
    "~090503535559",                     // U
    "092349",                            // V
    "0923496389",                        // W
    "0943 0349",                         // X
    "092649 2623",                       // Y
    "09490343",                          // Z
    "29090222",                          // [
    "0932",                              // backslash
    "09292202",                          // ]
    "072947",                            // ^
    "0242",                              // _
    "0918",                              // `
    "~454707034345 4743",                // a
    "0903 ~050747430305",                // b
    "~464707034344",                     // c
    "4943 ~454707034345",                // d
    "0545 ~454707034344",                // e
    "~3919171513 0727",                  // f
    "~454707034345 ~4743410102",         // g
    "0903 ~0507474543",                  // h
    "0703 0909",                         // i
    "~27232101 2929",                    // j
    "0903 3704 1533",                    // k
    "0903",                              // l
    "0703 ~0507373533 ~3537676563",      // m
    "0703 ~0507474543",                  // n
    "~274743030727",                     // o
    "0701 ~050747430305",                // p
    "4741 ~454707034345",                // q
    "0703 ~050737",                      // r
    "~4647070545430304",                 // s
    "~19151333 0727",                    // t
    "~0705034345 4743",                  // u
    "072347",                            // v
    "0723364367",                        // w
    "0743 0347",                         // x
    "0723 4711",                         // y
    "07470343",                          // z
    "~292918051222 2222",                // {
    "0902",                              // |
    "~090918251202 0202",                // }
    "~05172546",                         // ~
};
constexpr double kCap = 6.0;  // height of a capital in glyph units
constexpr double kGap = 1.7;  // between glyphs
constexpr double kSpace = 2.4;
constexpr double kPenOfHeight = 0.115;

std::string_view glyph(char c) {
  const auto i = static_cast<std::size_t>(static_cast<unsigned char>(c));
  return kGlyphs[i >= 32 && i < 127 ? i - 32 : '?' - 32];
}

// A quadratic B-spline runs from midpoint to midpoint of its control polygon.
Stroke smooth(const Stroke& control) {
  Stroke out = {control.front()};
  const auto middle = [](const Point& a, const Point& b) {
    return Point{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  };
  for (std::size_t i = 1; i + 1 < control.size(); ++i) {
    const Point a = i == 1 ? control[0] : middle(control[i - 1], control[i]);
    const Point c = i + 2 == control.size() ? control[i + 1] : middle(control[i], control[i + 1]);
    for (int k = 1; k <= 6; ++k) {
      const double t = k / 6.0;
      Point p{};
      for (std::size_t d = 0; d < 2; ++d) {
        p[d] = (1 - t) * (1 - t) * a[d] + 2 * t * (1 - t) * control[i][d] + t * t * c[d];
      }
      out.push_back(p);
    }
  }
  return out;
}

// In glyph units, x from 0, y up from the baseline.
// One a code point: of UTF-8, bytes that go on with one count for nothing.
std::vector<std::string_view> glyphs(std::string_view text) {
  std::vector<std::string_view> codes;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xc0U) != 0x80U) codes.push_back(glyph(c));
  }
  return codes;
}

std::vector<Stroke> strokes_of(std::string_view code) {
  std::vector<Stroke> strokes;
  while (!code.empty()) {
    const std::size_t end = std::min(code.find(' '), code.size());
    std::string_view chain = code.substr(0, end);
    code.remove_prefix(std::min(end + 1, code.size()));
    const bool is_smooth = chain.front() == '~';
    if (is_smooth) chain.remove_prefix(1);
    Stroke stroke;
    for (std::size_t i = 0; i + 1 < chain.size(); i += 2) {
      stroke.push_back(
          {static_cast<double>(chain[i] - '0'), static_cast<double>(chain[i + 1] - '3')});
    }
    strokes.push_back(is_smooth ? smooth(stroke) : stroke);
  }
  return strokes;
}

double width_of(std::string_view code) {
  if (code.empty()) return kSpace;
  double width = 0.0;
  for (const Stroke& stroke : strokes_of(code)) {
    for (const Point& p : stroke) width = std::max(width, p[0]);
  }
  return width;
}

double distance(const Point& p, const Point& a, const Point& b) {
  const double dx = b[0] - a[0];
  const double dy = b[1] - a[1];
  const double dd = dx * dx + dy * dy;
  const double t =
      dd > 0.0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / dd, 0.0, 1.0) : 0.0;
  return std::hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
}

// Paints all strokes at once, so that crossings are not painted twice.
void paint(Image& image, const std::vector<Stroke>& strokes, double width_px, const Rgb8& colour) {
  const double reach = 0.5 * width_px + 1.0;
  double x0 = 1e9, y0 = 1e9, x1 = -1e9, y1 = -1e9;
  for (const Stroke& stroke : strokes) {
    for (const Point& p : stroke) {
      x0 = std::min(x0, p[0] - reach), x1 = std::max(x1, p[0] + reach);
      y0 = std::min(y0, p[1] - reach), y1 = std::max(y1, p[1] + reach);
    }
  }
  const int left = static_cast<int>(std::clamp(x0, 0.0, 1.0 * image.width_px));
  const int right = static_cast<int>(std::clamp(x1 + 1.0, 0.0, 1.0 * image.width_px));
  const int top = static_cast<int>(std::clamp(y0, 0.0, 1.0 * image.height_px));
  const int bottom = static_cast<int>(std::clamp(y1 + 1.0, 0.0, 1.0 * image.height_px));
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const Point centre = {x + 0.5, y + 0.5};
      double nearest = reach;
      for (const Stroke& stroke : strokes) {
        for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
          nearest = std::min(nearest, distance(centre, stroke[i], stroke[i + 1]));
        }
      }
      const double cover = std::clamp(0.5 * width_px - nearest + 0.5, 0.0, 1.0);
      if (cover <= 0.0) continue;
      std::uint8_t* pixel = image.rgb.data() + 3 * (static_cast<std::size_t>(y) *
                                                        static_cast<std::size_t>(image.width_px) +
                                                    static_cast<std::size_t>(x));
      for (std::size_t k = 0; k < 3; ++k) {
        pixel[k] =
            static_cast<std::uint8_t>(std::lround((1.0 - cover) * pixel[k] + cover * colour[k]));
      }
    }
  }
}

}  // namespace

Rgb8 to_rgb8(const Rgb& linear) {
  Rgb8 out{};
  for (std::size_t k = 0; k < 3; ++k) {
    out[k] = static_cast<std::uint8_t>(
        std::lround(255.0F * linear_to_srgb(std::clamp(linear[k], 0.0F, 1.0F))));
  }
  return out;
}

void draw_line(Image& image, const std::array<double, 2>& from_px,
               const std::array<double, 2>& to_px, double width_px, const Rgb8& colour) {
  paint(image, {{from_px, to_px}}, width_px, colour);
}

double draw_text(Image& image, std::string_view text, double x_px, double baseline_px,
                 double height_px, const Rgb8& colour, double halo_px) {
  constexpr Rgb8 kHalo = {228, 231, 235};
  const double unit_px = height_px / kCap;
  const double pen_px = std::max(1.2, kPenOfHeight * height_px);
  double end = x_px;
  // the whole halo first: it must not cover the letter before
  for (const bool is_halo : {true, false}) {
    if (is_halo && halo_px <= 0.0) continue;
    double x = x_px;
    for (const std::string_view code : glyphs(text)) {
      std::vector<Stroke> strokes = strokes_of(code);
      for (Stroke& stroke : strokes) {
        for (Point& p : stroke) p = {x + unit_px * p[0], baseline_px - unit_px * p[1]};
      }
      paint(image, strokes, is_halo ? pen_px + 2.0 * halo_px : pen_px, is_halo ? kHalo : colour);
      x += unit_px * (width_of(code) + kGap);
    }
    end = x;
  }
  return end;
}

double text_width_px(std::string_view text, double height_px) {
  double units = 0.0;
  for (const std::string_view code : glyphs(text)) units += width_of(code) + kGap;
  return units * height_px / kCap;
}

double fitting_height_px(std::string_view text, double height_px, double width_px) {
  return std::min(height_px, height_px * std::max(width_px, 0.0) / text_width_px(text, height_px));
}

}  // namespace gnbv
