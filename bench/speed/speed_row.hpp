// One line of the speed table: ours against a reference, on the same input, in the same run.
#pragma once

#include <string>

namespace gnbv {

struct SpeedRow {
  std::string name;
  double ours = 0.0;
  double reference = 0.0;
  std::string unit;        // of both
  double ratio = 0.0;      // reference / ours; with is_limit ours / reference
  bool identical = false;  // whether both gave the same answer
  double target = 0.0;     // the ratio aimed for; 0: none
  bool is_limit = false;   // the ratio is to stay below the target instead of above
};

}  // namespace gnbv
