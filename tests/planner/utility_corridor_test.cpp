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
  stats.density_max = 300.0;
  stats.path_m = path_m;
  return score({.name = name}, stats).value().value;
}

/// One letter a voxel: f free, o occupied; unknown for others, and beyond.
Corridor corridor_of(std::string_view voxels) {
  Corridor corridor(8);
  for (VoxelIndex v = 0; v < voxels.size(); ++v) {
    if (voxels[v] == 'f') corridor.miss(v);
    if (voxels[v] == 'o') corridor.hit(v);
  }
  return corridor;
}

TEST(Utilities, OfOneRayAreTheirFormulasWorkedByHand) {
  const double sum_nat = kFree_nat + 2 * kUnknown_nat + kOccupied_nat;
  // of the ray of 1.2 m, through the unknown voxels from 0.1 m to 0.5 m, in its pyramid
  const double unknown_m3 =
      (std::pow(0.5, 3) - std::pow(0.1, 3)) / std::pow(1.2, 3) * (0.2 * 0.2 * 1.2 / 3.0);
  struct Case {
    const char* utility;
    const char* voxels;
    double range_m, path_m, expected;
  };
  for (const auto& [utility, voxels, range_m, path_m, expected] : std::vector<Case>{
           // the chance to see them is 1, 0.6, 0.3, 0.15
           {"occlusion_aware", "f??o", 1.2, 0.0,
            kFree_nat + 0.9 * kUnknown_nat + 0.15 * kOccupied_nat},
           {"unobserved_voxel", "f??o", 1.2, 0.0, 0.9 * kUnknown_nat},
           {"rear_side_voxel", "f??o", 1.2, 0.0, 1.0},
           {"rear_side_entropy", "f??o", 1.2, 0.0, 0.9 * kUnknown_nat + 0.15 * kOccupied_nat},
           // 1, 0.6, 0.3, 0.18, 0.09, and a known voxel lets forget what is before it
           {"rear_side_entropy", "f?f?o", 1.2, 0.0, 0.18 * kUnknown_nat + 0.09 * kOccupied_nat},
           {"rear_side_voxel", "f", 1.2, 0.0, 0.0},  // without a surface, or from free space
           {"rear_side_entropy", "f", 1.2, 0.0, 0.0},
           {"rear_side_voxel", "ffo", 1.2, 0.0, 0.0},
           {"rear_side_entropy", "ffo", 1.2, 0.0, 0.0},
           {"kriegel", "f??o", 1.2, 0.0, sum_nat},  // of rays which end at a surface
           {"kriegel", "f??o", 0.5, 0.0, 0.0},
           {"average_entropy", "f??o", 1.2, 0.0, sum_nat / 4},
           {"average_entropy", "f??o", 0.5, 0.0, 0.0},
           {"bircher_volume", "f??o", 1.2, 0.0, 2 * 0.008},
           {"bircher_volume", "f??o", 1.2, 3.0, 2 * 0.008 * std::exp(-0.6)},
           {"aep", "f??o", 1.2, 0.0, unknown_m3},
           {"aep", "f??o", 1.2, 2.0, unknown_m3 * std::exp(-0.4)},
           {"isler", "f??o", 1.2, 0.0, sum_nat},
           {"bircher", "f??o", 1.2, 2.0, sum_nat * std::exp(-0.4)}}) {
    const bool is_count = expected == std::floor(expected);
    const bool is_whole = std::string_view(utility) == "bircher_volume";  // voxels
    const double tolerance = is_count ? 0.0 : is_whole ? 1e-12 : expected < 0.1 ? 1e-8 : kTolerance;
    EXPECT_NEAR(value(utility, corridor_of(voxels).look(range_m), path_m), expected, tolerance)
        << utility << " of " << voxels;
  }
}

TEST(Utilities, HaveTheirSwitches) {
  const ViewStats legacy =
      corridor_of("f??o").look(1.2, {.detail = ViewDetail::rays, .legacy_visibility = true});
  EXPECT_NEAR(value("occlusion_aware", legacy),  // the chance of being occupied
              kFree_nat + (0.4 + 0.2) * kUnknown_nat + 0.1 * kOccupied_nat, kTolerance);
  const UtilityConfig config{.name = "bircher_volume",
                             .volume_weights = {.unmapped = 0.5, .free = 2.0, .occupied = 4.0}};
  EXPECT_NEAR(score(config, corridor_of("f??o").look(1.2))->value, (0.5 * 2 + 2.0 + 4.0) * 0.008,
              1e-12);
}

TEST(Proposed, WorkedOnTheCorridor) {
  Corridor corridor = corridor_of("f??o");
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
  Corridor corridor = corridor_of("ffo");
  EXPECT_EQ(corridor.look(1.2).front_rays, 1U);
  corridor.grid.shade(1);  // measured: no shadow
  EXPECT_EQ(corridor.look(1.2).shadow_rays, 0U);
  Corridor shaded = corridor_of("?fo");
  shaded.grid.shade(0);
  EXPECT_EQ(shaded.look(1.2).shadow_rays, 1U);
  EXPECT_EQ(shaded.look(1.2).front_rays, 0U);
}

TEST(AreaFactor, PeaksAtTheSharesWanted) {
  const auto of = [](std::uint32_t front, std::uint32_t shadow) {
    return value("area_factor", {.rays = 100, .shadow_rays = shadow, .front_rays = front});
  };
  for (const auto& [front, shadow, expected] : {std::tuple(20U, 80U, 2.0),
                                                {0U, 0U, 0.0},
                                                {100U, 0U, 0.0},
                                                {0U, 100U, 0.0},
                                                {10U, 0U, 0.5},  // 3 / 4 - 2 / 8
                                                {0U, 40U, 0.5},
                                                {60U, 0U, 0.5},
                                                {0U, 90U, 0.5}}) {  // half way down
    EXPECT_NEAR(of(front, shadow), expected, 1e-12) << front << " " << shadow;
  }
}

}  // namespace
}  // namespace gnbv
