#include "planner/guided/utility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// A view that saw 100 occupied, 200 free and 700 unknown voxels at half the full density.
ViewStats view() {
  return {.free_voxels = 200,
          .unknown_voxels = 700,
          .occupied_voxels = 100,
          .entropy_nat = 700 * std::numbers::ln2,
          .density_sum = 100 * 150.0,
          .entropy_per_ray_nat = 1234.5,
          .density_max = 300.0,
          .path_m = 2.0};
}

UtilityConfig named(std::string_view name) { return {.name = std::string(name)}; }

TEST(ProposedUtility, IsEquations2And3WorkedByHand) {
  // E = 700 / 1000, D = 1 - 150 / 300, P = 0, weights normalised: 0.5 / (0.5 + 0.5)
  const auto plain = score(named("proposed"), view());
  EXPECT_NEAR(plain->information, 0.7, 1e-12);
  EXPECT_NEAR(plain->density, 0.5, 1e-12);
  EXPECT_NEAR(plain->value, (1 + 10 * 0.7) * (0.5 * 0.5) * std::exp(-0.4) * 2.0, 1e-12);
  ViewStats stats = view();
  stats.predicted_voxels = 300;
  const auto predicted = score(named("proposed"), stats);
  EXPECT_NEAR(predicted->prediction, 0.75, 1e-12);
  EXPECT_NEAR(predicted->value, 8.0 * (0.5 * 0.5 + 0.5 * 0.75) * std::exp(-0.4) * 2.0, 1e-12);
  UtilityConfig weighed = named("proposed");  // only the ratio of beta and gamma matters
  weighed.beta = weighed.gamma = 2.0;
  EXPECT_NEAR(score(weighed, view())->value, plain->value, 1e-12);
  weighed.normalise_weights = false;  // unless the weights are taken as printed
  EXPECT_NEAR(score(weighed, view())->value, 4.0 * plain->value, 1e-12);
}

TEST(ProposedUtility, SparseAndLiteralDensityAreComplementsButOfNoPointsBothNone) {
  UtilityConfig literal = named("proposed");
  literal.density_term = DensityTerm::literal;
  ViewStats stats = view();
  stats.density_sum = 100 * 30.0;
  EXPECT_NEAR(score(named("proposed"), stats)->density, 0.9, 1e-12);
  EXPECT_NEAR(score(literal, stats)->density, 0.1, 1e-12);
  stats.density_sum = 0.0;
  EXPECT_EQ(score(named("proposed"), stats)->density, 0.0);
  EXPECT_EQ(score(literal, stats)->density, 0.0);
}

TEST(BaselineUtilities, CountVoxelsPerRayOrOnceAndBircherDiscountsThem) {
  UtilityConfig isler = named("isler");
  EXPECT_EQ(score(isler, view())->value, 1234.5);
  isler.ig_counting = IgCounting::unique;
  EXPECT_EQ(score(isler, view())->value, 700 * std::numbers::ln2);
  UtilityConfig bircher = named("bircher");
  EXPECT_NEAR(score(bircher, view())->value, 1234.5 * std::exp(-0.2 * 2.0), 1e-9);
  bircher.bircher_lambda_per_m = 0.5;
  EXPECT_NEAR(score(bircher, view())->value, 1234.5 * std::exp(-1.0), 1e-9);
}

TEST(RandomChoice, IsKeyedByMissionIterationAndCandidate) {
  const auto draw = [](std::uint64_t seed, std::uint64_t iteration, std::uint64_t candidate) {
    return score(named("random"), view(), {seed, iteration, candidate})->value;
  };
  EXPECT_EQ(draw(1, 2, 3), draw(1, 2, 3));
  EXPECT_NE(draw(1, 2, 3), draw(2, 2, 3));
  EXPECT_NE(draw(1, 2, 3), draw(1, 3, 3));
  EXPECT_NE(draw(1, 2, 3), draw(1, 2, 4));
  double sum = 0.0;
  for (std::uint64_t i = 0; i < 1000; ++i) sum += draw(1, 1, i);
  EXPECT_NEAR(sum / 1000, 0.5, 0.05);
}

TEST(NearestFrontier, PrefersTheShortestPathToASparseVoxel) {
  ViewStats stats = view();
  EXPECT_EQ(score(named("nearest_frontier"), stats)->value, 0.0);
  stats.sparse_voxels = 1;
  EXPECT_NEAR(score(named("nearest_frontier"), stats)->value, 1.0 / 3.0, 1e-12);
  stats.path_m = 0.0;
  EXPECT_EQ(score(named("nearest_frontier"), stats)->value, 1.0);
}

TEST(ReleasedUtilities, RefuseAViewThatSeesNoSurface) {
  ViewStats stats = view();
  stats.occupied_voxels = 0;
  for (const auto name : utility_names()) {
    const UtilityConfig config = named(name);
    const bool is_released = name == "proposed" || name == "bircher" || name == "isler";
    EXPECT_EQ(score(config, stats).has_value(), !is_released) << name;
  }
}

TEST(EveryUtility, HasAFormulaAndAnUnknownNameHasNone) {
  ViewStats stats = view();
  stats.rays = 100;
  stats.shadow_rays = stats.front_rays = stats.rear_side_rays = 10;
  stats.occlusion_aware_nat = stats.unobserved_nat = stats.rear_side_nat = 5.0;
  stats.crossed_by_occupied = 50;
  stats.entropy_of_occupied_nat = stats.unknown_volume_m3 = stats.proximity_sum = 5.0;
  stats.voxel_m3 = 0.008;
  stats.sparse_voxels = 1;
  for (const auto name : utility_names()) {
    EXPECT_GT(score(named(name), stats)->value, 0.0) << name;
  }
  EXPECT_THROW(score(named("nonsense"), stats), BrokenInvariant);
  EXPECT_THROW(needs_of(named("nonsense")), BrokenInvariant);
}

TEST(EveryUtility, AsksForWhatItReads) {
  EXPECT_FALSE(needs_of(named("proposed")).rays);
  EXPECT_TRUE(needs_of(named("aep")).rays);
  EXPECT_TRUE(needs_of(named("area_factor")).shadow);
  EXPECT_TRUE(needs_of(named("proximity_count")).shadow);
  EXPECT_FALSE(needs_of(named("kriegel")).shadow);
}

TEST(EveryUtility, StopsTheRunOnNaN) {
  ViewStats stats = view();
  stats.rays = 1;
  stats.sparse_voxels = 1;
  const double nan = std::nan("");
  stats.entropy_nat = stats.entropy_per_ray_nat = stats.path_m = nan;
  stats.occlusion_aware_nat = stats.unobserved_nat = stats.rear_side_nat = nan;
  stats.crossed_by_occupied = 1;
  stats.entropy_of_occupied_nat = stats.unknown_volume_m3 = stats.proximity_sum = nan;
  for (const auto name : utility_names()) {
    if (name == "random" || name == "rear_side_voxel" || name == "area_factor") continue;  // counts
    EXPECT_THROW(score(named(name), stats), BrokenInvariant) << name;
  }
}

}  // namespace
}  // namespace gnbv
