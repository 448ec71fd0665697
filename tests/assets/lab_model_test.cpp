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

// Grids begin off the round numbers, so that no line runs along a face.
const Vec3 kFirst_m(-0.6433, -0.4937, 0.0071), kLast_m(0.65, 0.5, 1.5);

TEST(LabModel, IsConcaveSeenAlongEveryAxis) {
  // A convex body is entered once by any line. One line in ten entering again means niches and
  // overhangs of that share of the silhouette.
  constexpr double kStep_m = 0.0213;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    int once = 0, again = 0;
    Vec3 p_m = Vec3::Zero();
    for (p_m[u] = kFirst_m[u]; p_m[u] < kLast_m[u]; p_m[u] += kStep_m) {
      for (p_m[v] = kFirst_m[v]; p_m[v] < kLast_m[v]; p_m[v] += kStep_m) {
        const int count = entries(mesh(), p_m, axis);
        once += count > 0;
        again += count > 1;
      }
    }
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
  constexpr double kStep_m = 0.059;
  for (double x_m = kFirst_m.x(); x_m < kLast_m.x(); x_m += kStep_m) {
    for (double y_m = kFirst_m.y(); y_m < kLast_m.y(); y_m += kStep_m) {
      for (double z_m = kFirst_m.z(); z_m < kLast_m.z(); z_m += kStep_m) {
        const Vec3 p_m(x_m, y_m, z_m);
        if (!inside(p_m)) continue;
        ++occupied;
        for (std::size_t i = 0; i < images.size(); ++i)
          shared[i] += inside(p_m.cwiseProduct(images[i]));
      }
    }
  }
  EXPECT_GT(occupied, 300);
  for (const int count : shared) EXPECT_LT(count, 0.8 * occupied);
}

}  // namespace
}  // namespace gnbv
