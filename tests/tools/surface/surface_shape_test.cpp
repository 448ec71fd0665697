// Laws of turning a cloud into a surface: normals face the sensor, the surface lies where the
// points lie, and nothing is left where there are none.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/score/escape_search.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/error.hpp"
#include "sim/mesh/mesh_lint.hpp"
#include "tests/sim/mesh/mesh_files.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/tools/surface/pictured_sheet.hpp"
#include "tools/surface/poisson_module.hpp"
#include "tools/surface/surface.hpp"
#include "tools/surface/trim.hpp"

namespace gnbv {
namespace {

constexpr float kRadius_m = 1.0F;

/// A unit sphere seen from all around, about 4.5 cm between points.
SeenPoints seen_sphere(float z_min_m = -2.0F) {
  SeenPoints seen;
  for (const Vec3f& direction : spread_directions(6000)) {
    if (direction.z() < z_min_m) continue;
    seen.points_world_m.push_back(kRadius_m * direction);
    seen.sensors_world_m.push_back(4.0F * direction + Vec3f(0.5F, 0.0F, 0.0F));
  }
  return seen;
}

TriangleMesh poisson(const OrientedCloud& cloud, int depth) {
  TriangleMesh mesh;
  poisson_module()(cloud.points_world_m, cloud.normals_world, {.depth = depth}, mesh);
  return mesh;
}

TEST(OrientedCloud, NormalsOfASpherePointToTheSensors) {
  SeenPoints from_inside = seen_sphere();
  for (Vec3f& sensor_m : from_inside.sensors_world_m) sensor_m = Vec3f(0.1F, 0, 0);
  for (const auto& [seen, side] : {std::pair(seen_sphere(), 1.0F), {from_inside, -1.0F}}) {
    const OrientedCloud cloud = oriented(seen, 2);
    ASSERT_EQ(cloud.points_world_m.size(), 6000U);
    for (std::size_t i = 0; i < cloud.points_world_m.size(); ++i) {
      EXPECT_GT(side * cloud.normals_world[i].dot(cloud.points_world_m[i]), 0.99F);
      EXPECT_NEAR(cloud.spacing_m[i], std::sqrt(4.0 * kPi / 6000.0), 0.01);
    }
  }
}

TEST(OrientedCloud, TheFacesOfAThinWedgeKeepTheirNormals) {
  // two planes through the y axis, 6 degrees from level, seen from above and from below
  const auto slope = static_cast<float>(std::tan(deg_to_rad(6.0)));
  SeenPoints seen;
  for (int i = 1; i <= 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      const float x_m = 0.02F * static_cast<float>(i);
      for (const float side : {1.0F, -1.0F}) {
        seen.points_world_m.emplace_back(x_m, 0.02F * static_cast<float>(j), side * slope * x_m);
        seen.sensors_world_m.emplace_back(0.5F, 0.4F, side * 3.0F);
      }
    }
  }
  const OrientedCloud cloud = oriented(seen, 1);
  for (std::size_t i = 0; i < cloud.points_world_m.size(); ++i) {
    const float side = cloud.points_world_m[i].z() > 0.0F ? 1.0F : -1.0F;
    const Vec3f normal = Vec3f(-slope, 0.0F, side).normalized();
    EXPECT_GT(cloud.normals_world[i].dot(normal), 0.9999F);
  }
}

TEST(OrientedCloud, PointsOnALineHaveNoNormal) {
  SeenPoints seen;
  for (int i = 0; i < 30; ++i) {
    seen.points_world_m.emplace_back(0.1F * static_cast<float>(i), 0.0F, 0.0F);
    seen.sensors_world_m.emplace_back(0.0F, 0.0F, 5.0F);
  }
  EXPECT_TRUE(oriented(seen, 1).points_world_m.empty());
}

TEST(Poisson, SurfaceOfASphereIsTheSphereWatertightAndOutward) {
  const TriangleMesh mesh = poisson(oriented(seen_sphere(), 2), 6);
  ASSERT_GT(mesh.faces.size(), 1000U);
  EXPECT_EQ(lint_mesh(mesh).open_edges, 0U);
  EXPECT_NEAR(test::volume_m3(mesh), 4.0 / 3.0 * kPi, 0.02);
  for (const Vec3f& p_m : mesh.vertices_m) EXPECT_NEAR(p_m.norm(), kRadius_m, 0.005F);
}

TEST(Trim, AHalfSphereEndsAtItsRim) {
  const OrientedCloud cloud = oriented(seen_sphere(0.0F), 2);
  const TriangleMesh closed = poisson(cloud, 6);
  const TriangleMesh open = trimmed(closed, cloud, {}, 2);
  EXPECT_GT(surface_area_m2(closed), 2.5 * kPi);  // Poisson spans the opening
  EXPECT_GT(lint_mesh(open).open_edges, 100U);    // the rim is 6.3 m of cells of 4 cm
  double lowest_m = 1.0;
  std::size_t near = 0;
  for (const Vec3f& p_m : open.vertices_m) {
    lowest_m = std::min(lowest_m, static_cast<double>(p_m.z()));
    // 2 spacings of 4.6 cm, which look larger by sqrt(2) at a rim, where half of them are missing
    EXPECT_NEAR(p_m.norm(), kRadius_m, 0.135F);
    near += std::abs(p_m.norm() - kRadius_m) < 0.01F ? 1 : 0;
  }
  EXPECT_GT(near, open.vertices_m.size() * 9 / 10);
  EXPECT_LT(lowest_m, 0.03);
  EXPECT_GT(lowest_m, -0.135);
  EXPECT_NEAR(surface_area_m2(open), 2.0 * kPi, 0.135 * 2.0 * kPi);
  const TriangleMesh tight = trimmed(closed, cloud, {.reach_m = 0.05}, 2);
  EXPECT_LT(surface_area_m2(tight), surface_area_m2(open));
}

/// A disc of 0.1 m at that height around the z axis, in rings 1 cm apart.
TriangleMesh disc(float z_m) {
  TriangleMesh mesh;
  constexpr std::uint32_t kSides = 24;
  for (std::uint32_t ring = 0; ring <= 10; ++ring) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const float angle = static_cast<float>(2.0 * kPi * i / kSides);
      const float r_m = 0.01F * static_cast<float>(ring);
      mesh.vertices_m.emplace_back(r_m * std::cos(angle), r_m * std::sin(angle), z_m);
      if (ring == 0) continue;
      const std::uint32_t inner = (ring - 1) * kSides + i;
      const std::uint32_t next = (ring - 1) * kSides + (i + 1) % kSides;
      mesh.faces.push_back({inner, inner + kSides, next + kSides});
      mesh.faces.push_back({inner, next + kSides, next});
    }
  }
  return mesh;
}

/// Points around a disc of 0.1 m, all with a spacing of 6 cm, with normals as told.
OrientedCloud points_around_disc(bool is_tube) {
  OrientedCloud cloud;
  for (int layer = 0; layer < 4; ++layer) {
    for (int i = 0; i < 24; ++i) {
      const float angle = static_cast<float>(2.0 * kPi * i / 24);
      const Vec3f out(std::cos(angle), std::sin(angle), 0.0F);
      const float away_m = 0.05F * static_cast<float>(layer);
      cloud.points_world_m.push_back(is_tube ? Vec3f(0.1F * out - away_m * Vec3f::UnitZ())
                                             : Vec3f((0.1F + away_m) * out));
      cloud.normals_world.push_back(is_tube ? out : Vec3f(Vec3f::UnitZ()));
      cloud.spacing_m.push_back(0.06F);
    }
  }
  return cloud;
}

/// Both lie 0.1 m from any point, and points reach 0.12 m.
TEST(Trim, ACapOverATubeGoesAndAHoleOfItsSizeInAWallIsClosed) {
  const double whole_m2 = surface_area_m2(disc(0.0F));
  const double in_wall_m2 = surface_area_m2(trimmed(disc(0.0F), points_around_disc(false), {}, 1));
  EXPECT_NEAR(in_wall_m2, whole_m2, 1e-6);
  const double cap_m2 = surface_area_m2(trimmed(disc(0.0F), points_around_disc(true), {}, 1));
  EXPECT_LT(cap_m2, 0.9 * whole_m2);
  const TrimSettings plain{.reach_m = 0.12};  // which asks for that distance and no other
  EXPECT_NEAR(surface_area_m2(trimmed(disc(0.0F), points_around_disc(true), plain, 1)), whole_m2,
              1e-6);
}

/// Two triangles of the unit square.
TriangleMesh square() {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(Trim, CutsExactlyAlongTheLevelOfALinearField) {
  const std::vector<float> x = {0.0F, 1.0F, 1.0F, 0.0F};
  for (const float level : {0.25F, 0.5F, 0.8F}) {
    const TriangleMesh cut = cut_at_level(square(), x, level);
    EXPECT_NEAR(surface_area_m2(cut), level, 1e-6);
    for (const auto& f : cut.faces) {
      for (const std::uint32_t v : f) EXPECT_LE(cut.vertices_m[v].x(), level + 1e-6F);
      const Vec3f a = cut.vertices_m[f[0]];
      EXPECT_GT((cut.vertices_m[f[1]] - a).cross(cut.vertices_m[f[2]] - a).z(), 0.0F);
    }
  }
  EXPECT_EQ(cut_at_level(square(), x, 2.0F).faces, square().faces);
  EXPECT_TRUE(cut_at_level(square(), x, -1.0F).faces.empty());
}

TEST(Trim, SmallPartsGoTheRestKeepsItsOrder) {
  TriangleMesh mesh = square();
  mesh.vertices_m.insert(mesh.vertices_m.begin(), {{5, 5, 5}, {5.1F, 5, 5}, {5, 5.1F, 5}});
  mesh.faces = {{0, 1, 2}, {3, 4, 5}, {3, 5, 6}, {4, 4, 5}};
  const TriangleMesh kept = without_scraps(mesh, 0.01);
  EXPECT_EQ(kept.faces, square().faces);
  EXPECT_EQ(kept.vertices_m, square().vertices_m);
  EXPECT_EQ(without_scraps(mesh, 0.0).faces.size(), 3U);  // but the one without area
}

TEST(SurfaceDepth, HasCellsOfTheWantedSize) {
  const Box3 box(Vec3::Zero(), Vec3(30, 10, 5));
  EXPECT_EQ(depth_for(box, 33.0 / 256), 8);
  EXPECT_EQ(depth_for(box, 1e-4), 10);
  EXPECT_EQ(depth_for(box, 100.0), kMinDepth);
}

/// Of the run of tests/support/made_run.hpp.
class SeenPointsOfRun : public testing::Test {
 protected:
  SeenPoints seen() const { return seen_points(record_, cloud_, 2); }
  Vec3f at_view(std::size_t view) const {
    return record_.views[view].decision.view.p_world_m.cast<float>();
  }

  TempFolder temp_;
  RunRecord record_ = [this] {
    write_made_run(temp_.path());
    return read_run(temp_.path());
  }();
  RunCloud cloud_ = read_run_cloud(record_);
};

TEST_F(SeenPointsOfRun, ViewsPointsComeFromTheViewsAndCoveredProfilePointsGo) {
  cloud_.points_world_m = {{0, 0, 1}, {3, 0, 1}, {0.05F, 0, 1}, {1, 1, 1}, {0, 0, 2}, {1, 1, 2}};
  ASSERT_EQ(seen().points_world_m.size(), 5U);  // the first lies within a leaf of the third
  EXPECT_EQ(seen().points_world_m[0], cloud_.points_world_m[1]);
  EXPECT_EQ(seen().sensors_world_m[0], Vec3f(4, -4, 1));  // nearest pose of the profile
  for (std::size_t i = 1; i < 5; ++i) {
    const std::size_t view = i == 1 ? 0 : (i == 4 ? 2 : 1);
    EXPECT_LT((seen().sensors_world_m[i] - at_view(view)).norm(), 0.5F) << i;
  }
}

TEST_F(SeenPointsOfRun, WhatAFlyingCameraSawCameFromTheNearestPoseOfItsLeg) {
  cloud_.points_world_m = {{0, 0, 1}, {1, 0, 1}, {-2, 4, 2}, {-4, 2, 2.1F}, {-3, -4, 3}, {2, 2, 2}};
  const auto sensor = [&](std::size_t point) {
    const SeenPoints all = seen();
    return all.sensors_world_m.at(point + all.points_world_m.size() - cloud_.points_world_m.size());
  };
  EXPECT_LT((sensor(4) - at_view(1)).norm(), 0.5F);
  record_.scenario.cameras[0].rate_hz = 10.0;
  EXPECT_EQ(sensor(4), Vec3f(-4, -4, 3));  // at 4 s, on the leg from 3 s to there
  EXPECT_EQ(sensor(2), Vec3f(-4, 4, 2));   // at 3 s, where the first leg ends
}

TEST_F(SeenPointsOfRun, WhatLiesBehindAPoseHidesNothingFromIt) {
  // the first point was seen on the profile, 1 m away; another one lies 2 m beyond that pose
  cloud_.points_world_m = {{0, -3, 1}, {0, -6, 1}};
  cloud_.profile_points = 2;
  cloud_.view_points = {2, 2, 2};
  record_.path = {made_sample(0, {0, -4, 1}), made_sample(1, {0, 1.5, 1})};
  EXPECT_EQ(seen().sensors_world_m[0], Vec3f(0, -4, 1));
  cloud_.points_world_m[1] = {0, -3.5F, 1};  // between them it does
  EXPECT_EQ(seen().sensors_world_m[0], Vec3f(0, 1.5F, 1));
}

TEST_F(SeenPointsOfRun, WhatCameAfterTheLastViewIsSeenFromThere) {
  record_.path.push_back(made_sample(6, {4, 4, 4}));
  cloud_.points_world_m.emplace_back(3.0F, 3.0F, 3.0F);
  EXPECT_EQ(seen().sensors_world_m.back(), Vec3f(4, 4, 4));
  record_.views.clear();  // it ended on its way to the first view
  cloud_.view_points.clear();
  record_.profile_end_s = 1.0;
  EXPECT_EQ(seen().sensors_world_m.size(), seen().points_world_m.size());
  EXPECT_EQ(seen().sensors_world_m.back(), Vec3f(4, 4, 4));
}

TEST(SurfaceScore, TheTrueSurfaceIsPerfectAndHalfOfItHasHalfTheRecall) {
  World truth{.structure = poisson(oriented(seen_sphere(), 2), 5), .has_ground = false};
  for (Vec3f& p_m : truth.structure.vertices_m) p_m.z() += 2.0F;
  const SurfaceScore all = score_surface(truth.structure, truth, {.floor_z_m = 0.3}, 2);
  for (const DistanceScore& at : all.distances.at) EXPECT_EQ(at.f, 1.0);
  EXPECT_LT(all.distances.chamfer_m, 1e-4);
  std::vector<float> z_m;
  for (const Vec3f& p_m : truth.structure.vertices_m) z_m.push_back(p_m.z());
  const SurfaceScore half =
      score_surface(cut_at_level(truth.structure, z_m, 2.0F), truth, {.floor_z_m = 0.3}, 1);
  EXPECT_EQ(half.distances.at[0].precision, 1.0);
  EXPECT_NEAR(half.distances.at[0].recall, 0.51, 0.01);  // and 2 cm of 2 m
}

TEST(SurfaceScore, SamplesLieEvenlyByArea) {
  TriangleMesh mesh = square();
  mesh.vertices_m[2] = mesh.vertices_m[3] = Vec3f(0, 3, 0);  // areas 1.5 and 0
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  mesh.vertices_m.push_back({-1, 0, 0});
  mesh.faces.push_back({0, 3, 4});  // area 1.5
  const std::vector<Vec3f> samples = samples_by_area(mesh, 20000, 7);
  Vec3f mean_m = Vec3f::Zero();
  for (const Vec3f& p : samples) mean_m += p / 20000.0F;
  EXPECT_NEAR(mean_m.x(), 0.0F, 0.01F);  // centroid of both triangles
  EXPECT_NEAR(mean_m.y(), 1.0F, 0.02F);
  EXPECT_EQ(samples, samples_by_area(mesh, 20000, 7));
}

/// What shape_of() says of points seen from above; empty when it makes a surface of them.
std::string refusal_of(std::vector<Vec3f> points_m, double leaf_m) {
  SeenPoints seen{std::move(points_m), {}};
  seen.sensors_world_m.assign(seen.points_world_m.size(), Vec3f(0, 0, 9));
  return test::fault_of([&] {
    shape_of(oriented(seen, 1), leaf_m, {}, "cloud.ply", 1, [](double, const std::string&) {});
  });
}

TEST(SurfaceShape, PointsThatHoldNoSurfaceAreBadInput) {
  std::vector<Vec3f> line;
  std::vector<Vec3f> patch;
  for (int i = 0; i < 100; ++i) {
    if (i < 5) line.emplace_back(i, 0, 0);
    patch.emplace_back(0.01F * static_cast<float>(i % 10), 0.01F * static_cast<float>(i / 10), 0);
  }
  for (std::size_t count = 0; count <= line.size(); ++count) {
    const std::string refusal =
        refusal_of({line.begin(), line.begin() + static_cast<long>(count)}, 0.1);
    EXPECT_NE(refusal.find("cloud.ply: its points lie on no surface"), std::string::npos);
  }
  // 0.1 m by 0.1 m are a part too small for leaves of 0.1 m: no --trim-m helps
  const std::string refusal = refusal_of(patch, 0.1);
  EXPECT_NE(refusal.find("scraps"), std::string::npos) << refusal;
  EXPECT_EQ(refusal.find("--trim-m"), std::string::npos);
  EXPECT_EQ(refusal_of(patch, 0.005), "");
}

TEST(Decimation, KeepsTheSphereWithinItsToleranceAndAPlaneInAHandfulOfFaces) {
  const TriangleMesh fine = poisson(oriented(seen_sphere(), 2), 6);
  constexpr double kTolerance_m = 0.01;
  const TriangleMesh coarse = decimated(fine, kTolerance_m);
  EXPECT_LT(coarse.faces.size(), fine.faces.size() / 2);
  const RayScene scene(World{.structure = coarse, .has_ground = false});
  for (const Vec3f& p_m : fine.vertices_m) {
    EXPECT_LT(scene.distance_to_structure_m(p_m.cast<double>(), 1.0), 3.0 * kTolerance_m);
  }
  EXPECT_EQ(decimated(fine, 0.0).faces, fine.faces);
  EXPECT_LE(decimated(sheet(20.0F, 20), 0.01).faces.size(), 80U);
}

}  // namespace
}  // namespace gnbv
