#include "assets/random/mesh_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/core/error.hpp"
#include "tests/assets/mesh_laws.hpp"

namespace gnbv {
namespace {

constexpr double kPi = std::numbers::pi;

Part sphere(double radius_m, std::size_t n) {
  std::vector<RevolvedPoint> profile;
  for (std::size_t i = 0; i <= n; ++i) {
    const double angle = kPi * static_cast<double>(i) / static_cast<double>(n);
    const bool pole = i == 0 || i == n;
    profile.push_back({-radius_m * std::cos(angle), pole ? 0.0 : radius_m * std::sin(angle)});
  }
  return revolve(profile, 2 * n, uniform(0));
}

Ring polygon(double radius_m, double y_m, std::size_t n) {
  Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(n);
    ring.emplace_back(radius_m * std::sin(angle), y_m, radius_m * std::cos(angle));
  }
  return ring;
}

TEST(Revolve, SphereConvergesWithTheSquareOfTheStep) {
  const double volume_m3 = 4.0 / 3.0 * kPi * 8.0, surface_m2 = 4.0 * kPi * 4.0;
  const auto volume_error = [&](std::size_t n) {
    return volume_m3 - signed_volume_m3(sphere(2.0, n));
  };
  const auto area_error = [&](std::size_t n) { return surface_m2 - area_m2(sphere(2.0, n)); };
  // An inscribed polyhedron errs by c h² + O(h⁴): half the step, a quarter of the error. At n = 32
  // the next term is below 1 %.
  EXPECT_NEAR(volume_error(32) / volume_error(64), 4.0, 0.04);
  EXPECT_NEAR(area_error(32) / area_error(64), 4.0, 0.04);
  EXPECT_GT(volume_error(64), 0.0);
  EXPECT_LT(volume_error(64), 0.005 * volume_m3);
  EXPECT_EQ(open_edges(sphere(2.0, 16).faces), 0U);
}

TEST(Revolve, RingShellHasTheVolumeOfPappus) {
  // Square of side 0.2 m about a circle of 1 m: n-gon instead of circle is the factor
  // sin(t)/t, t = 2 pi / n, for the product of two edges; exact to rounding.
  constexpr std::size_t kSides = 40;
  const Part part =
      revolve_loop({{0.0, 0.9}, {0.0, 1.1}, {0.2, 1.1}, {0.2, 0.9}}, kSides, uniform(0));
  const double t = 2.0 * kPi / double{kSides};
  EXPECT_NEAR(signed_volume_m3(part), 0.04 * 2.0 * kPi * std::sin(t) / t, 1e-12);
  EXPECT_EQ(open_edges(part.faces), 0U);
  EXPECT_EQ(part.points_m.size() * 2, part.faces.size());  // genus 1: V - F / 2 = 0
}

TEST(Revolve, PaintsBySegmentOfTheProfile) {
  const Part part =
      revolve({{0.0, 0.0}, {0.5, 1.0}, {1.5, 1.0}, {2.0, 0.0}}, 12,
              [](std::size_t segment, std::size_t) { return static_cast<std::uint16_t>(segment); });
  for (std::size_t i = 0; i < part.faces.size(); ++i) {
    double middle_y_m = 0.0;
    for (const auto v : part.faces[i]) middle_y_m += part.points_m[v].y() / 3.0;
    EXPECT_EQ(part.material[i], middle_y_m < 0.5 ? 0 : middle_y_m < 1.5 ? 1 : 2);
  }
}

TEST(Loft, PrismHasExactVolumeAndAreaWithEitherCap) {
  constexpr std::size_t kSides = 24;
  const double turn = 2.0 * kPi / double{kSides};
  const double base_m2 = 0.5 * double{kSides} * std::sin(turn) * 0.49;
  const double side_m2 = double{kSides} * 2.0 * 0.7 * std::sin(0.5 * turn) * 3.0;
  for (const Cap& cap : {Cap{}, Cap{Vec3(0.0, 0.0, 0.0)}}) {
    Cap end = cap;
    if (end.apex_m) end.apex_m->y() = 3.0;
    const Part part =
        loft({polygon(0.7, 0.0, kSides), polygon(0.7, 3.0, kSides)}, cap, end, uniform(0));
    EXPECT_NEAR(signed_volume_m3(part), 3.0 * base_m2, 1e-12);  // rounding only
    EXPECT_NEAR(area_m2(part), 2.0 * base_m2 + side_m2, 1e-12);
    EXPECT_EQ(open_edges(part.faces), 0U);
    EXPECT_EQ(part.material.size(), part.faces.size());
  }
}

TEST(Loft, RefusesRingsOfDifferentSizes) {
  EXPECT_THROW(loft({polygon(1.0, 0.0, 5), polygon(1.0, 1.0, 6)}, {}, {}, uniform(0)),
               BrokenInvariant);
  EXPECT_THROW(revolve({{0.0, 0.1}, {1.0, 1.0}, {2.0, 0.0}}, 8, uniform(0)), BrokenInvariant);
  EXPECT_THROW(revolve_loop({{0.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}}, 8, uniform(0)), BrokenInvariant);
}

}  // namespace
}  // namespace gnbv
