// Many samples over time as something that can be read.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gnbv {

/// The samples of a flight: in each row the time and then the values.
class Traces {
 public:
  explicit Traces(std::vector<std::vector<double>> rows);

  /// The blocks `samples`, the rows as they are, and of a long flight `bands`: in each of some even
  /// steps of time its middle, and of each value the lowest, the mean and the highest.
  std::string data() const;
  /// The entries of a plot command for those values, each in the palette's next colour: a line, or
  /// of a long flight the mean of each step on a band from its lowest to its highest.
  std::string drawn(std::size_t first, std::size_t last) const;
  /// Lowest and highest of those values.
  std::pair<double, double> range(std::size_t first, std::size_t last) const;
  /// Of the axis: "mission time (s)"; of a long flight, what its bands are, too: "; bands: extremes
  /// in 6 s".
  std::string time_label() const;

 private:
  std::vector<std::vector<double>> rows_, bands_;
  double step_s_ = 0.0;
};

}  // namespace gnbv
