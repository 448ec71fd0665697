// One line of the speed table: ours against a reference, on the same input, in the same run.
#pragma once

#include <string>

namespace gnbv {

struct SpeedRow {
  std::string name;
  double ours = 0.0;
  double reference = 0.0;
  std::string unit;        // of both
  double ratio = 0.0;      // reference / ours
  bool identical = false;  // whether both gave the same answer
  double target = 0.0;     // the ratio aimed for
};

}  // namespace gnbv
