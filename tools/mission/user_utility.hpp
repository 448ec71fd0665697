// Own utilities run in a Python of their own, a child process that is asked once a decision.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/guided/utility.hpp"
#include "scenarios/load.hpp"

namespace gnbv {

/// Whether `--utility TEXT` names a function in a file: FILE.py, or FILE.py:FUNCTION.
bool is_utility_file(std::string_view utility);

struct NamedUtility {
  std::string label;  // as utility_label()
  std::vector<Override> overrides;
};

/// The settings that `--utility TEXT` stands for. A file is read; without a FUNCTION its last one
/// at the top level is meant. Throws BadInput naming a file that cannot be read or defines no such
/// function.
NamedUtility named_utility(const std::string& utility);

/// Scores by the function: starts $GNBV_PYTHON, or python3, which needs NumPy. Throws BadInput when
/// that fails or the source does not define the function. Nothing for utilities of the program. The
/// function ends with the thread that starts it, so who asks is to be who started.
UserScores start_user_utility(const UtilityConfig& config);

/// The same, started with the first question.
UserScores lazy_user_utility(const UtilityConfig& config);

}  // namespace gnbv
