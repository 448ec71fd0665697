#include "bench/score/coverage_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bench/score/run_figures.hpp"
#include "bench/score/surface_pieces.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

SurfaceReference box_in_a_box(std::size_t area_samples = 0) {
  World world;
  test::add_box(world.structure, Vec3(-1, -1, 0.5), Vec3(2, 2, 2));
  test::add_box(world.structure, Vec3(-0.6, -0.6, 0.9), Vec3(1.2, 1.2, 1.2));
  return make_surface_reference(world, RayScene(world), {.area_samples = area_samples}, 2);
}

std::vector<Vec3f> random_points(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> coordinate(-1.2F, 1.2F);
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(coordinate(random), coordinate(random), 1.5F + coordinate(random));
  }
  return points;
}

TEST(CoverageOfPrefixes, EqualsTheSetsOfEachPrefix) {
  const std::vector<Vec3f> cloud = random_points(20000);
  const std::vector<std::size_t> prefixes = {0, 1, 10, 10, 500, 4999, 20000};
  for (const auto& [threads, area_samples] : {std::pair(1, 0U), {3, 0U}, {2, 3000U}}) {
    const SurfaceReference reference = box_in_a_box(area_samples);
    const auto shares = coverage_of_prefixes(reference, cloud, prefixes, threads);
    ASSERT_EQ(shares.size(), prefixes.size());
    for (std::size_t i = 0; i < prefixes.size(); ++i) {
      const std::span<const Vec3f> prefix = std::span(cloud).first(prefixes[i]);
      EXPECT_EQ(shares[i].raw, coverage_at_all_sizes(reference.raw, prefix)) << i;
      EXPECT_EQ(shares[i].counted, coverage_at_all_sizes(reference.counted, prefix)) << i;
    }
    EXPECT_EQ(shares.front().raw, (std::array<double, 3>{}));
    EXPECT_GT(shares.back().raw[0], 0.1);
    EXPECT_NE(shares.back().raw[0], shares.back().counted[0]);
  }
}

TEST(CoverageMeter, EqualsTheSetsOfTheCloudAsItGrows) {
  const SurfaceReference reference = box_in_a_box();
  const std::vector<Vec3f> cloud = random_points(20000);
  for (const std::size_t size : {0U, 2U}) {
    CoverageMeter meter(reference.counted[size], size);
    for (const std::size_t count : {0U, 10U, 10U, 5000U, 20000U}) {
      const std::span<const Vec3f> grown = std::span(cloud).first(count);
      EXPECT_EQ(meter.share_of(grown), coverage_at_all_sizes(reference.counted, grown)[size]);
    }
  }
}

TEST(CoverageOfPrefixes, OfAnEmptyReferenceIsZeroAndPrefixesGrowWithinTheCloud) {
  const std::vector<Vec3f> cloud = random_points(10);
  const auto shares_of = [&](const std::vector<std::size_t>& prefixes) {
    return coverage_of_prefixes({}, cloud, prefixes, 1);
  };
  EXPECT_EQ(shares_of({10})[0].raw, (std::array<double, 3>{}));
  EXPECT_THROW(shares_of({5, 4}), BrokenInvariant);
  EXPECT_THROW(shares_of({11}), BrokenInvariant);
}

TEST(ReferencePoints, OneLiesInEachVoxelSeenFromOutsideInItsOrder) {
  const SurfaceReference reference = box_in_a_box();
  ASSERT_EQ(reference.points_world_m.size(), reference.counted[0].size());
  for (std::size_t i = 0; i < reference.points_world_m.size(); ++i) {
    ASSERT_EQ(voxel_code(reference.points_world_m[i], kCoverageSizes_m[0]),
              reference.counted[0][i]);
    // on the outer box, never on the inner one
    const Vec3f from_centre_m = reference.points_world_m[i] - Vec3f(0, 0, 1.5F);
    ASSERT_NEAR(from_centre_m.cwiseAbs().maxCoeff(), 1.0F, 1e-5F);
  }
}

TEST(ReferencePoints, OfAreaSamplesAreThoseNearestToTheirVoxelsCentres) {
  const SurfaceReference reference = box_in_a_box(20000);
  World world;
  test::add_box(world.structure, Vec3(-1, -1, 0.5), Vec3(2, 2, 2));
  test::add_box(world.structure, Vec3(-0.6, -0.6, 0.9), Vec3(1.2, 1.2, 1.2));
  const std::vector<Vec3f> drawn = drawn_by_area(world.structure, 0.3, 20000);
  ASSERT_EQ(reference.points_world_m.size(), reference.counted[0].size());
  for (std::size_t i = 0; i < reference.points_world_m.size(); i += 7) {
    const Vec3f centre_m =
        voxel_centre_m(reference.counted[0][i], kCoverageSizes_m[0]).cast<float>();
    float nearest_m = 1.0F;
    for (const Vec3f& p_m : drawn) {
      if (voxel_code(p_m, kCoverageSizes_m[0]) != reference.counted[0][i]) continue;
      nearest_m = std::min(nearest_m, (p_m - centre_m).norm());
    }
    EXPECT_EQ((reference.points_world_m[i] - centre_m).norm(), nearest_m) << i;
  }
}

TEST(ReferenceSamples, StandForEqualAreasOfWhatSeesOut) {
  // the part of the outer box above the floor: a lid of 4 m2, walls of 2 m x 2 m and a bottom; any
  // tenth of a wall's height has a tenth of the wall's samples, whatever its triangles are
  const SurfaceReference reference = box_in_a_box();
  const auto all = static_cast<double>(reference.samples_world_m.size());
  EXPECT_NEAR(all, kAreaSamples, 0.25 * kAreaSamples);
  for (int tenth = 0; tenth < 10; ++tenth) {
    const auto low_m = static_cast<float>(0.5 + 0.2 * tenth);
    const auto in_tenth = std::count_if(
        reference.samples_world_m.begin(), reference.samples_world_m.end(), [&](const Vec3f& p_m) {
          return p_m.x() > 0.9999F && p_m.z() >= low_m && p_m.z() < low_m + 0.2F;
        });
    EXPECT_NEAR(static_cast<double>(in_tenth) / all, 0.4 / 24.0, 0.02 * 0.4 / 24.0) << tenth;
  }
  for (const Vec3f& p_m : reference.samples_world_m) {
    ASSERT_NEAR((p_m - Vec3f(0, 0, 1.5F)).cwiseAbs().maxCoeff(), 1.0F, 1e-5F);
  }
}

TEST(ReferencePoints, OfADoubleWallLieOnTheOuterOne) {
  // both walls in the same voxels, the hidden one through their middle
  World world;
  test::add_box(world.structure, Vec3(-1.04, -1.04, 0.46), Vec3(2.08, 2.08, 2.08));
  test::add_box(world.structure, Vec3(-1.02, -1.02, 0.48), Vec3(2.04, 2.04, 2.04));
  const SurfaceReference reference = make_surface_reference(world, RayScene(world), {}, 2);
  ASSERT_FALSE(reference.points_world_m.empty());
  for (const Vec3f& p_m : reference.points_world_m) {
    ASSERT_NEAR((p_m - Vec3f(0, 0, 1.5F)).cwiseAbs().maxCoeff(), 1.04F, 1e-5F);
  }
}

/// A cloud that grows by chance, sometimes not at all.
CoverageCurve random_curve(std::uint64_t seed) {
  CoverageCurve curve;
  double share = 0.0;
  const std::size_t entries = 1 + seed % 9;
  for (std::size_t i = 0; i < entries; ++i) {
    const double u = uniform01({seed, Stream::bench, i, 0});
    share += u < 0.3 ? 0.0 : 0.2 * u;
    curve.coverage.push_back({share, 1.0, 1.0});
    curve.metres.push_back(3.0 * static_cast<double>(i) * (1.0 + u));
    curve.seconds.push_back(static_cast<double>(i) * 11.0);
  }
  std::sort(curve.metres.begin(), curve.metres.end());
  curve.metres.front() = 0.0;
  return curve;
}

TEST(EffortToReach, IsThatOfTheFirstEntryThatCoversSoMuch) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const CoverageCurve curve = random_curve(seed);
    for (int step = 0; step <= 40; ++step) {
      const double wanted = 0.03 * step;
      std::size_t first = 0;
      while (first < curve.coverage.size() && curve.coverage[first][0] < wanted) ++first;
      const auto reached = entry_that_covers(curve, wanted);
      EXPECT_EQ(reached.value_or(curve.coverage.size()), first) << "seed " << seed;
    }
  }
}

/// Of metres also the way on from the profile, which only a view has taken.
TEST(Effort, FromTakeOffIsWhatTheProfileTookAndWhatTheViewsDid) {
  const BeforeViews before = {.profile_m = 100.0, .transfer_m = 7.0, .profile_end_s = 50.0};
  CoverageCurve curve = random_curve(8);
  EXPECT_FALSE(is_known(curve, Effort::wh_with_profile));
  for (std::size_t n = 0; n < curve.coverage.size(); ++n) {
    const auto at = [&](Effort effort) { return effort_at(curve, before, effort, n); };
    EXPECT_EQ(at(Effort::views), static_cast<double>(n));
    EXPECT_EQ(at(Effort::metres), curve.metres[n]);
    EXPECT_EQ(at(Effort::metres_with_profile), 100.0 + (n > 0 ? 7.0 : 0.0) + curve.metres[n]);
    EXPECT_EQ(at(Effort::seconds), curve.seconds[n]);
    EXPECT_EQ(at(Effort::seconds_with_profile), 50.0 + curve.seconds[n]);
  }
  curve.energy_wh = {1.5, 2.5};
  EXPECT_TRUE(is_known(curve, Effort::wh_with_profile));
  EXPECT_EQ(effort_at(curve, before, Effort::wh_with_profile, 1), 2.5);
}

TEST(EffortToReach, NeedsACurve) {
  EXPECT_THROW(entry_that_covers({}, 0.5), BrokenInvariant);
  CoverageCurve uneven = random_curve(8);
  uneven.metres.pop_back();
  EXPECT_THROW(entry_that_covers(uneven, 0.5), BrokenInvariant);
}

/// Coverage of a view as a line through the origin: 0, 0.1, 0.2, ... with two metres and four
/// seconds a view.
CoverageCurve straight_line(int views) {
  CoverageCurve curve;
  for (int view = 0; view <= views; ++view) {
    const double share = 0.1 * view;
    curve.coverage.push_back({share, 0.5 * share, 1.0});
    curve.metres.push_back(2.0 * view);
    curve.seconds.push_back(4.0 * view);
  }
  return curve;
}

/// Surface counts from the view that saw it: each share lasts until the next view.
TEST(AreaUnderCoverage, IsThatOfSteps) {
  const CoverageCurve curve = straight_line(8);
  for (const auto& [effort, length] :
       {std::pair{Effort::views, 8.0}, {Effort::metres, 16.0}, {Effort::seconds, 32.0}}) {
    EXPECT_NEAR(area_under_coverage(curve, effort, 0, length), 0.35, 1e-12);
    EXPECT_NEAR(area_under_coverage(curve, effort, 1, length), 0.175, 1e-12);
    EXPECT_NEAR(area_under_coverage(curve, effort, 2, length), 1.0, 1e-12);
    // a budget of 2.4 views: (0.1 + 0.4 * 0.2) / 2.4
    EXPECT_NEAR(area_under_coverage(curve, effort, 0, 0.3 * length), 0.075, 1e-12);
    // and past the end, where coverage stays: (0.35 + 0.8) / 2
    EXPECT_NEAR(area_under_coverage(curve, effort, 0, 2.0 * length), 0.575, 1e-12);
  }
}

TEST(AreaUnderCoverage, AStepWithoutEffortHasNoneAndTheProfileAloneItsCoverage) {
  const CoverageCurve step{.coverage = {{0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}, {1.0, 1.0, 1.0}},
                           .metres = {0.0, 0.0, 10.0},
                           .seconds = {0.0, 1.0, 2.0}};
  EXPECT_NEAR(area_under_coverage(step, Effort::metres, 0, 10.0), 0.5, 1e-12);
  const CoverageCurve profile{.coverage = {{0.1, 0.2, 0.3}}, .metres = {0.0}, .seconds = {0.0}};
  EXPECT_EQ(profile.views(), 0U);
  EXPECT_NEAR(area_under_coverage(profile, Effort::seconds, 1, 7.0), 0.2, 1e-12);
}

TEST(AreaUnderCoverage, NeedsACurveABudgetAndEffortThatGrows) {
  EXPECT_THROW(area_under_coverage({}, Effort::views, 0, 1.0), BrokenInvariant);
  EXPECT_THROW(area_under_coverage(straight_line(2), Effort::views, 0, 0.0), BrokenInvariant);
  CoverageCurve back = straight_line(2);
  back.metres = {0.0, 2.0, 1.0};
  EXPECT_THROW(area_under_coverage(back, Effort::metres, 0, 3.0), BrokenInvariant);
}

}  // namespace
}  // namespace gnbv
