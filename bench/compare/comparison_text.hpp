// A comparison in words and as a table.
#pragma once

#include <string>
#include <vector>

#include "bench/compare/comparison.hpp"
#include "bench/compare/text_table.hpp"

namespace gnbv {

/// One line a scenario and method other than the baseline: what it covers at 0.05 m and how far it
/// flies against the baseline, with intervals, p values and what they allow to say.
std::vector<std::string> answers(const Comparison& comparison);

/// A row per scenario, metric and method, then the ranks over all scenarios if there are several.
/// The answers are the first notes; the others say what the columns are.
TextTable comparison_table(const Comparison& comparison);

}  // namespace gnbv
