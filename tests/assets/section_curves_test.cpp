#include "assets/section_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/error.hpp"
#include "tests/assets/mesh_laws.hpp"

namespace gnbv {
namespace {

TEST(MonotoneCurve, PassesThroughItsStationsAndKeepsLinesStraight) {
  const MonotoneCurve line({{-1.0, 3.0}, {0.0, 1.0}, {2.5, -4.0}});
  for (double x = -1.0; x <= 2.5; x += 0.125) EXPECT_NEAR(line(x), 1.0 - 2.0 * x, 1e-12);
  EXPECT_EQ(line(-7.0), 3.0);
  EXPECT_EQ(line(9.0), -4.0);
}

TEST(MonotoneCurve, NeverOvershoots) {
  const MonotoneCurve curve({{0.0, 0.0}, {1.0, 0.1}, {1.2, 5.0}, {3.0, 5.0}, {4.0, 2.0}});
  double before = curve(0.0);
  for (double x = 0.01; x < 1.2; x += 0.01) {
    EXPECT_GE(curve(x), before);
    before = curve(x);
  }
  for (double x = 1.2; x < 3.0; x += 0.01) EXPECT_NEAR(curve(x), 5.0, 1e-12);
  for (double x = 3.0; x < 4.0; x += 0.01) EXPECT_LE(curve(x), 5.0 + 1e-12);
  EXPECT_THROW(MonotoneCurve({{1.0, 0.0}, {1.0, 2.0}}), BrokenInvariant);
}

TEST(Aerofoil, HasTheThicknessAndCamberAskedFor) {
  constexpr std::size_t kPoints = 400;
  const AerofoilSection section{Vec3::Zero(), {0.0, 2.0, 0.0}, Vec3::UnitZ(), 0.12, 0.05};
  const Ring ring = aerofoil_ring(section, kPoints);
  ASSERT_EQ(ring.size(), 2 * kPoints);
  EXPECT_EQ(ring[0], section.leading_edge_m);
  EXPECT_EQ(ring[kPoints], section.trailing_edge_m);
  double thickest_m = 0.0, camber_m = 0.0;
  for (std::size_t k = 1; k < kPoints; ++k) {
    const Vec3 &upper = ring[k], &lower = ring[2 * kPoints - k];
    EXPECT_EQ(upper.y(), lower.y());
    thickest_m = std::max(thickest_m, upper.z() - lower.z());
    camber_m = std::max(camber_m, 0.5 * (upper.z() + lower.z()));
  }
  // The four-digit polynomial's maximum is 1.0003 of its nominal thickness; camber peaks between
  // two of the 400 points.
  EXPECT_NEAR(thickest_m, 0.24, 0.24 * 1e-3);
  EXPECT_NEAR(camber_m, 0.05, 1e-5);
}

TEST(Aerofoil, ConstantSpanHasTheVolumeOfTheSection) {
  const AerofoilSection root{Vec3::Zero(), {0.0, 1.0, 0.0}, Vec3::UnitZ(), 0.06, 0.0};
  AerofoilSection tip = root;
  tip.leading_edge_m.x() = tip.trailing_edge_m.x() = 5.0;
  constexpr std::size_t kPoints = 300;
  std::vector<Ring> rings = {aerofoil_ring(root, kPoints)};
  add_span(rings, root, tip, 4, kPoints);
  const Part wing = loft(rings, {}, {}, uniform(0));
  // Area of the closed four-digit section: 10 h times the polynomial's integral over the chord,
  // 2 * 0.2969 / 3 - 0.1260 / 2 - 0.3516 / 3 + 0.2843 / 4 - 0.1036 / 5, times two sides.
  const double integral = 0.2969 / 1.5 - 0.1260 / 2.0 - 0.3516 / 3.0 + 0.2843 / 4.0 - 0.1036 / 5.0;
  EXPECT_NEAR(signed_volume_m3(wing), 5.0 * 2.0 * 10.0 * 0.06 * integral, 1e-4);  // chords
  EXPECT_EQ(open_edges(wing.faces), 0U);
}

}  // namespace
}  // namespace gnbv
