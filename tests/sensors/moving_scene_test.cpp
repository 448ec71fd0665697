// Bodies that move, as sensors see them: a world in which they stand where they are then.
#include <gtest/gtest.h>

#include "sensors/capture.hpp"
#include "tests/sensors/shapes.hpp"

namespace gnbv {
namespace {

TEST(BodyMotion, IsAtEachCornerAfterTheWayThere) {
  BodyMotion motion{.offsets_m = {{3, 0, 0}, {3, 4, 0}}, .speed_m_s = 0.5, .loop = true};
  EXPECT_DOUBLE_EQ(motion.length_m(), 3.0 + 4.0 + 5.0);
  EXPECT_TRUE(motion.offset_at(0.0).isZero(0.0));
  EXPECT_TRUE(motion.offset_at(3.0).isApprox(Vec3(1.5, 0, 0)));
  EXPECT_TRUE(motion.offset_at(10.0).isApprox(Vec3(3, 2, 0)));
  EXPECT_TRUE(motion.offset_at(19.0).isApprox(Vec3(1.5, 2, 0)));  // half way back
  EXPECT_TRUE(motion.offset_at(24.0 + 3.0).isApprox(Vec3(1.5, 0, 0)));
  motion.loop = false;
  EXPECT_TRUE(motion.offset_at(1e6).isApprox(Vec3(3, 4, 0)));
}

/// Two bodies among what stands, and the same world with them standing where they are at `time_s`.
struct Worlds {
  World moving, standing;
  explicit Worlds(double time_s) {
    moving = test::world_of(test::random_soup(40, 3.0, {0, 0, 4}, 1), true);
    moving.obstacles = test::random_soup(20, 2.0, {4, 0, 4}, 2);
    moving.movers = {{test::sphere({-2, 0, 3}, 0.8), {{{4, 0, 0}, {4, 3, 1}}, 1.5}},
                     {test::random_soup(10, 1.0, {0, 5, 3}, 3), {{{0, -8, 0}}, 2.0, false}}};
    standing = moving;
    standing.movers.clear();
    for (MovingBody mover : moving.movers) {
      for (Vec3f& p_m : mover.mesh.vertices_m) {
        p_m += mover.motion.offset_at(time_s).cast<float>();
      }
      append(standing.obstacles, mover.mesh);
    }
  }
};

TEST(MovingScene, EveryRayMeetsWhatStandsThereThen) {
  for (const double time_s : {0.0, 1.3, 2.9, 7.0}) {
    const Worlds worlds(time_s);
    const RayScene at_rest(worlds.moving), expected(worlds.standing);
    const RayScene now = at_rest.at(time_s);
    CameraConfig config{.width_px = 96, .height_px = 72, .range_max_m = 20.0};
    for (const DepthNoise noise : {DepthNoise::none, DepthNoise::nguyen}) {  // both ways to trace
      config.noise.model = noise;
      const CameraModel camera = make_camera_model(config);
      const Isometry T = T_world_body({{-6, -1, 3.5}, 0.1});
      const DepthFrame ours = capture_depth(now, camera, 0, T, {1, 2}, 1);
      const DepthFrame theirs = capture_depth(expected, camera, 0, T, {1, 2}, 1);
      std::size_t other = 0, met = 0;
      for (std::size_t i = 0; i < ours.depth_m.size(); ++i) {
        const float a = ours.depth_m[i], b = theirs.depth_m[i];
        other += !(std::abs(a - b) <= 1e-3F) && !(a == b || (std::isnan(a) && std::isnan(b)));
        met += std::isfinite(b);
      }
      EXPECT_LE(other, 4U) << time_s;  // float32 along edges, which the shift rounds otherwise
      EXPECT_GT(met, 500U);
    }
    const ColourFrame ours =
        capture_colour(now, make_camera_model(config), 0, T_world_body({{-6, -1, 3.5}, 0.1}), 1);
    const ColourFrame theirs = capture_colour(expected, make_camera_model(config), 0,
                                              T_world_body({{-6, -1, 3.5}, 0.1}), 1);
    std::size_t other = 0;  // with shadows
    for (std::size_t i = 0; i < ours.rgb.size(); ++i) other += ours.rgb[i] != theirs.rgb[i];
    EXPECT_LE(other, ours.rgb.size() / 100) << time_s;
  }
}

TEST(MovingScene, AtRestNothingThatMovesIsThereAndItsWaysAreSurroundings) {
  World world = test::world_of({}, false);
  world.movers = {{box_mesh({Vec3(0, 0, 0), Vec3(1, 1, 1)}), {{{10, 0, 0}}, 1.0, true, true}}};
  const RayScene scene(world);
  const std::array<Vec3f, 1> along = {Vec3f::UnitX()};
  std::array<RayHit, 1> hit{};
  scene.first_hits(Vec3f(-1, 0.5F, 0.5F), along, 0.0F, 100.0F, hit);
  EXPECT_EQ(hit[0].face, kNoFace);
  scene.at(4.0).first_hits(Vec3f(-1, 0.5F, 0.5F), along, 0.0F, 100.0F, hit);
  EXPECT_NEAR(hit[0].distance_m, 5.0, 1e-5);
  EXPECT_TRUE(std::isinf(scene.clearance_m({5, 0.5, 1.2}, 9.0)));
  EXPECT_NEAR(scene.distance_to_surroundings_m({5.5, 0.5, 1.2}, 9.0), 0.2, 1e-6);
  EXPECT_NEAR(scene.distance_to_known_movers_m({5.5, 0.5, 1.2}, 5.0, 9.0), 0.2, 1e-6);
  EXPECT_NEAR(scene.distance_to_known_movers_m({5.5, 0.5, 1.2}, 1.0, 9.0), std::hypot(3.5, 0.2),
              1e-6);
}

/// Brute force: the distance at every two centimetres of the way, whatever is near.
TEST(MovingScene, SurroundingsAreTheNearestOfAllPlacesOfABody) {
  for (const bool loop : {true, false}) {
    const std::vector<Vec3> corners = {{3, 0, 0}, {3, 0, 0}, {3, 4, 1}, {-2, 4, 1}};
    World world = test::world_of({}, false);
    world.movers = {{test::random_soup(20, 1.0, {0, 0, 0}, 5), {corners, 1.0, loop}}};
    World still = test::world_of({}, false);
    still.obstacles = world.movers[0].mesh;
    const RayScene scene(world), standing(still);
    const BodyMotion& motion = world.movers[0].motion;
    int near = 0;
    for (int i = 0; i < 60; ++i) {
      const Vec3 p_m(0.2 * i - 6.0, 0.37 * (i % 17) - 2.0, 0.6 * (i % 5) - 1.0);
      double nearest_m = std::numeric_limits<double>::infinity();
      for (int k = 0; 0.02 * (k - 1) < motion.length_m(); ++k) {
        const Vec3 offset_m = motion.offset_after(std::min(0.02 * k, motion.length_m()));
        nearest_m = std::min(nearest_m, standing.distance_m(kObstaclePart, p_m - offset_m, 0.5));
      }
      EXPECT_EQ(scene.distance_to_surroundings_m(p_m, 0.5), nearest_m) << p_m.transpose();
      near += std::isfinite(nearest_m) ? 1 : 0;
    }
    EXPECT_GT(near, 5);
    EXPECT_LT(near, 55);
  }
}

}  // namespace
}  // namespace gnbv
