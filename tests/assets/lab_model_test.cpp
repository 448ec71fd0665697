#include "assets/lab_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/assets/structure_laws.hpp"

namespace gnbv {
namespace {

const TriangleMesh& mesh() {
  static const TriangleMesh made = make_lab_model();
  return made;
}

TEST(LabModel, HasThePapersSizeAboutTheOriginOnTheGround) {
  const Box3 box = bounds_m(mesh());
  EXPECT_NEAR(box.sizes().x(), 1.3, 0.01);
  EXPECT_NEAR(box.sizes().y(), 1.0, 0.01);
  EXPECT_NEAR(box.sizes().z(), 1.5, 0.01);
  EXPECT_NEAR(box.center().x(), 0.0, 0.005);
  EXPECT_NEAR(box.center().y(), 0.0, 0.005);
  EXPECT_GE(box.min().z(), 0.0);
  EXPECT_LT(box.min().z(), 0.01);
}

TEST(LabModel, EveryPartIsClosedAndFacesOutwards) { EXPECT_GE(expect_closed_parts(mesh()), 10U); }

TEST(LabModel, HasNoDegenerateFaceAndNoUnusedVertex) {
  EXPECT_GT(least_face_height_m(mesh()), 0.003);  // the rod's facets are the finest
}

TEST(LabModel, EveryFaceHasANamedMaterialAndEveryMaterialIsUsedAndPatterned) {
  expect_sound_materials(mesh());
  for (const Material& material : mesh().materials)
    EXPECT_LE(material.pattern_size_m, 0.12F) << material.name;
}

TEST(LabModel, HasNoPlaneOnTheVoxelBoundariesInUse) {
  for (const double voxel_m : {0.04, 0.05, 0.07})
    EXPECT_EQ(area_on_voxel_boundaries_m2(mesh(), voxel_m), 0.0) << voxel_m;
}

TEST(LabModel, IsTheSameEveryTime) { EXPECT_EQ(sha256_of(mesh()), sha256_of(make_lab_model())); }

// Points of a grid that no face is parallel to a row of: off the axes by irrational-looking steps.
template <typename Visit>
void for_grid(double step_m, const Visit& visit) {
  for (double x_m = -0.6433; x_m < 0.65; x_m += step_m)
    for (double y_m = -0.4937; y_m < 0.5; y_m += step_m)
      for (double z_m = 0.0071; z_m < 1.5; z_m += step_m) visit(Vec3(x_m, y_m, z_m));
}

TEST(LabModel, IsConcaveSeenAlongEveryAxis) {
  // A convex body is entered once by any line. One line in ten entering twice means niches and
  // overhangs of that share of the silhouette.
  for (int axis = 0; axis < 3; ++axis) {
    int once = 0, again = 0;
    for_grid(0.0213, [&](const Vec3& p_m) {
      Vec3 first = p_m;
      if (p_m[axis] > (axis == 2 ? 0.02 : axis == 1 ? -0.48 : -0.63)) return;  // a line, not points
      first[axis] = 0.0;
      const int count = entries(mesh(), first, axis);
      once += count > 0;
      again += count > 1;
    });
    EXPECT_GT(once, 500) << axis;
    EXPECT_GT(again, 0.1 * once) << axis;
  }
}

TEST(LabModel, HasNoSymmetry) {
  // Share of the occupied grid points whose image is occupied too; 1 for a symmetric body.
  const auto inside = [](const Vec3& p_m) {
    int depth = 0;
    for (const auto& [at, step] : crossings(mesh(), p_m, 2)) depth += at < p_m.z() ? step : 0;
    return depth > 0;
  };
  const std::array<Vec3, 3> images = {{{-1, 1, 1}, {1, -1, 1}, {-1, -1, 1}}};
  std::array<int, 3> shared = {0, 0, 0};
  int occupied = 0;
  for_grid(0.059, [&](const Vec3& p_m) {
    if (!inside(p_m)) return;
    ++occupied;
    for (std::size_t i = 0; i < images.size(); ++i)
      shared[i] += inside(p_m.cwiseProduct(images[i]));
  });
  EXPECT_GT(occupied, 300);
  for (const int count : shared) EXPECT_LT(count, 0.8 * occupied);
}

}  // namespace
}  // namespace gnbv
