// What explains the marks of a plot. Laid out here: gnuplot's own key goes by the widths that each
// terminal takes letters for, and differs from format to format.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gnbv {

constexpr std::string_view kPlotInk = "#262c36";
constexpr std::string_view kPlotGrey = "#5c6470";

/// A mark and what it stands for: a square of the colour, or a line, a point, or both.
struct KeyEntry {
  std::string_view colour;
  std::string text;
  double line = 0.0;  // its width; 0: none
  std::string_view dashes = "1";
  int point = 0;          // gnuplot's number; 0: none
  bool has_band = false;  // a square, and what lies behind a line, as pale as a band
};

/// A colour "#rrggbb" on white, so much of it in [0, 1].
std::string tint(std::string_view colour, double share);

/// How wide a text is, as a share of the picture's width, in the wider ones of the usual fonts.
double text_width(std::string_view text);

/// A key in one row that ends at the right edge of the panels.
std::string key_row(const std::vector<KeyEntry>& key, double screen_y);

constexpr int kOnePanel_px = 1050;  // the height of a picture of one panel, 1512 wide
constexpr int kKeyLine_px = 60;
constexpr int kTitle_px = 54;  // from the top to the middle of a title

constexpr int kKeyRow_px = 66;  // from there to the first row of a key, and on to the next

/// The rows that a key takes as wide as a picture.
std::vector<std::vector<KeyEntry>> key_rows(const std::vector<KeyEntry>& key);
/// Such a key below the title. Its numbers of labels and arrows are not those of key_row().
std::string left_key(const std::vector<KeyEntry>& key, double height_px);

/// The title of a picture that is so high, where all plots have it; nothing where it is empty.
std::string title_label(std::string_view title, double height_px);

/// Settings of a plot of one panel: its title at the upper left and below that its key, an entry a
/// line. The picture is height_with_key_px() high.
std::string key_above(std::string_view title, const std::vector<KeyEntry>& key);
int height_with_key_px(std::string_view title, std::size_t entries);

}  // namespace gnbv
