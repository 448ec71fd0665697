// One line of the table of speeds.
#pragma once

#include <string>

namespace gnbv {

struct SpeedRow {
  std::string name;
  double ours;
  double reference;
  std::string unit;
  double ratio;  // reference / ours
  bool identical;
  double target;
};

}  // namespace gnbv
