// Many samples over time as something that can be read.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/plots/key.hpp"

namespace gnbv {

/// The samples of a flight: in each row the time and then the values.
class Traces {
 public:
  /// Bands hold so much of the samples: of 0.9, those from the 5th to the 95th in 100. Requires
  /// 0 < share <= 1, and rows.
  explicit Traces(std::vector<std::vector<double>> rows, double share = 1.0);

  /// The blocks `samples`, the rows as they are, and of a long flight `bands`: in each of some even
  /// steps of time its middle, and of each value the band's low end, the mean, the band's high end
  /// and the most.
  std::string data() const;
  /// The entries of a plot command for those values, each in the palette's next colour: a line, or
  /// of a long flight the mean of each step on its band.
  std::string drawn(std::size_t first, std::size_t last) const;
  /// The entry, with its comma, of a thin line of the most of a value in each step; nothing where
  /// the samples are drawn.
  std::string drawn_most(std::size_t value) const;
  /// Lowest and highest of what drawn() draws.
  std::pair<double, double> range(std::size_t first, std::size_t last) const;
  /// What line and band are: "mean of each 6 s", "least to most"; nothing where the samples are
  /// drawn.
  std::vector<KeyEntry> key() const;

 private:
  std::vector<double> band_row(std::size_t begin, std::size_t end, double middle_s) const;

  std::vector<std::vector<double>> rows_, bands_;
  double share_ = 1.0;
  double step_s_ = 0.0;
};

}  // namespace gnbv
