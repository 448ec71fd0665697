#include "planner/utility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// A view that saw 100 occupied, 200 free and 700 unknown voxels at half the full density.
ViewStats view() {
  ViewStats stats;
  stats.occupied_voxels = 100;
  stats.free_voxels = 200;
  stats.unknown_voxels = 700;
  stats.entropy_nat = 700 * std::numbers::ln2;
  stats.entropy_per_ray_nat = 1234.5;
  stats.density_sum = 100 * 150.0;
  stats.density_max = 300.0;
  stats.path_m = 2.0;
  return stats;
}

UtilityConfig named(const char* name) {
  UtilityConfig config;
  config.name = name;
  return config;
}

TEST(ProposedUtility, IsEquation2WorkedByHand) {
  // E = 700 / 1000, D = 1 - 150 / 300, P = 0, weights normalised: 0.5 / (0.5 + 0.5)
  const auto s = score(named("proposed"), view());
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->information, 0.7, 1e-12);
  EXPECT_NEAR(s->density, 0.5, 1e-12);
  EXPECT_NEAR(s->value, (1 + 10 * 0.7) * (0.5 * 0.5) * std::exp(-0.4) * 2.0, 1e-12);
}

TEST(ProposedUtility, CountsPredictedVoxelsAsEquation3) {
  ViewStats stats = view();
  stats.predicted_voxels = 300;
  const auto s = score(named("proposed"), stats);
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->prediction, 0.75, 1e-12);
  EXPECT_NEAR(s->value, 8.0 * (0.5 * 0.5 + 0.5 * 0.75) * std::exp(-0.4) * 2.0, 1e-12);
}

TEST(ProposedUtility, SparseAndLiteralDensityAreComplements) {
  UtilityConfig literal = named("proposed");
  literal.density_term = DensityTerm::literal;
  ViewStats stats = view();
  stats.density_sum = 100 * 30.0;
  EXPECT_NEAR(score(named("proposed"), stats)->density, 0.9, 1e-12);
  EXPECT_NEAR(score(literal, stats)->density, 0.1, 1e-12);
}

TEST(ProposedUtility, AViewWithoutPointsHasNoDensityEitherWay) {
  UtilityConfig literal = named("proposed");
  literal.density_term = DensityTerm::literal;
  ViewStats stats = view();
  stats.density_sum = 0.0;
  EXPECT_EQ(score(named("proposed"), stats)->density, 0.0);
  EXPECT_EQ(score(literal, stats)->density, 0.0);
}

TEST(ProposedUtility, OnlyTheRatioOfBetaAndGammaMatters) {
  UtilityConfig doubled = named("proposed");
  doubled.beta *= 2;
  doubled.gamma *= 2;
  EXPECT_NEAR(score(doubled, view())->value, score(named("proposed"), view())->value, 1e-12);
}

TEST(BaselineUtilities, BircherIsIslerDiscountedByDistance) {
  const auto isler = score(named("isler"), view());
  const auto bircher = score(named("bircher"), view());
  EXPECT_EQ(isler->value, 1234.5);
  EXPECT_NEAR(bircher->value, 1234.5 * std::exp(-0.2 * 2.0), 1e-9);
}

TEST(EveryUtility, RefusesAViewThatSeesNoSurface) {
  ViewStats stats = view();
  stats.occupied_voxels = 0;
  for (const auto name : utility_names()) {
    EXPECT_FALSE(score(named(std::string(name).c_str()), stats)) << name;
  }
}

TEST(EveryUtility, HasAFormulaAndAnUnknownNameHasNone) {
  for (const auto name : utility_names()) {
    EXPECT_GT(score(named(std::string(name).c_str()), view())->value, 0.0) << name;
  }
  EXPECT_THROW(score(named("nonsense"), view()), BrokenInvariant);
}

TEST(EveryUtility, StopsTheRunOnNaN) {
  ViewStats stats = view();
  stats.entropy_nat = std::nan("");
  stats.entropy_per_ray_nat = std::nan("");
  for (const auto name : utility_names()) {
    EXPECT_THROW(score(named(std::string(name).c_str()), stats), BrokenInvariant) << name;
  }
}

}  // namespace
}  // namespace gnbv
