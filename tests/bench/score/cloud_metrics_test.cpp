#include "bench/score/cloud_metrics.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "bench/score/cloud_faults.hpp"
#include "bench/score/surface_samples.hpp"
#include "sim/core/error.hpp"
#include "tests/bench/shapes.hpp"
#include "tests/support/fault.hpp"

namespace gnbv {
namespace {

constexpr double kSide_m = 4.0;

World sheet() {
  World world;
  test::add_sheet(world.structure, Vec3(0, 0, 1), Vec3(kSide_m, 0, 0), Vec3(0, kSide_m, 0));
  return world;
}

/// A grid of points every `spacing_m`, `height_m` above the sheet, in the middles of their cells.
std::vector<Vec3f> points_above_sheet(double spacing_m, double height_m) {
  std::vector<Vec3f> points;
  for (double x = 0.5 * spacing_m; x < kSide_m; x += spacing_m) {
    for (double y = 0.5 * spacing_m; y < kSide_m; y += spacing_m) {
      points.push_back(Vec3(x, y, 1.0 + height_m).cast<float>());
    }
  }
  return points;
}

CloudDistances distances(const RayScene& scene, std::span<const Vec3f> cloud,
                         std::span<const Vec3f> samples) {
  return cloud_distances(distances_to_structure_m(scene, cloud, 2), cloud, samples, 2);
}

TEST(CloudDistances, OfAParallelSheetAreItsHeightUpToAMetre) {
  const World world = sheet();
  const RayScene scene(world);
  const std::vector<Vec3f> samples = points_above_sheet(0.05, 0.0);
  for (const double height_m : {0.0, 0.01, 0.03, 0.07, 0.2, 0.9, 1.5, 50.0, 5000.0}) {
    const CloudDistances d = distances(scene, points_above_sheet(0.05, height_m), samples);
    const double counted_m = std::min(height_m, kFarthest_m);
    // coordinates are floats
    EXPECT_NEAR(d.accuracy_m, counted_m, 1e-6);
    EXPECT_NEAR(d.completeness_m, counted_m, 1e-6);
    EXPECT_NEAR(d.chamfer_m, counted_m, 1e-6);
    for (const DistanceScore& at : d.at) {
      const double expected = height_m < at.distance_m ? 1.0 : 0.0;
      EXPECT_EQ(at.precision, expected) << height_m << " " << at.distance_m;
      EXPECT_EQ(at.recall, expected);
      EXPECT_EQ(at.f, expected);
    }
  }
}

TEST(CloudDistances, OfNothingAreTheFarthest) {
  const World world = sheet();
  const RayScene scene(world);
  const std::vector<Vec3f> points = points_above_sheet(0.5, 0.0);
  const CloudDistances no_cloud = distances(scene, {}, points);
  EXPECT_EQ(no_cloud.at[2].precision, 0.0);
  EXPECT_EQ(no_cloud.at[2].recall, 0.0);
  EXPECT_EQ(no_cloud.chamfer_m, kFarthest_m);
  const CloudDistances no_surface = distances(scene, points, {});
  EXPECT_EQ(no_surface.at[2].precision, 1.0);
  EXPECT_EQ(no_surface.at[2].recall, 0.0);
}

/// Points around a box with a lid missing, some on it, some far away.
std::vector<Vec3f> random_points(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(-1.5F, 3.5F);
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  }
  return points;
}

TEST(CloudDistances, EqualBruteForce) {
  World world;
  test::add_box(world.structure, Vec3(0, 0, 0), Vec3(2, 1, 1.5), false);
  const RayScene scene(world);
  const std::vector<Vec3f> cloud = random_points(20000, 7);
  const std::vector<Vec3f> samples = random_points(1500, 8);

  // to the surface: its samples are at most 1.2 spacings from any point of it
  constexpr double kSpacing_m = 0.02;
  const auto dense = sample_surface(world.structure, kSpacing_m);
  double accuracy_m = 0.0;
  constexpr std::size_t kSome = 300;
  for (std::size_t i = 0; i < kSome; ++i) {
    double nearest_m = kFarthest_m;
    for (const SurfaceSample& s : dense) {
      nearest_m = std::min(nearest_m, static_cast<double>((s.p_world_m - cloud[i]).norm()));
    }
    accuracy_m += nearest_m / kSome;
  }
  const std::span<const Vec3f> some = std::span(cloud).first(kSome);
  EXPECT_NEAR(distances(scene, some, samples).accuracy_m, accuracy_m, 1.2 * kSpacing_m);

  // to the cloud: exactly
  double completeness_m = 0.0;
  std::array<std::size_t, 3> near{};
  for (const Vec3f& sample : samples) {
    double nearest_m = kFarthest_m;
    for (const Vec3f& p : cloud) {
      nearest_m = std::min(nearest_m, (p - sample).cast<double>().norm());
    }
    completeness_m += nearest_m / static_cast<double>(samples.size());
    for (std::size_t i = 0; i < 3; ++i) {
      if (nearest_m < kScoreDistances_m[i]) ++near[i];
    }
  }
  const CloudDistances d = distances(scene, cloud, samples);
  EXPECT_NEAR(d.completeness_m, completeness_m, 1e-6);
  for (std::size_t i = 0; i < 3; ++i) {
    const double p = d.at[i].precision, r = d.at[i].recall;
    EXPECT_EQ(r, static_cast<double>(near[i]) / static_cast<double>(samples.size()));
    EXPECT_NEAR(d.at[i].f, 2.0 * p * r / (p + r), 1e-12);
  }
  EXPECT_GT(near[2], near[1]);
  EXPECT_GT(near[1], 0U);
}

TEST(CloudDensity, IsTheMeanOfTheVoxelsAndTheirSpread) {
  std::vector<Vec3f> points(3, Vec3f(0.1F, 0.1F, 0.1F));
  points.insert(points.end(), 5, Vec3f(-0.1F, 0.1F, 0.1F));
  const CloudDensity two = cloud_density(points, 0.2);
  EXPECT_EQ(two.voxel_m, 0.2);
  EXPECT_EQ(two.mean_points, 4.0);
  EXPECT_NEAR(two.variation, 1.0 / 4.0, 1e-12);
  const CloudDensity even = cloud_density(points_above_sheet(0.05, 0.01), 0.2);
  EXPECT_EQ(even.mean_points, 16.0);
  EXPECT_NEAR(even.variation, 0.0, 1e-7);
  EXPECT_EQ(cloud_density({}, 0.2).mean_points, 0.0);
}

constexpr double kFloor_z_m = 0.3;
const Box3 kStructure(Vec3(-30, -25, 1), Vec3(30, 25, 17));

const RayScene& scene() {
  static const RayScene made = [] {
    World world;
    test::add_box(world.structure, kStructure.min(), kStructure.sizes());
    return RayScene(world);
  }();
  return made;
}

/// The corners of the structure's box a thousand times, shrunk towards the origin a little further
/// each time, and scaled.
std::vector<Vec3f> cloud_scaled_by(double scale) {
  std::vector<Vec3f> points;
  for (int i = 0; i < 1000; ++i) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p = kStructure.corner(static_cast<Box3::CornerType>(corner));
      points.push_back((scale * (1.0 - 1e-4 * i) * p).cast<float>());
    }
  }
  return points;
}

std::string complaint_of(const std::vector<Vec3f>& cloud) {
  return test::fault_of([&] { scorable_points("a.ply", cloud, kFloor_z_m, scene(), kStructure); });
}

bool complains(const std::vector<Vec3f>& cloud, const std::string& words) {
  return test::says(complaint_of(cloud), {"a.ply: ", words});
}

/// Of a part of any size: a small one is no sign of another unit.
TEST(CloudFaults, NoneInMetresWithAFewStraysOrOfASmallPart) {
  std::vector<Vec3f> whole = cloud_scaled_by(1.0);
  for (int i = 0; i < 20; ++i) whole.emplace_back(40000.0F, 0.0F, 1.0F);
  EXPECT_EQ(complaint_of(whole), "");
  for (const double size_m : {0.0, 0.06, 0.1, 0.6, 1.0, 6.0}) {
    std::vector<Vec3f> cloud;
    for (int i = 0; i <= 100; ++i) {
      cloud.push_back((kStructure.min() + 0.01 * i * Vec3(size_m, size_m, 0)).cast<float>());
    }
    EXPECT_EQ(complaint_of(cloud), "") << size_m;
  }
}

TEST(CloudFaults, FarFromTheMeshTheUnitIsGuessedOrTheFrameNamed) {
  std::vector<Vec3f> small = cloud_scaled_by(0.001);
  for (Vec3f& p : small) p.z() += 9.0F;  // the box's middle is far from its sides
  const std::vector<Vec3f> elsewhere = {Vec3f(500, 0, 1), Vec3f(501, 2, 3)};
  const std::vector<Vec3f> map_grid = {Vec3f(500'000, 5'000'000, 1), Vec3f(500'010, 5'000'020, 3)};
  for (const auto& [cloud, guess] :
       {std::pair(cloud_scaled_by(1000.0), "looks like millimetres: scale the cloud by 0.001"),
        {cloud_scaled_by(400.0), "looks like millimetres"},
        {cloud_scaled_by(100.0), "looks like centimetres: scale the cloud by 0.01"},
        {small, "the mesh looks like millimetres: add --set structure.file.scale="},
        {elsewhere, "501.00, 2.00, 3.00"},
        {elsewhere, "30.00, 25.00, 17.00"},
        {elsewhere, "another frame"},
        {map_grid, "a map grid's: --offset-m=-500005,-5000010,0"}}) {
    EXPECT_TRUE(complains(cloud, "no point within 1 m of the mesh")) << guess;
    EXPECT_TRUE(complains(cloud, guess)) << guess;
  }
  // one point at the farthest that is not lost is enough
  std::vector<Vec3f> one_near = elsewhere;
  one_near.emplace_back(30.99F, 0.0F, 9.0F);
  EXPECT_EQ(complaint_of(one_near), "");
  one_near.back().x() = 31.01F;
  EXPECT_NE(complaint_of(one_near), "");
}

TEST(CloudFaults, EmptyNotFiniteAndTooFarArePointedAt) {
  EXPECT_EQ(complaint_of({}), "a.ply: has no points");
  std::vector<Vec3f> cloud = cloud_scaled_by(1.0);
  cloud[3].z() = -5.0F;  // left out, yet the others keep their numbers
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity(), 60000.0F}) {
    cloud[77].y() = wrong;
    const char* const what = wrong == 60000.0F ? "too far" : "not finite";
    EXPECT_TRUE(complains(cloud, "point 77 ")) << complaint_of(cloud);
    EXPECT_TRUE(complains(cloud, what)) << complaint_of(cloud);
    EXPECT_THROW(need_voxels("a.ply", cloud), BadInput);
  }
  cloud[77].y() = 20000.0F;
  EXPECT_NO_THROW(need_voxels("a.ply", cloud));
  EXPECT_THROW(need_voxels("a.ply", cloud, 0.01), BadInput);
  cloud[77].y() = 0.0F;
  EXPECT_NO_THROW(need_voxels("a.ply", cloud, 0.01));
  EXPECT_NO_THROW(need_voxels("a.ply", {}));
}

TEST(ScorablePoints, AreAllThatDoNotLieBelowTheFloorAndItsReachInTheirOrder) {
  const std::vector<Vec3f> kept = {Vec3f(30, 0, 9), Vec3f(0, 0, 0.29986F), Vec3f(-30, 0, 2)};
  std::vector<Vec3f> cloud = kept;
  cloud.insert(cloud.begin() + 1, Vec3f(0, 0, 0.29984F));
  cloud.emplace_back(0.0F, 60000.0F, -60000.0F);  // lost under the floor, whatever else it is
  EXPECT_EQ(scorable_points("a.ply", cloud, kFloor_z_m, scene(), kStructure), kept);
  EXPECT_TRUE(complains({Vec3f(0, 0, 0), Vec3f(1, 0, 0)}, "all 2 points lie below z = 0.3 m"));
  // ground beside the structure does not make up for the rest being elsewhere
  EXPECT_TRUE(complains({Vec3f(30, 0, 0.2F), Vec3f(500, 0, 9)}, "no point within 1 m"));
}

}  // namespace
}  // namespace gnbv
