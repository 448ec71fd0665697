// Every utility on one ray through a row of voxels, worked by hand. P is 0.4 after one miss (free),
// 0.7 after one hit (occupied), 0.5 where nothing was measured.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/guided/utility.hpp"
#include "tests/planner/view/view_scene.hpp"

namespace gnbv {
namespace {

constexpr double kUnknown_nat = std::numbers::ln2;
const double kFree_nat = -0.4 * std::log(0.4) - 0.6 * std::log(0.6);
const double kOccupied_nat = -0.7 * std::log(0.7) - 0.3 * std::log(0.3);
constexpr double kTolerance = 2e-6;  // float32 along the ray

double value(const char* name, ViewStats stats, double path_m = 0.0) {
  UtilityConfig config;
  config.name = name;
  stats.density_max = 300.0;
  stats.path_m = path_m;
  return score(config, stats).value().value;
}

/// free, unknown, unknown, occupied: P_v is 1, 0.6, 0.3, 0.15.
Corridor seen_from_behind() {
  Corridor corridor(8);
  corridor.miss(0);
  corridor.hit(3);
  return corridor;
}

TEST(OcclusionAware, IsEntropyTimesTheChanceToSeeIt) {
  EXPECT_NEAR(value("occlusion_aware", seen_from_behind().look(1.2)),
              kFree_nat + (0.6 + 0.3) * kUnknown_nat + 0.15 * kOccupied_nat, kTolerance);
}

TEST(OcclusionAware, LegacyMultipliesTheChanceOfBeingOccupied) {
  const ViewStats stats =
      seen_from_behind().look(1.2, {.detail = ViewDetail::rays, .legacy_visibility = true});
  EXPECT_NEAR(value("occlusion_aware", stats),
              kFree_nat + (0.4 + 0.2) * kUnknown_nat + 0.1 * kOccupied_nat, kTolerance);
}

TEST(UnobservedVoxel, TakesTheUnknownPart) {
  EXPECT_NEAR(value("unobserved_voxel", seen_from_behind().look(1.2)), 0.9 * kUnknown_nat,
              kTolerance);
}

TEST(RearSide, IsAnOccupiedVoxelEnteredFromAnUnknownOne) {
  const ViewStats stats = seen_from_behind().look(1.2);
  EXPECT_EQ(value("rear_side_voxel", stats), 1.0);
  EXPECT_NEAR(value("rear_side_entropy", stats), 0.9 * kUnknown_nat + 0.15 * kOccupied_nat,
              kTolerance);
}

TEST(RearSide, ForgetsTheUnknownBeforeAKnownVoxel) {
  // free, unknown, free, unknown, occupied: P_v is 1, 0.6, 0.3, 0.18, 0.09
  Corridor corridor(8);
  corridor.miss(0);
  corridor.miss(2);
  corridor.hit(4);
  EXPECT_NEAR(value("rear_side_entropy", corridor.look(1.2)),
              0.18 * kUnknown_nat + 0.09 * kOccupied_nat, kTolerance);
}

TEST(RearSide, IsNothingFromFreeSpaceOrWithoutASurface) {
  Corridor corridor(8);
  corridor.miss(0);
  EXPECT_EQ(value("rear_side_voxel", corridor.look(1.2)), 0.0);
  EXPECT_EQ(value("rear_side_entropy", corridor.look(1.2)), 0.0);
  corridor.miss(1);
  corridor.hit(2);
  EXPECT_EQ(value("rear_side_voxel", corridor.look(1.2)), 0.0);
  EXPECT_EQ(value("rear_side_entropy", corridor.look(1.2)), 0.0);
}

TEST(AverageEntropyAndKriegel, AreThatOfRaysWhichEndAtASurface) {
  const double sum_nat = kFree_nat + 2 * kUnknown_nat + kOccupied_nat;
  const ViewStats stats = seen_from_behind().look(1.2);
  EXPECT_NEAR(value("kriegel", stats), sum_nat, kTolerance);
  EXPECT_NEAR(value("average_entropy", stats), sum_nat / 4, kTolerance);
  const ViewStats short_of_it = seen_from_behind().look(0.5);
  EXPECT_EQ(value("kriegel", short_of_it), 0.0);
  EXPECT_EQ(value("average_entropy", short_of_it), 0.0);
}

TEST(BircherVolume, IsTheVolumeOfTheVoxelsSeenWeighedAndDiscounted) {
  const ViewStats stats = seen_from_behind().look(1.2);
  EXPECT_NEAR(value("bircher_volume", stats), 2 * 0.008, 1e-12);
  EXPECT_NEAR(value("bircher_volume", stats, 3.0), 2 * 0.008 * std::exp(-0.6), 1e-12);
  UtilityConfig config;
  config.name = "bircher_volume";
  config.volume_weights = {.unmapped = 0.5, .free = 2.0, .occupied = 4.0};
  EXPECT_NEAR(score(config, stats)->value, (0.5 * 2 + 2.0 + 4.0) * 0.008, 1e-12);
}

TEST(Aep, IsTheUnknownPartOfThePyramid) {
  // the ray of 1.2 m passes the unknown voxels from 0.1 m to 0.5 m
  const double share = (std::pow(0.5, 3) - std::pow(0.1, 3)) / std::pow(1.2, 3);
  const double pyramid_m3 = 0.2 * 0.2 * 1.2 / 3.0;
  const ViewStats stats = seen_from_behind().look(1.2);
  EXPECT_NEAR(value("aep", stats), share * pyramid_m3, 1e-8);
  EXPECT_NEAR(value("aep", stats, 2.0), share * pyramid_m3 * std::exp(-0.4), 1e-8);
}

TEST(IslerAndBircher, CountEntropyAlongTheRay) {
  const double sum_nat = kFree_nat + 2 * kUnknown_nat + kOccupied_nat;
  const ViewStats stats = seen_from_behind().look(1.2, {});
  EXPECT_NEAR(value("isler", stats), sum_nat, kTolerance);
  EXPECT_NEAR(value("bircher", stats, 2.0), sum_nat * std::exp(-0.4), kTolerance);
}

TEST(Proposed, WorkedOnTheCorridor) {
  Corridor corridor = seen_from_behind();
  corridor.grid.predict(1);
  corridor.grid.predict(2);  // behind the first predicted voxel of the only ray
  const ViewStats stats = corridor.look(1.2, {});
  EXPECT_EQ(stats.predicted_voxels, 1U);
  EXPECT_EQ(value("proposed", stats), 0.0);  // log10 of one occupied voxel
}

/// Hit at 0.7 m, seen from the far end: the voxels behind it, 4 and 5, are 1 and 2 steps away.
TEST(ProximityCount, IsLargestNextToTheSurface) {
  Corridor corridor(8);
  corridor.hit(3);
  ShadowBand shadow({.shadow_depth_m = 0.5}, corridor.grid.geometry());
  FrameRays rays;
  rays.origin_world_m = Vec3f(0.1F, 0.1F, 0.1F);
  rays.end_m = {{{0.75F}, {0.1F}, {0.1F}}};
  rays.kind = {PixelRay::hits};
  shadow.add(rays, corridor.grid);
  const ViewOptions options = {.detail = ViewDetail::rays, .shadow = &shadow};
  constexpr bool kBackwards = true;
  const ViewStats behind = corridor.look(1.3, options, kBackwards);
  EXPECT_NEAR(value("proximity_count", behind), (5 - 1) + (5 - 2), 1e-12);
  EXPECT_EQ(behind.shadow_rays, 1U);
  EXPECT_EQ(value("proximity_count", corridor.look(1.3, options)), 0.0);
  corridor.miss(4);  // measured: in no shadow any more
  EXPECT_NEAR(value("proximity_count", corridor.look(1.3, options, kBackwards)), 5 - 2, 1e-12);
}

TEST(AreaFactor, GivesEachRayOneVote) {
  Corridor corridor(8);
  corridor.miss(0);
  corridor.miss(1);
  corridor.hit(2);
  const ViewStats front = corridor.look(1.2);
  EXPECT_EQ(front.front_rays, 1U);
  EXPECT_EQ(front.shadow_rays, 0U);
  corridor.grid.shade(1);  // measured: no shadow
  EXPECT_EQ(corridor.look(1.2).shadow_rays, 0U);
  Corridor shaded(8);
  shaded.grid.shade(0);
  shaded.miss(1);
  shaded.hit(2);
  const ViewStats both = shaded.look(1.2);
  EXPECT_EQ(both.shadow_rays, 1U);
  EXPECT_EQ(both.front_rays, 0U);
}

TEST(AreaFactor, PeaksAtTheSharesWanted) {
  const auto of = [](std::uint32_t front, std::uint32_t shadow) {
    ViewStats stats;
    stats.rays = 100;
    stats.front_rays = front;
    stats.shadow_rays = shadow;
    return value("area_factor", stats);
  };
  EXPECT_NEAR(of(20, 80), 2.0, 1e-12);
  EXPECT_NEAR(of(0, 0), 0.0, 1e-12);
  EXPECT_NEAR(of(100, 0), 0.0, 1e-12);
  EXPECT_NEAR(of(0, 100), 0.0, 1e-12);
  EXPECT_NEAR(of(10, 0), 0.5, 1e-12);  // 3 / 4 - 2 / 8
  EXPECT_NEAR(of(0, 40), 0.5, 1e-12);
  EXPECT_NEAR(of(60, 0), 0.5, 1e-12);  // half way down
  EXPECT_NEAR(of(0, 90), 0.5, 1e-12);
}

}  // namespace
}  // namespace gnbv
