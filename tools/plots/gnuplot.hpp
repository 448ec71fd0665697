// Pictures by gnuplot, which is given its script and data on stdin and no file name at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gnbv {

enum class PlotFormat { svg, png, pdf };

/// A width of 1512 pixels is one column of a paper: 3.5 inches at 432 dots an inch, with letters of
/// 6 to 7 points. Letters and lines grow with the width.
struct PlotSize {
  int width_px = 1512;
  int height_px = 0;  // 0: what the plot asks for
};

/// A picture to be drawn.
struct Plot {
  std::string name;      // of its file, without extension
  std::string body;      // of its script: sets titles and data and plots
  int height_px = 1050;  // when it is 1512 wide
};

/// The text as a string of gnuplot's language that means nothing but itself: in single quotes,
/// control characters as blanks, bytes that are no UTF-8 as the replacement character. Expects that
/// enhanced text is off, as plot_script() has it.
std::string gnuplot_text(std::string_view text);

/// A whole script: terminal, style, body. It prints the picture to stdout.
std::string plot_script(const Plot& plot, PlotFormat format, const PlotSize& size);

/// Draws it; the picture appears by rename. Throws BadInput when gnuplot is not installed, naming
/// its package, or when the path cannot be written; BrokenInvariant with gnuplot's words when it
/// does not accept the script.
void draw_plot(const std::string& script, const std::filesystem::path& picture);

}  // namespace gnbv
