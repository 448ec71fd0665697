// How much a view is worth. Every formula scores the same ViewStats.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/visibility.hpp"

namespace gnbv {

/// Eq. (2)'s reward for density: of sparse regions (released code, fits the text's aim) or of dense
/// ones (the formula to the letter).
enum class DensityTerm { sparse, literal };

/// The formula by name and the weights of Table 1, Scenario 1. Each formula takes what it needs.
struct UtilityConfig {
  std::string name = "proposed";
  double alpha = 10.0;
  double beta = 0.5;
  double gamma = 0.5;
  double lambda_per_m = 0.2;
  DensityTerm density_term = DensityTerm::sparse;
};

/// A value with the terms it is made of. Terms that a formula lacks are 0, the distance factor 1.
struct Score {
  double value = 0.0;
  double information = 0.0;  // E hat of Eq. (2), or nat along rays
  double density = 0.0;      // D hat
  double prediction = 0.0;   // P hat
  double distance = 1.0;     // exp(-lambda d)
};

/// The formulas by name, in the order of the paper's tables.
std::vector<std::string_view> utility_names();

/// Scores with the formula that `config` names. Nothing for a view that sees no occupied voxel
/// (released code: "must see occupied"). Requires a name of utility_names().
std::optional<Score> score(const UtilityConfig& config, const ViewStats& stats);

}  // namespace gnbv
