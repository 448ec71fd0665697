#include "assets/lab_airplane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "assets/lab_airplane_parts.hpp"
#include "tests/assets/structure_laws.hpp"

namespace gnbv {
namespace {

const TriangleMesh& mesh() {
  static const TriangleMesh made = make_lab_airplane();
  return made;
}

TEST(LabAirplane, HasThePapersSizeAboutTheOriginOnTheGround) {
  const Box3 box = bounds_m(mesh());
  EXPECT_NEAR(box.sizes().x(), 4.0, 0.01);
  EXPECT_NEAR(box.sizes().y(), 3.0, 0.01);
  EXPECT_NEAR(box.max().z(), 1.0, 0.01);
  EXPECT_NEAR(box.center().x(), 0.0, 0.005);
  EXPECT_EQ(box.center().y(), 0.0);
  EXPECT_GE(box.min().z(), 0.0);
  EXPECT_LT(box.min().z(), 0.01);
}

TEST(LabAirplane, StandsOnThreePlacesThatSurroundItsMiddle) {
  std::array<int, 3> touching = {0, 0, 0};  // nose, port, starboard
  for (const Vec3f& v : mesh().vertices_m)
    if (v.z() < 0.01F) ++touching[v.x() > 0.5F ? 0 : v.y() > 0.0F ? 1 : 2];
  for (const int count : touching) EXPECT_GT(count, 0);
}

TEST(LabAirplane, EveryPartIsClosedAndFacesOutwards) {
  EXPECT_GE(expect_closed_parts(mesh()), 60U);
}

TEST(LabAirplane, HasNoDegenerateFaceAndNoUnusedVertex) {
  EXPECT_GT(least_face_height_m(mesh()), 0.0003);  // the trailing edges are the finest
}

TEST(LabAirplane, EveryFaceHasANamedMaterialAndEveryMaterialIsUsedAndPatterned) {
  expect_sound_materials(mesh());
  for (const Material& material : mesh().materials)
    EXPECT_LE(material.pattern_size_m, 0.12F) << material.name;
}

TEST(LabAirplane, HasNoLargePlaneOnTheVoxelBoundariesInUse) {
  for (const double voxel_m : {0.02, 0.05})
    EXPECT_LT(area_on_voxel_boundaries_m2(mesh(), voxel_m), 1e-4) << voxel_m;
}

TEST(LabAirplane, IsTheSameEveryTime) {
  EXPECT_EQ(sha256_of(mesh()), sha256_of(make_lab_airplane()));
}

TEST(LabAirplane, MirrorMapsTheFacesOntoThemselvesBitForBit) {
  using Point = std::array<float, 3>;
  using Face = std::array<Point, 3>;
  const auto face = [](std::array<Vec3f, 3> corners, float side) {
    if (side < 0.0F) std::swap(corners[1], corners[2]);
    Face points;
    for (std::size_t i = 0; i < 3; ++i)
      points[i] = {corners[i].x(), side * corners[i].y(), corners[i].z()};
    std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
    return points;
  };
  std::vector<std::pair<Face, std::uint16_t>> faces, images;
  for (std::size_t i = 0; i < mesh().faces.size(); ++i) {
    const auto& f = mesh().faces[i];
    const std::array<Vec3f, 3> corners = {mesh().vertices_m[f[0]], mesh().vertices_m[f[1]],
                                          mesh().vertices_m[f[2]]};
    faces.emplace_back(face(corners, 1.0F), mesh().face_material[i]);
    images.emplace_back(face(corners, -1.0F), mesh().face_material[i]);
  }
  std::sort(faces.begin(), faces.end());
  std::sort(images.begin(), images.end());
  EXPECT_TRUE(faces == images);
}

/// A point whose line along z must not meet `part`.
bool column_is_free(const Part& part, double x_m, double y_m) {
  TriangleMesh alone;
  append(alone, part);
  return crossings(alone, {x_m, y_m, 0.0}, 2).empty();
}

TEST(LabAirplane, ControlSurfacesAreHungInOpenSlots) {
  const std::vector<Part> parts = lab_airplane::wings();
  // Straight down between the aileron's end and the rib, and along its hinge line: (x, y) of the
  // drawing, where both bodies leave a gap of millimetres.
  const Part &wing = parts[0], &aileron = parts[2];
  double wing_end_m = 0.0, aileron_begin_m = 10.0;
  for (const Vec3& p : aileron.points_m) aileron_begin_m = std::min(aileron_begin_m, p.x());
  for (const Vec3& p : wing.points_m)
    if (p.x() < aileron_begin_m) wing_end_m = std::max(wing_end_m, p.x());
  EXPECT_GT(aileron_begin_m - wing_end_m, 0.004);
  const double gap_x_m = 0.5 * (wing_end_m + aileron_begin_m);
  double trailing_m = -10.0;
  for (const Vec3& p : aileron.points_m)
    if (p.x() < aileron_begin_m + 0.01) trailing_m = std::max(trailing_m, p.y());
  EXPECT_TRUE(column_is_free(wing, gap_x_m, trailing_m - 0.05));
  EXPECT_TRUE(column_is_free(aileron, gap_x_m, trailing_m - 0.05));
  EXPECT_FALSE(column_is_free(aileron, gap_x_m + 0.03, trailing_m - 0.05));
}

TEST(LabAirplane, RootsAreInsideTheBodiesTheyGrowFrom) {
  const std::vector<Part> body = lab_airplane::body(), wings = lab_airplane::wings(),
                          fins = lab_airplane::centre_fins();
  const Part& fuselage = body[0];
  const auto expect_inside = [](const Part& part, std::size_t count, const Part& around,
                                const char* what) {
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_NEAR(winding_number(around, part.points_m[i]), 1.0, 1e-6)
          << what << ": " << part.points_m[i].transpose();
  };
  expect_inside(wings[0], 22, fuselage, "wing root");  // 22 points a ring
  for (const Part& blade : lab_airplane::propeller_blades())
    expect_inside(blade, 10, body[3], "blade root");
  const std::vector<Part> fittings = lab_airplane::fittings();
  expect_inside(fittings[0], 14, fuselage, "exhaust");
  expect_inside(fittings[2], 12, fittings[1], "pylon's foot");
}

}  // namespace
}  // namespace gnbv
