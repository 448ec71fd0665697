#include "bench/cloud_faults.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

const Box3 kStructure(Vec3(-30, -25, 0), Vec3(30, 25, 17));

/// The corners of the structure's box a thousand times, shrunk towards its middle a little further
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
    need_scorable("a.ply", cloud, kStructure);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(CloudFaults, NoneInMetresWithAFewStrays) {
  std::vector<Vec3f> cloud = cloud_scaled_by(1.0);
  EXPECT_EQ(complaint_of(cloud), "");
  for (int i = 0; i < 20; ++i) cloud.emplace_back(40000.0F, 0.0F, 0.0F);
  EXPECT_EQ(complaint_of(cloud), "");
  EXPECT_EQ(complaint_of(cloud_scaled_by(0.1)), "");
  EXPECT_EQ(complaint_of({Vec3f(1, 2, 3)}), "");
}

TEST(CloudFaults, UnitsAreNamedWithBothExtentsAndTheFactor) {
  EXPECT_EQ(complaint_of(cloud_scaled_by(1000.0)).substr(0, 37),
            "a.ply: looks like millimetres: its ex");
  EXPECT_NE(complaint_of(cloud_scaled_by(1000.0)).find("scale the cloud by 0.001"),
            std::string::npos);
  EXPECT_NE(complaint_of(cloud_scaled_by(400.0)).find("millimetres"), std::string::npos);
  EXPECT_NE(complaint_of(cloud_scaled_by(100.0)).find("centimetres"), std::string::npos);
  EXPECT_NE(complaint_of(cloud_scaled_by(0.001)).find("the mesh looks like millimetres"),
            std::string::npos);
}

TEST(CloudFaults, EmptyNotFiniteAndTooFarArePointedAt) {
  EXPECT_EQ(complaint_of({}), "a.ply: has no points");
  std::vector<Vec3f> cloud = cloud_scaled_by(1.0);
  cloud[77].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(complaint_of(cloud).find("a.ply: point 77 "), std::string::npos);
  EXPECT_NE(complaint_of(cloud).find("not finite"), std::string::npos);
  cloud[77].y() = std::numeric_limits<float>::infinity();
  EXPECT_NE(complaint_of(cloud).find("point 77"), std::string::npos);
  cloud[77].y() = 60000.0F;
  EXPECT_NE(complaint_of(cloud).find("too far"), std::string::npos);
}

TEST(CloudFaults, AnotherFrameIsNamedWithBothBoxes) {
  const std::vector<Vec3f> cloud = {Vec3f(500, 0, 0), Vec3f(501, 2, 3)};
  CloudDistances lost;
  lost.accuracy_m = kFarthest_m;
  try {
    need_near("a.ply", cloud, lost, kStructure);
    FAIL();
  } catch (const BadInput& error) {
    const std::string what = error.what();
    for (const char* word : {"a.ply", "no point within 1 m of the mesh", "501.00, 2.00, 3.00",
                             "30.00, 25.00, 17.00"}) {
      EXPECT_NE(what.find(word), std::string::npos) << what;
    }
  }
  lost.accuracy_m = 0.999;
  EXPECT_NO_THROW(need_near("a.ply", cloud, lost, kStructure));
}

}  // namespace
}  // namespace gnbv
