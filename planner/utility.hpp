// How much a view is worth. Every formula scores the same ViewStats.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "planner/visibility.hpp"

namespace gnbv {

/// The formula by name and the weights of Table 1, Scenario 1. Each formula takes what it needs.
struct UtilityConfig {
  std::string name = "proposed";
  double alpha = 10.0;
  double beta = 0.5;
  double gamma = 0.5;
  double lambda_per_m = 0.2;
  std::string density_term = "sparse";   // sparse (released code) or literal (Eq. 2 to the letter)
};

enum class DensityTerm { sparse, literal };

/// Eq. (2).
struct ProposedUtility {
  double alpha, beta, gamma, lambda_per_m;
  DensityTerm density_term;
};
/// Bircher et al. 2016 as the paper compares it: entropy along rays, discounted by distance.
struct BircherUtility {
  double lambda_per_m;
};
/// Isler et al. 2016 as the paper compares it: entropy along rays.
struct IslerUtility {};

using Utility = std::variant<ProposedUtility, BircherUtility, IslerUtility>;

/// A score with the terms it is made of, for iterations.csv. Terms a formula lacks are 0.
struct Score {
  double value = 0.0;
  double information = 0.0;   // E hat of Eq. (2), or nat along rays
  double density = 0.0;       // D hat
  double prediction = 0.0;    // P hat
  double distance = 1.0;      // the factor exp(-lambda d)
};

/// Nothing for a view that sees no occupied voxel ("must see occupied").
std::optional<Score> score(const Utility& utility, const ViewStats& stats);

/// The one table of formulas; adding a utility is one score function and one line here.
Utility make_utility(const UtilityConfig& config);
std::span<const std::string_view> utility_names();

}  // namespace gnbv
