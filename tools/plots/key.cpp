#include "tools/plots/key.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "sim/core/text.hpp"
#include "tools/plots/gnuplot.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kSquareMark = "\u25a0";
constexpr double kBandTint = 0.25;
constexpr double kKeyLeft = 0.02;   // of rows that begin there, as a share of the width
constexpr double kKeyRight = 0.98;  // of rows that end there
constexpr double kGap = 0.025;      // between entries
constexpr int kBelowKey_px = 30;

/// Of the mark, to where its text begins.
double mark_width(const KeyEntry& entry) { return entry.line > 0.0 ? 0.06 : 0.036; }

double width_of(const KeyEntry& entry) { return mark_width(entry) + text_width(entry.text) + kGap; }

/// One entry that begins at x; labels and arrows have numbers from `number` on, two each.
std::string key_entry(const KeyEntry& entry, int number, double x, double y) {
  const bool is_square = entry.line == 0.0 && entry.point == 0;
  const std::string pale = tint(entry.colour, kBandTint);
  const double end = x + mark_width(entry) - 0.012;
  std::string text;
  if (is_square) {
    text += fmt::format("set label {} '{}' at screen {:.4f},{:.4f} left textcolor rgb '{}'\n",
                        number, kSquareMark, x, y, entry.has_band ? pale : entry.colour);
  }
  const auto stroke = [&](int tag, double inset, double width, std::string_view dashes,
                          std::string_view colour) {
    text += fmt::format(
        "set arrow {} from screen {:.4f},{:.4f} to screen {:.4f},{:.4f} nohead back lw {} dt {} "
        "lc rgb '{}'\n",
        tag, x + inset, y, end - inset, y, width, dashes, colour);
  };
  if (entry.has_band && !is_square) stroke(number, 0.009, 6.0, "1", pale);
  if (entry.line > 0.0) stroke(number + 1, 0.0, entry.line, entry.dashes, entry.colour);
  if (entry.point > 0) {
    text += fmt::format(
        "set label {} '' at screen {:.4f},{:.4f} front point pt {} ps 0.5 lc rgb '{}'\n", number,
        0.5 * (x + end), y, entry.point, entry.colour);
  }
  return text + fmt::format("set label {} {} at screen {:.4f},{:.4f} left textcolor rgb '{}'\n",
                            number + 1, gnuplot_text(entry.text), x + mark_width(entry), y,
                            kPlotInk);
}

std::string row_from(const std::vector<KeyEntry>& key, int number, double x, double y) {
  std::string text;
  for (const KeyEntry& entry : key) {
    text += key_entry(entry, number, x, y);
    x += width_of(entry);
    number += 2;
  }
  return text;
}

/// From the top to the middle of the first entry of a column.
int first_entry_px(std::string_view title) { return kTitle_px + (title.empty() ? 0 : kKeyRow_px); }

}  // namespace

std::string tint(std::string_view colour, double share) {
  std::string mixed = "#";
  for (const std::size_t at : {1, 3, 5}) {
    int value = 0;
    std::from_chars(colour.data() + at, colour.data() + at + 2, value, 16);
    mixed += fmt::format("{:02x}", static_cast<int>(std::lround(255.0 - share * (255 - value))));
  }
  return mixed;
}

double text_width(std::string_view text) {
  constexpr std::u32string_view kNarrow = U" iljtfrI.,:;()[]/'|";
  constexpr std::u32string_view kWide = U"mwMW%";
  constexpr double kEm = 48.0 / 1512.0;
  double ems = 0.0;
  while (!text.empty()) {
    const char32_t code = take_code_point(text);
    ems += kNarrow.find(code) != kNarrow.npos ? 0.36 : kWide.find(code) != kWide.npos ? 0.95 : 0.62;
  }
  return kEm * ems;
}

std::string key_row(const std::vector<KeyEntry>& key, double screen_y) {
  double x = kKeyRight + kGap;
  for (const KeyEntry& entry : key) x -= width_of(entry);
  return row_from(key, 10, x, screen_y);
}

std::vector<std::vector<KeyEntry>> key_rows(const std::vector<KeyEntry>& key) {
  std::vector<std::vector<KeyEntry>> rows;
  double x = kKeyLeft;
  for (const KeyEntry& entry : key) {
    if (rows.empty() || x + width_of(entry) - kGap > kKeyRight) {
      rows.emplace_back();
      x = kKeyLeft;
    }
    rows.back().push_back(entry);
    x += width_of(entry);
  }
  return rows;
}

std::string left_key(const std::vector<KeyEntry>& key, double height_px) {
  std::string text;
  double y_px = kTitle_px;
  int number = 50;
  for (const std::vector<KeyEntry>& row : key_rows(key)) {
    y_px += kKeyRow_px;
    text += row_from(row, number, kKeyLeft, 1.0 - y_px / height_px);
    number += 2 * static_cast<int>(row.size());
  }
  return text;
}

std::string title_label(std::string_view title, double height_px) {
  if (title.empty()) return "";
  return fmt::format("set label 1 {} at screen {},{:.4f} left textcolor rgb '{}'\n",
                     gnuplot_text(title), kKeyLeft, 1.0 - kTitle_px / height_px, kPlotInk);
}

int height_with_key_px(std::string_view title, std::size_t entries) {
  return kOnePanel_px - kKeyLine_px + first_entry_px(title) - kTitle_px +
         kKeyLine_px * static_cast<int>(entries) + kBelowKey_px;
}

std::string key_above(std::string_view title, const std::vector<KeyEntry>& key) {
  const double height_px = height_with_key_px(title, key.size());
  std::string text = "unset key\n" + title_label(title, height_px);
  double y_px = first_entry_px(title);
  int number = 10;
  for (const KeyEntry& entry : key) {
    text += key_entry(entry, number, kKeyLeft, 1.0 - y_px / height_px);
    y_px += kKeyLine_px;
    number += 2;
  }
  return text + fmt::format("set tmargin at screen {:.4f}\n", 1.0 - (y_px + 22.0) / height_px);
}

}  // namespace gnbv
