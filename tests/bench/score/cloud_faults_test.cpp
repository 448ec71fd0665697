#include "bench/score/cloud_faults.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/core/error.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

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
  try {
    scorable_points("a.ply", cloud, kFloor_z_m, scene(), kStructure);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

bool complains(const std::vector<Vec3f>& cloud, const std::string& words) {
  return complaint_of(cloud).starts_with("a.ply: ") &&
         complaint_of(cloud).find(words) != std::string::npos;
}

TEST(CloudFaults, NoneInMetresWithAFewStrays) {
  std::vector<Vec3f> cloud = cloud_scaled_by(1.0);
  EXPECT_EQ(complaint_of(cloud), "");
  for (int i = 0; i < 20; ++i) cloud.emplace_back(40000.0F, 0.0F, 1.0F);
  EXPECT_EQ(complaint_of(cloud), "");
}

/// Of any size: a small part is no sign of another unit.
TEST(CloudFaults, NoneInAPartInMetresHoweverSmall) {
  for (const double size_m : {0.0, 0.06, 0.1, 0.6, 1.0, 6.0}) {
    std::vector<Vec3f> cloud;
    for (int i = 0; i <= 100; ++i) {
      cloud.push_back((kStructure.min() + 0.01 * i * Vec3(size_m, size_m, 0)).cast<float>());
    }
    EXPECT_EQ(complaint_of(cloud), "") << size_m;
  }
}

TEST(CloudFaults, FarFromTheMeshUnitsAreGuessedByTheExtents) {
  EXPECT_TRUE(complains(cloud_scaled_by(1000.0), "no point within 1 m of the mesh"));
  EXPECT_TRUE(
      complains(cloud_scaled_by(1000.0), "looks like millimetres: scale the cloud by 0.001"));
  EXPECT_TRUE(complains(cloud_scaled_by(400.0), "looks like millimetres"));
  EXPECT_TRUE(complains(cloud_scaled_by(100.0), "looks like centimetres: scale the cloud by 0.01"));
  std::vector<Vec3f> small = cloud_scaled_by(0.001);
  for (Vec3f& p : small) p.z() += 9.0F;  // the box's middle is far from its sides
  EXPECT_TRUE(complains(small, "the mesh looks like millimetres: add --set structure.file.scale="));
}

TEST(CloudFaults, AnotherFrameIsNamedWithBothBoxes) {
  const std::vector<Vec3f> cloud = {Vec3f(500, 0, 1), Vec3f(501, 2, 3)};
  for (const char* word : {"no point within 1 m of the mesh", "501.00, 2.00, 3.00",
                           "30.00, 25.00, 17.00", "another frame"}) {
    EXPECT_TRUE(complains(cloud, word)) << word;
  }
  // one point at the farthest that is not lost is enough
  std::vector<Vec3f> one_near = cloud;
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

TEST(ScorablePoints, AreAllThatAreNotBelowTheFloorInTheirOrder) {
  const auto floor_m = static_cast<float>(kFloor_z_m);
  const std::vector<Vec3f> kept = {Vec3f(30, 0, 9), Vec3f(0, 0, floor_m), Vec3f(-30, 0, 2)};
  std::vector<Vec3f> cloud = kept;
  cloud.insert(cloud.begin() + 1, Vec3f(0, 0, std::nextafter(floor_m, 0.0F)));
  cloud.emplace_back(0.0F, 60000.0F, -60000.0F);  // lost under the floor, whatever else it is
  EXPECT_EQ(scorable_points("a.ply", cloud, kFloor_z_m, scene(), kStructure), kept);
  EXPECT_TRUE(complains({Vec3f(0, 0, 0), Vec3f(1, 0, 0)}, "all 2 points lie below z = 0.3 m"));
  // ground beside the structure does not make up for the rest being elsewhere
  EXPECT_TRUE(complains({Vec3f(30, 0, 0.2F), Vec3f(500, 0, 9)}, "no point within 1 m"));
}

}  // namespace
}  // namespace gnbv
