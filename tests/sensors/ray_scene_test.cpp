#include "sensors/ray_scene.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "sensors/frames.hpp"
#include "tests/sensors/shapes.hpp"

namespace gnbv {
namespace {

using test::add_wall;
using test::world_of;

std::vector<Vec3f> random_directions(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<float> normal;
  std::vector<Vec3f> out;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = normal(generator);
    const float y = normal(generator);
    out.emplace_back(x, y, normal(generator));
  }
  return out;
}

World portable(World world) {
  world.is_portable = true;
  return world;
}

class RaySceneOfEither : public testing::TestWithParam<bool> {
 protected:
  static World world(TriangleMesh mesh, bool has_ground) {
    World made = world_of(std::move(mesh), has_ground);
    made.is_portable = GetParam();
    return made;
  }
  /// Where Embree's floats may decide otherwise than the brute force.
  static bool is_open(const test::BruteHit& hit) { return !GetParam() && hit.is_near_edge; }
};
INSTANTIATE_TEST_SUITE_P(RayScene, RaySceneOfEither, testing::Bool());

TEST_P(RaySceneOfEither, FirstHitNamesFaceGroundOrNothing) {
  TriangleMesh wall;
  add_wall(wall, -9.0, -1, 1, 0, 2);  // faces 0 and 1, behind
  add_wall(wall, 4.0, -1, 1, 0, 2);   // faces 2 and 3
  const RayScene scene(world(wall, true));
  const std::vector<Vec3f> directions = {{2, 0.4F, 0}, {2, -0.4F, 0.1F}, {0, 0, -0.5F}, {0, 0, 1}};
  std::vector<RayHit> hits(4);
  scene.first_hits({0, 0, 1}, directions, 0.0F, 100.0F, hits);
  EXPECT_EQ(hits[0].face, 2);                  // y = 0.8, z = 1: below the diagonal
  EXPECT_NEAR(hits[0].distance_m, 2.0, 1e-6);  // in units of the direction
  EXPECT_EQ(hits[1].face, 3);                  // y = -0.8, z = 1.2: above it
  EXPECT_EQ(hits[2].face, -2);
  EXPECT_NEAR(hits[2].distance_m, 2.0, 1e-6);
  EXPECT_EQ(hits[3].face, -1);
  EXPECT_EQ(hits[3].distance_m, kNoReturn);
}

TEST_P(RaySceneOfEither, HitsAndWhatBlocksLieBeyondNearAndUpToFar) {
  TriangleMesh walls;
  add_wall(walls, 2.0, -1, 1, -1, 1);
  add_wall(walls, 4.0, -1, 1, -1, 1);
  const RayScene scene(world(walls, false));
  const std::vector<Vec3f> ahead = {{1, 0.1F, 0.2F}};
  const auto distance = [&](float near_m, float far_m) {
    std::vector<RayHit> hits(1);
    scene.first_hits({0, 0, 0}, ahead, near_m, far_m, hits);
    return hits[0].distance_m;
  };
  EXPECT_FLOAT_EQ(distance(0.0F, 10.0F), 2.0F);
  EXPECT_FLOAT_EQ(distance(2.1F, 10.0F), 4.0F);
  EXPECT_EQ(distance(2.1F, 3.9F), kNoReturn);
  EXPECT_EQ(distance(0.0F, 1.9F), kNoReturn);
  for (const auto& [near_m, is_blocked] : {std::pair(3.9F, 1), std::pair(4.1F, 0)}) {
    std::vector<std::uint8_t> blocked(1);
    scene.find_blocked(kStructurePart, {{Vec3f(0, 0, 0)}}, ahead, near_m, kEndless, blocked);
    EXPECT_EQ(blocked[0], is_blocked);
  }
}

TEST_P(RaySceneOfEither, PacketsEqualBruteForceForAnyNumberOfRaysEachByItself) {
  const TriangleMesh soup = test::random_soup(80, 4.0, {0, 0, 0}, 3);
  const RayScene scene(world(soup, false));
  const Vec3f origin(0.3F, -0.2F, 0.1F);
  std::vector<RayHit> whole(1000);
  scene.first_hits(origin, random_directions(1000, 7), 0.0F, 1e6F, whole);
  for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 160U, 1000U}) {
    const std::vector<Vec3f> directions = random_directions(count, 7);
    std::vector<RayHit> hits(count);
    scene.first_hits(origin, directions, 0.0F, 1e6F, hits);
    for (std::size_t i = 0; i < count; ++i) {
      const test::BruteHit expected =
          test::brute_first_hit(soup, origin.cast<double>(), directions[i].cast<double>());
      if (is_open(expected)) continue;
      ASSERT_EQ(hits[i].face, expected.face) << i << " of " << count;
      if (expected.face < 0) continue;
      ASSERT_NEAR(hits[i].distance_m, expected.distance, 2e-5 * (1 + expected.distance)) << i;
    }
    for (std::size_t i = 0; i < count / 16 * 16; ++i) {  // to the bit, whatever packets follow
      ASSERT_EQ(hits[i].distance_m, whole[i].distance_m);
      ASSERT_EQ(hits[i].face, whole[i].face);
    }
  }
}

TEST_P(RaySceneOfEither, StructureBlocksEqualsBruteForceAndIgnoresTheGround) {
  const TriangleMesh soup = test::random_soup(150, 4.0, {0, 0, 0}, 17);
  const RayScene scene(world(soup, true));  // the ground cuts through the middle
  const std::size_t count = 1003;           // no multiple of 16
  const std::vector<Vec3f> directions = random_directions(count, 1);
  std::vector<Vec3f> origins = random_directions(count, 2);
  for (Vec3f& origin : origins) origin *= 3.0F;
  std::vector<std::uint8_t> blocked(count, 7);
  scene.find_blocked(kStructurePart, origins, directions, 1e-4F, kEndless, blocked);
  int sums[2] = {0, 0};
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_LE(blocked[i], 1);
    const test::BruteHit expected =
        test::brute_first_hit(soup, origins[i].cast<double>(), directions[i].cast<double>());
    if (is_open(expected) || expected.distance < 1e-3) continue;
    ASSERT_EQ(blocked[i], expected.face >= 0 ? 1 : 0) << i;
    ++sums[blocked[i]];
  }
  EXPECT_GT(sums[0], 100);
  EXPECT_GT(sums[1], 100);
}

/// Distance to a triangle as the least over its plane point, if inside, and its edges.
double slow_distance(const Vec3& p, const std::array<Vec3, 3>& t) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 edge = t[(i + 1) % 3] - t[i];
    const double s = std::clamp((p - t[i]).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (t[i] + s * edge - p).norm());
  }
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  const Vec3 foot = p - normal.dot(p - t[0]) * normal;
  for (std::size_t i = 0; i < 3; ++i) {
    if ((t[(i + 1) % 3] - t[i]).cross(foot - t[i]).dot(normal) < 0.0) return best;
  }
  return std::abs(normal.dot(p - t[0]));
}

TEST_P(RaySceneOfEither, DistanceToStructureEqualsBruteForceAndIgnoresTheGround) {
  const TriangleMesh soup = test::random_soup(50, 4.0, {0, 0, 6}, 29);
  const RayScene scene(world(soup, true));
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> coordinate(-8.0, 8.0);
  int beyond = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x = coordinate(generator);
    const double y = coordinate(generator);
    const Vec3 p_world_m(x, y, 6.0 + coordinate(generator));
    double expected_m = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
      expected_m = std::min(expected_m, slow_distance(p_world_m, face_corners_m(soup, f)));
    }
    // both in double: only the order of operations differs
    ASSERT_NEAR(scene.distance_to_structure_m(p_world_m, 100.0), expected_m, 1e-9) << i;
    const double limited_m = scene.distance_to_structure_m(p_world_m, 2.0);
    if (expected_m > 2.0) {
      ASSERT_TRUE(std::isinf(limited_m)) << i;
      ++beyond;
    } else {
      ASSERT_NEAR(limited_m, expected_m, 1e-9) << i;
    }
  }
  EXPECT_GT(beyond, 100);
  const RayScene ground(world_of({}, true));
  EXPECT_TRUE(std::isinf(ground.distance_to_structure_m({0, 0, 1}, 1e6)));
  EXPECT_TRUE(std::isinf(RayScene(world_of({}, false)).distance_to_structure_m({0, 0, 1}, 1.0)));
}

/// Along edges and through their middles, at faces that lie in one another, along axes but for
/// 1e-18.
std::vector<RayHit> awkward_hits(const RayScene& scene, const TriangleMesh& mesh) {
  std::vector<Vec3f> directions = random_directions(2000, 5);
  for (std::size_t face = 0; face < mesh.faces.size(); face += 11) {
    const auto& [a, b, c] = mesh.faces[face];
    const Vec3f &p = mesh.vertices_m[a], &q = mesh.vertices_m[b], &r = mesh.vertices_m[c];
    directions.insert(directions.end(), {p + q, q - r, p + q + r});
  }
  // of the poles' slivers
  std::erase_if(directions, [](const Vec3f& direction) { return direction.norm() < 1e-3F; });
  std::vector<RayHit> hits(directions.size());
  scene.first_hits({0, 0, 0}, directions, 0.0F, kEndless, hits);
  const std::vector<Vec3f> origins = random_directions(directions.size(), 6);
  hits.resize(2 * directions.size());
  scene.first_hits(origins, directions, 0.0F, kEndless, std::span(hits).subspan(directions.size()));
  return hits;
}

TEST(PortableRayScene, HitsAreTheSameBitsByEveryInstructionSetOfEmbree) {
  TriangleMesh mesh = test::random_soup(300, 3.0, {0, 0, 0}, 8);
  append(mesh, test::sphere({0, 0, 0}, 2.0));
  append(mesh, test::sphere({0, 0, 0}, 2.0));  // each face twice
  std::vector<RayHit> first;
  // one that the processor lacks is the next lower one
  for (const char* const isa : {"sse2", "sse4.2", "avx", "avx2", "avx512"}) {
    setenv("GNBV_EMBREE", fmt::format("max_isa={}", isa).c_str(), 1);
    const RayScene scene(portable(world_of(mesh, true)));
    const std::vector<RayHit> hits = awkward_hits(scene, mesh);
    if (first.empty()) first = hits;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      ASSERT_EQ(hits[i].face, first[i].face) << isa << ", ray " << i;
      ASSERT_EQ(hits[i].distance_m, first[i].distance_m) << isa << ", ray " << i;
    }
  }
  unsetenv("GNBV_EMBREE");
}

TEST(PortableRayScene, NoRayLeavesAClosedSurfaceAndOfTwoFacesTheFirstIsHit) {
  const TriangleMesh once = test::sphere({0, 0, 0}, 2.0);
  TriangleMesh twice = once;
  append(twice, once);
  const std::vector<RayHit> alone = awkward_hits(RayScene(portable(world_of(once, false))), once);
  const std::vector<RayHit> both = awkward_hits(RayScene(portable(world_of(twice, false))), once);
  for (std::size_t i = 0; i < alone.size() / 2; ++i) {  // from the middle
    ASSERT_GE(alone[i].face, 0) << i;
    ASSERT_EQ(both[i].face, alone[i].face) << i;
    ASSERT_EQ(both[i].distance_m, alone[i].distance_m) << i;
  }
}

}  // namespace
}  // namespace gnbv
