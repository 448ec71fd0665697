// coverage.csv: how much of the structure had been covered after each view.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/score/run_figures.hpp"

namespace gnbv {

/// A row an entry of the curve, a column a size: the paper's three, then the others; the same of
/// accurate coverage, energy_wh and one_battery (1 or 0), where the curve has them. Numbers are
/// written so that they read back exactly.
std::string coverage_csv(const CoverageCurve& curve, std::span<const SizedCoverage> more = {});

struct CoverageFile {
  CoverageCurve curve;
  std::vector<std::string> more_names;           // as size_name() has them
  std::vector<std::vector<double>> more_curves;  // of each
  std::vector<std::vector<double>> more_accurate;
};

/// Throws BadInput naming file and line of whatever is damaged.
CoverageFile read_coverage_csv(const std::filesystem::path& file);

}  // namespace gnbv
