// coverage.csv: how much of the structure had been covered after each view.
#pragma once

#include <filesystem>
#include <string>

#include "bench/score/run_figures.hpp"

namespace gnbv {

/// A row an entry of the curve. Numbers are written so that they read back exactly.
std::string coverage_csv(const CoverageCurve& curve);

/// Throws BadInput naming file and line of whatever is damaged.
CoverageCurve read_coverage_csv(const std::filesystem::path& file);

}  // namespace gnbv
