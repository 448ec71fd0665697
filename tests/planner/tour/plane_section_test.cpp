#include <gtest/gtest.h>

#include "planner/tour/surface_cells.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

double random(std::uint64_t frame, std::uint64_t index) {
  return 2.0 * uniform01({3, Stream::bench, frame, index}) - 1.0;
}

/// Of the points of a square in the plane, the share that lies in the cube, times its area.
double counted_area(const Vec3& normal, double distance) {
  constexpr int kSteps = 400;
  constexpr double kHalf = 1.0;  // beyond the half diagonal of the cube
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  int inside = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double a = kHalf * (2.0 * (i + 0.5) / kSteps - 1.0);
      const double b = kHalf * (2.0 * (j + 0.5) / kSteps - 1.0);
      const Vec3 p = distance * normal + a * u + b * v;
      if (p.cwiseAbs().maxCoeff() <= 0.5) ++inside;
    }
  }
  return 4.0 * kHalf * kHalf * inside / (kSteps * kSteps);
}

TEST(PlaneSection, IsWhatCountedPointsSay) {
  for (std::uint64_t i = 0; i < 40; ++i) {
    const Vec3 normal = Vec3(random(i, 0), random(i, 1), random(i, 2)).normalized();
    const double distance = 0.9 * random(i, 3);
    EXPECT_NEAR(plane_section_area(normal, distance, 1.0), counted_area(normal, distance), 0.02)
        << normal.transpose() << " at " << distance;
  }
}

TEST(PlaneSection, OfAFaceIsTheFace) {
  EXPECT_NEAR(plane_section_area(Vec3::UnitZ(), 0.1, 1.0), 1.0, 0.02);
  EXPECT_EQ(plane_section_area(Vec3::UnitZ(), 0.52, 1.0), 0.0);
  EXPECT_NEAR(plane_section_area(Vec3(1, 1, 1).normalized(), 0.0, 2.0), 3.0 * std::sqrt(3.0), 1e-9)
      << "a regular hexagon through the middle";
}

}  // namespace
}  // namespace gnbv
