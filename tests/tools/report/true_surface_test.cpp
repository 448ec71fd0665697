// Laws of what the report says of the true surface and of decisions.
#include "tools/report/true_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "bench/score/coverage_curve.hpp"
#include "planner/core/plan.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/report/candidate_pack.hpp"
#include "tools/run/candidates_jsonl.hpp"

namespace gnbv {
namespace {

/// In a cube of `size_m`.
std::vector<Vec3f> random_points(std::size_t count, float size_m, std::uint64_t seed) {
  std::vector<Vec3f> points(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    for (std::uint64_t k = 0; k < 3; ++k) {
      const double share = uniform01({seed, Stream::bench, i, k});
      points[i][static_cast<Eigen::Index>(k)] = size_m * static_cast<float>(share);
    }
  }
  return points;
}

template <typename T>
std::vector<T> read_back(const BytePack& bytes, const ByteSlice& slice) {
  std::vector<T> values(slice.count);
  std::memcpy(values.data(), bytes.bytes().data() + slice.at, sizeof(T) * values.size());
  return values;
}

TEST(TrueSurface, FoundAfterEachViewIsTheCurveOfCoverage) {
  SurfaceReference reference;
  reference.outside = at_all_sizes(voxels_of(random_points(2000, 2.0F, 1), 0.05));
  reference.raw = reference.outside;
  RunCloud cloud{.points_world_m = random_points(5000, 2.0F, 2),
                 .profile_points = 700,
                 .view_points = {900, 900, 3100, 5000}};
  std::vector<std::size_t> prefixes = {cloud.profile_points};
  prefixes.insert(prefixes.end(), cloud.view_points.begin(), cloud.view_points.end());
  const auto curve = coverage_of_prefixes(reference, cloud.points_world_m, prefixes, 1);

  const TrueVoxels voxels = true_voxels(reference, 1'000'000);
  EXPECT_EQ(voxels.size_m, 0.05);
  const std::vector<std::uint16_t> until = views_until_found(voxels, cloud);
  for (std::size_t n = 0; n < curve.size(); ++n) {
    const auto found = std::count_if(until.begin(), until.end(), [&](auto u) { return u <= n; });
    EXPECT_EQ(static_cast<double>(found) / static_cast<double>(until.size()), curve[n].outside[0]);
  }
  EXPECT_GT(std::count(until.begin(), until.end(), kNeverFound), 0);
}

TEST(TrueSurface, WhatCameAfterTheLastViewCountsToIt) {
  const TrueVoxels voxels{.size_m = 1.0, .codes = {code_of({0, 0, 0}), code_of({1, 0, 0})}};
  RunCloud cloud{
      .points_world_m = {{0.5F, 0, 0}, {1.5F, 0, 0}}, .profile_points = 1, .view_points = {1, 1}};
  EXPECT_EQ(views_until_found(voxels, cloud), (std::vector<std::uint16_t>{0, 2}));
}

TEST(TrueSurface, IsAsFineAsThePageHasRoomFor) {
  SurfaceReference reference;
  reference.outside = at_all_sizes(voxels_of(random_points(2000, 2.0F, 1), 0.05));
  for (std::size_t size = 0; size < 3; ++size) {
    const std::size_t count = reference.outside[size].size();
    EXPECT_EQ(true_voxels(reference, count).size_m, kCoverageSizes_m[size]);
    EXPECT_EQ(voxel_indices(true_voxels(reference, count)).size(), 3 * count);
  }
  EXPECT_TRUE(true_voxels(reference, reference.outside[2].size() - 1).codes.empty());
  // an index beyond 16 bits at 0.05 m
  reference.outside = at_all_sizes(voxels_of(std::vector<Vec3f>{{2000, 0, 0}}, 0.05));
  EXPECT_EQ(true_voxels(reference, 10).size_m, 0.10);
}

TEST(TrueSurface, ErrorsAreDistancesToTheStructureAlone) {
  World world;
  test::add_box(world.structure, {-1, -1, 0.5}, {2, 2, 2});
  world.obstacles = box_mesh(Box3(Vec3(3, -2, 0), Vec3(3.2, 2, 3)));
  const RayScene scene(world);
  const std::vector<Vec3f> points = {
      {1, 0, 1}, {1.0304F, 0, 1}, {1.6F, 0, 1}, {3, 0, 1}, {-6, 0, 1}};
  const std::vector<std::uint8_t> errors = {0, 30, 254, kNotOfStructure, 254};
  EXPECT_EQ(point_errors(scene, points, 1), errors);
  EXPECT_EQ(point_errors(scene, points, 3), errors);
}

TEST(CandidatePack, HoldsEachDecisionWithItsReasonsAndTerms) {
  TempFolder temp;
  RunRecord record = made_record();
  record.folder = temp.path();
  BytePack bytes;
  EXPECT_FALSE(pack_candidates(record, 10'000, bytes).has_value());
  Plan plan;
  plan.candidates = {{.view = {Vec3(4, 5, 6), 0.5}, .sampler = Sampler::agvs},
                     {.view = {Vec3(1, 2, 3), -1.5, 0.25}, .sampler = Sampler::agvs},
                     {.view = {Vec3(1, 2, 4), 1.5}, .sampler = Sampler::agvs}};
  plan.candidates[0].rejected = Rejection::collision;
  plan.candidates[1].score = {.value = 9.0, .information = 8.0, .distance = 0.5};
  plan.chosen = {1};
  CandidatesFile file(temp.path(), 1);
  file.write(1, plan);
  plan.chosen = {2};
  file.write(2, plan);
  file.finish();
  const auto packed = pack_candidates(record, 10'000, bytes);
  ASSERT_TRUE(packed.has_value());
  // the start is no decision
  EXPECT_EQ(read_back<std::uint32_t>(bytes, packed->begins),
            (std::vector<std::uint32_t>{0, 0, 3, 6}));
  constexpr auto kCollision = static_cast<std::uint8_t>(Rejection::collision);
  EXPECT_EQ(read_back<std::uint8_t>(bytes, packed->kind),
            (std::vector<std::uint8_t>{kCollision, kChosenCandidate, kValidCandidate, kCollision,
                                       kValidCandidate, kChosenCandidate}));
  const auto terms = read_back<float>(bytes, packed->terms);
  ASSERT_EQ(terms.size(), 20U);  // of four that were not rejected
  EXPECT_EQ(std::vector<float>(terms.begin(), terms.begin() + 5),
            (std::vector<float>{9.0F, 8.0F, 0.0F, 0.0F, 0.5F}));
  const auto angles = read_back<float>(bytes, packed->angles_rad);
  EXPECT_EQ(angles[2], -1.5F);
  EXPECT_EQ(angles[3], 0.25F);
  EXPECT_THROW(pack_candidates(record, 10, bytes), BadInput);
}

TEST(CandidatePack, CountsThoseThatAreTooManyWithThousandsSeparated) {
  TempFolder temp;
  RunRecord record = made_record();
  record.folder = temp.path();
  Plan plan;
  plan.candidates.assign(
      1'200,
      {.view = {Vec3(4, 5, 6), 0.5}, .sampler = Sampler::agvs, .rejected = Rejection::collision});
  CandidatesFile file(temp.path(), 1);
  file.write(1, plan);
  file.finish();
  BytePack bytes;
  try {
    pack_candidates(record, 10, bytes);
    FAIL();
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find(": 1,200 candidates"), std::string::npos);
  }
}

}  // namespace
}  // namespace gnbv
