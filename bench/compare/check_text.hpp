// What a regression gate found, for people and programs.
#pragma once

#include <string>

#include "bench/compare/baseline.hpp"

namespace gnbv {

/// A row a metric that is not within its tolerance, then how many are.
std::string check_text(const Baseline& baseline, const BaselineCheck& check);

/// All of it, schema gnbv-check-1.
std::string check_json(const Baseline& baseline, const BaselineCheck& check);

}  // namespace gnbv
