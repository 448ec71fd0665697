#include "assets/aircraft.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "assets/aircraft_parts.hpp"
#include "tests/assets/mesh_laws.hpp"
#include "tests/assets/structure_laws.hpp"

namespace gnbv {
namespace {

const TriangleMesh& mesh() {
  static const TriangleMesh made = make_aircraft();
  return made;
}

TEST(Aircraft, HasTheSizeOfThePapersAircraft) {
  const Box3 box = bounds_m(mesh());
  EXPECT_NEAR(box.max().x(), 14.93, 0.05);
  EXPECT_NEAR(box.min().y(), -17.68, 0.05);
  EXPECT_NEAR(box.max().y(), 17.69, 0.05);
  EXPECT_NEAR(box.min().z(), 0.4, 0.05);
  EXPECT_NEAR(box.max().z(), 8.1, 0.05);
}

TEST(Aircraft, FuselageHasHalfTheDiameterOfAnA340) {
  double widest_m = 0.0;
  for (const Vec3& p : aircraft::fuselage().points_m) widest_m = std::max(widest_m, p.x());
  EXPECT_NEAR(widest_m, 0.5 * 5.64 / 2.0, 1e-6);  // Airbus: 5.64 m
}

TEST(Aircraft, HasTheCountsPromised) {
  EXPECT_GE(mesh().vertices_m.size(), 17000U);
  EXPECT_LE(mesh().vertices_m.size(), 19000U);
  EXPECT_GE(mesh().faces.size(), 31000U);
  EXPECT_LE(mesh().faces.size(), 33000U);
}

TEST(Aircraft, EveryPartIsClosedAndFacesOutwards) { EXPECT_GT(expect_closed_parts(mesh()), 100U); }

TEST(Aircraft, MirrorMapsTheVerticesOntoThemselvesBitForBit) {
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;
  const auto key = [](float x, const Vec3f& v) {
    return Key(std::bit_cast<std::uint32_t>(x + 0.0F), std::bit_cast<std::uint32_t>(v.y()),
               std::bit_cast<std::uint32_t>(v.z()));  // -0 + 0 is +0: one zero only
  };
  std::vector<Key> vertices, images;
  for (const Vec3f& v : mesh().vertices_m) {
    vertices.push_back(key(v.x(), v));
    images.push_back(key(-v.x(), v));
  }
  std::sort(vertices.begin(), vertices.end());
  std::sort(images.begin(), images.end());
  EXPECT_EQ(vertices, images);
}

TEST(Aircraft, HasNoDegenerateFaceAndNoUnusedVertex) {
  std::vector<bool> used(mesh().vertices_m.size(), false);
  std::vector<double> aspect;
  for (const auto& f : mesh().faces) {
    const Vec3 a = mesh().vertices_m[f[0]].cast<double>(),
               b = mesh().vertices_m[f[1]].cast<double>(),
               c = mesh().vertices_m[f[2]].cast<double>();
    const double longest_m = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const double height_m = (b - a).cross(c - a).norm() / longest_m;
    ASSERT_TRUE(std::isfinite(height_m));
    EXPECT_GT(height_m, 0.004);  // the fan blades' edges are the finest detail
    aspect.push_back(longest_m / height_m);
    for (const auto v : f) used[v] = true;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
  std::sort(aspect.begin(), aspect.end());
  EXPECT_LT(aspect[aspect.size() / 2], 4.0);  // 2 / sqrt(3) would be equilateral
  EXPECT_LT(aspect[aspect.size() * 99 / 100], 20.0);
  EXPECT_LT(aspect.back(), 50.0);
}

TEST(Aircraft, EveryFaceHasANamedMaterialAndEveryMaterialIsUsedAndPatterned) {
  expect_sound_materials(mesh());
}

TEST(Aircraft, IsTheSameEveryTime) { EXPECT_EQ(sha256_of(mesh()), sha256_of(make_aircraft())); }

TEST(Aircraft, HasTheAreaStated) {
  // Golden: 787.4 m² when drawn, inner surfaces included (the paper's model has 770).
  EXPECT_NEAR(surface_area_m2(mesh()), 787.4, 0.02 * 787.4);
}

TEST(Aircraft, HasNoLargePlaneOnAVoxelBoundary) {
  EXPECT_LT(area_on_voxel_boundaries_m2(mesh(), 0.05), 0.05);
}

/// Points of `part` number `first` to `first + count`, all inside `body`?
void expect_inside(const Part& part, std::size_t first, std::size_t count, const Part& body,
                   const char* what) {
  for (std::size_t i = first; i < first + count; ++i)
    EXPECT_NEAR(winding_number(body, part.points_m[i]), 1.0, 1e-6)
        << what << ": " << part.points_m[i].transpose();
}

TEST(Aircraft, PartsPenetrateEachOther) {
  // A root ring wholly inside its neighbour leaves no gap. 28, 22, 26, 18 points a ring.
  const Part body = aircraft::fuselage();
  expect_inside(aircraft::wing(), 0, 28, body, "wing root");
  expect_inside(aircraft::tailplane(), 0, 22, body, "tailplane root");
  expect_inside(aircraft::fin(), 0, 26, body, "fin root");
  const std::vector<Part> engines = aircraft::engines();
  const std::size_t parts = engines.size() / 2;  // cowl, core, pylon, blades; inner, then outer
  for (const std::size_t at : {std::size_t{0}, parts}) {
    const Part &core = engines[at + 1], &pylon = engines[at + 2];
    expect_inside(pylon, 0, 18, core, "pylon foot");
    expect_inside(pylon, pylon.points_m.size() - 18, 18, aircraft::wing(), "pylon head");
    for (std::size_t blade = at + 3; blade < at + parts; ++blade)
      expect_inside(engines[blade], 0, 4, core, "blade root");
  }
}

}  // namespace
}  // namespace gnbv
