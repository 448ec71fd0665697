#include "assets/smoke.hpp"

#include <gtest/gtest.h>

#include "tests/assets/structure_laws.hpp"

namespace gnbv {
namespace {

TEST(SmokeStructure, IsTwoClosedPartsWithMaterialsACameraCanTellApart) {
  const TriangleMesh mesh = make_smoke_structure();
  EXPECT_EQ(expect_closed_parts(mesh), 2U);
  EXPECT_GT(least_face_height_m(mesh), 0.01);
  expect_sound_materials(mesh);
  EXPECT_EQ(sha256_of(mesh), sha256_of(make_smoke_structure()));
}

}  // namespace
}  // namespace gnbv
