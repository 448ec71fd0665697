#include <gtest/gtest.h>

#include "sim/core/file.hpp"
#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using namespace test;

TEST_F(MeshFile, ObjRoundTripKeepsEveryVertexFaceAndMaterial) {
  const TriangleMesh box = two_coloured_box();
  write_mesh(box, folder_ / "box.obj");
  std::vector<std::string> warnings;
  const TriangleMesh back = load_mesh(file(folder_ / "box.obj"), &warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(back.vertices_m, box.vertices_m);  // shortest decimals give the same floats
  EXPECT_EQ(back.faces, box.faces);
  ASSERT_EQ(back.materials.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.materials[i].name, box.materials[i].name);
    EXPECT_EQ(back.materials[i].rgb, box.materials[i].rgb);
  }
  EXPECT_EQ(back.face_material, box.face_material);
}

TEST_F(MeshFile, ObjNumbersOfManyVerticesSurvive) {
  TriangleMesh strip;
  for (std::uint32_t i = 0; i < 9000; ++i) {
    strip.vertices_m.emplace_back(0.1F * static_cast<float>(i / 2), i % 2 == 0 ? 0.0F : 1.0F, 0.0F);
    if (i >= 2) strip.faces.push_back({i - 2, i - 1, i});
  }
  write_mesh(strip, folder_ / "strip.obj");
  const TriangleMesh back = load_mesh(file(folder_ / "strip.obj"));
  EXPECT_EQ(back.vertices_m, strip.vertices_m);
  EXPECT_EQ(back.faces, strip.faces);
}

TEST_F(MeshFile, PlyRoundTripKeepsEveryVertexAndFace) {
  const TriangleMesh box = two_coloured_box();
  write_mesh(box, folder_ / "box.ply");
  const TriangleMesh back = load_mesh(file(folder_ / "box.ply"));
  EXPECT_EQ(back.vertices_m, box.vertices_m);
  EXPECT_EQ(back.faces, box.faces);
}

TEST_F(MeshFile, PlyFacesCarryTheirMaterialInSrgb) {
  write_mesh(two_coloured_box(), folder_ / "box.ply");
  const std::string bytes = read_file(folder_ / "box.ply");
  // the last face's, linear (1, 0, 0.125); 1.055 * 0.125^(1/2.4) - 0.055 is 99 of 255
  EXPECT_EQ(bytes.substr(bytes.size() - 3), std::string("\xff\0\x63", 3));
  const TriangleMesh back = load_mesh(file(folder_ / "box.ply"));
  EXPECT_EQ(back.face_material, two_coloured_box().face_material);
  for (std::size_t i = 0; i < 3; ++i) {
    // half a byte's step where sRGB is steepest against linear light, 2.4 / 1.055 / 255 / 2
    EXPECT_NEAR(back.materials[0].rgb[i], two_coloured_box().materials[0].rgb[i], 0.0045);
  }
}

TEST_F(MeshFile, GlbRoundTripKeepsShapeAndColoursWithZUp) {
  const TriangleMesh box = two_coloured_box();
  write_mesh(box, folder_ / "box.glb");
  const TriangleMesh back = load_mesh(file(folder_ / "box.glb"));
  EXPECT_EQ(back.vertices_m.size(), 8U);  // the doubled vertex is joined
  EXPECT_EQ(coloured_triangles(back, true), coloured_triangles(box, true));
  ASSERT_EQ(back.materials.size(), 2U);
  EXPECT_EQ(back.materials[1].name, "tail fin");
}

TEST_F(MeshFile, WritingLeavesNoOtherFiles) {
  for (const char* name : {"box.obj", "box.ply", "box.glb"}) {
    write_mesh(two_coloured_box(), folder_ / name);
  }
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"box.glb", "box.mtl", "box.obj", "box.ply"}));
  EXPECT_THROW(write_mesh(two_coloured_box(), folder_ / "box.stl"), BadInput);
  EXPECT_THROW(write_mesh(two_coloured_box(), folder_ / "absent" / "box.ply"), BadInput);
}

}  // namespace
}  // namespace gnbv
