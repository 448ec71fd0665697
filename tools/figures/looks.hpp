// Colours, dashes and marks by which methods are told apart.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnbv {

/// Okabe and Ito's colours, which people with colour blindness tell apart (2008); darkest first.
constexpr std::array<std::string_view, 7> kPalette = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                      "#e69f00", "#56b4e9", "#000000"};
constexpr std::string_view kPlotInk = "#262c36";
constexpr std::string_view kPlotGrey = "#5c6470";

struct SeriesLook {
  std::string colour = std::string(kPlotInk);
  std::vector<double> dashes = {};  // on, off, ... in line widths; empty: solid
  std::string marker = "circle";    // where the series ends, and of points
};

/// Of each method a number of its own, the same in whatever company: the paper's three, the tour,
/// the oracles and the released code have theirs. Methods that are not known, and those whose
/// number is taken, get the first ones that are left.
std::vector<std::size_t> method_slots(std::span<const std::string> methods);

/// The look of a number: colour and dashes together are its own for 35 methods, and neighbours
/// differ in both, so that curves that lie on each other both show.
SeriesLook look_of_slot(std::size_t slot);

/// The looks of methods, by their numbers.
std::vector<SeriesLook> method_looks(std::span<const std::string> methods);

}  // namespace gnbv
