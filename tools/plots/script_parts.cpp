#include "tools/plots/script_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "tools/plots/gnuplot.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kPhaseColour = "#dcebf5";
constexpr double kTop = 0.87;      // of the uppermost panel, as a share of the picture
constexpr double kBottom = 0.135;  // of the lowest
constexpr double kGap = 0.045;

}  // namespace

std::string data_block(std::string_view name, const std::vector<std::vector<double>>& rows) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (const auto& row : rows) {
    fmt::format_to(std::back_inserter(text), "{}\n", fmt::join(row, " "));
  }
  return text + "EOD\n";
}

std::string shaded_phases(const std::vector<Phase>& phases) {
  std::string text = "unset object\n";
  for (const Phase& phase : phases) {
    text += fmt::format(
        "set object rectangle from {},graph 0 to {},graph 1 behind fc rgb '{}' fs solid noborder\n",
        phase.first - 0.5, phase.last + 0.5, kPhaseColour);
  }
  return text;
}

std::string key_of_phases(const std::vector<Phase>& phases) {
  if (phases.empty()) return "";
  return fmt::format(", keyentry with boxes fs solid noborder fc rgb '{}' title 'frontier views'",
                     kPhaseColour);
}

Panels::Panels(std::size_t count, std::string_view title, std::string_view x_label)
    : count_(count), title_(title), x_label_(x_label) {}

std::string Panels::next(std::string_view y_label) {
  const double height =
      (kTop - kBottom - kGap * static_cast<double>(count_ - 1)) / static_cast<double>(count_);
  const double top = kTop - static_cast<double>(drawn_) * (height + kGap);
  const bool is_last = drawn_ + 1 == count_;
  std::string text;
  if (drawn_ == 0) {
    text += fmt::format(
        "set multiplot\nset lmargin at screen 0.17\nset rmargin at screen 0.975\n"
        "set label 1 {} at screen 0.02,0.965 left textcolor rgb '#262c36'\n",
        gnuplot_text(title_));
  } else {
    text += "unset label 1\n";
  }
  text += fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n", top,
                      top - height);
  text += fmt::format("set ylabel {} offset 0.6,0\n", gnuplot_text(y_label));
  text += is_last ? fmt::format("set format x '%g'\nset xlabel {}\n", gnuplot_text(x_label_))
                  : "set format x ''\nunset xlabel\n";
  drawn_ += 1;
  return text;
}

}  // namespace gnbv
