// Figures as files: drawn by Python, and their data beside them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tools/figures/figure.hpp"

namespace gnbv {

/// A width of 1512 pixels is one column of a paper: 3.5 inches at 432 dots an inch, with letters of
/// 7.5 points. Letters and lines grow with the width.
struct FigureStyle {
  int width_px = 1512;
  int height_px = 0;      // 0: what each figure asks for
  std::string font = {};  // by name, or a file; empty: DejaVu Sans
};

/// A figure, and the file it goes to, whose extension (.svg, .png, .pdf) says how it is written.
struct FigureTarget {
  const Figure* figure = nullptr;
  std::filesystem::path path;
};

/// Draws them in `python3`, or what GNBV_PYTHON names, with matplotlib; each appears by rename, and
/// the same figures give the same bytes. Throws BadInput with the line that installs matplotlib
/// where it is missing, or with what went wrong.
void draw_to_files(std::span<const FigureTarget> files, const FigureStyle& style = {});

/// What was written, in order: FOLDER/NAME.EXTENSION of each figure for each of the extensions svg,
/// png and pdf, its NAME.csv, and FOLDER/figures.json where "json" is among them.
std::vector<std::filesystem::path> write_figures(std::span<const Figure> figures,
                                                 std::span<const std::string> extensions,
                                                 const FigureStyle& style,
                                                 const std::filesystem::path& folder);

}  // namespace gnbv
