#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using namespace test;

TEST_F(MeshFile, ObjPolygonsRelativeIndicesAndContinuedLinesAreRead) {
  const TriangleMesh mesh =
      load_mesh(file(write("t.obj",
                           "# comment\r\no part one\r\ng\r\ns off\r\n"
                           "v 0 0 0\r\nv +1 0 0 1.0\r\nv 1 1 0 0.5 0.5 0.5\r\n"
                           "v 0 1e0 0\r\nvt 0 0\r\nvn 0 0 1\r\n"
                           "f 1/1/1 2//1 \\\r\n 3/1 4\r\n"
                           "v 0 0 1\r\nf -1 -5 -4\r\n")));
  EXPECT_EQ(mesh.vertices_m.size(), 5U);
  ASSERT_EQ(mesh.faces.size(), 3U);
  EXPECT_DOUBLE_EQ(surface_area_m2(mesh), 1.5);
  EXPECT_EQ(mesh.faces[2], (std::array<std::uint32_t, 3>{4, 0, 1}));
}

TEST_F(MeshFile, ConcavePolygonsCoverTheirOwnArea) {
  // an arrow head: a fan from its first corner would cover more
  const TriangleMesh mesh =
      load_mesh(file(write("t.obj", "v 0 0 0\nv 2 1 0\nv 4 0 0\nv 2 4 0\nf 1 2 3 4\n")));
  EXPECT_EQ(mesh.faces.size(), 2U);
  EXPECT_DOUBLE_EQ(surface_area_m2(mesh), 6.0);
}

TEST_F(MeshFile, GarbageOutsideTheVerticesIsLeftOutAndReported) {
  std::string garbage;  // 4 KB of every byte value, as found in a real download
  for (int i = 0; i < 4096; ++i) garbage += static_cast<char>((i * 167 + 13) % 256);
  const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\n";
  const std::string tail = "\nvt 0.5 x\nvt 1 1\nf 1/1 2/1 3/2\nf 1/1 2/2 99/1\nf 1 4 2\nf 1 2\n";
  std::vector<std::string> warnings;
  const TriangleMesh mesh = load_mesh(file(write("t.obj", head + garbage + tail)), &warnings);
  EXPECT_EQ(mesh.vertices_m.size(), 4U);
  ASSERT_EQ(mesh.faces.size(), 2U);
  EXPECT_EQ(mesh.faces[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(mesh.faces[1], (std::array<std::uint32_t, 3>{0, 3, 1}));
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_TRUE(says(warnings[0], "unreadable lines left out, the first in line 6")) << warnings[0];
  EXPECT_TRUE(says(warnings[1], "1 faces of vertices that do not exist")) << warnings[1];
}

TEST_F(MeshFile, GarbageAmongTheVerticesIsRefused) {
  const auto with = [&](const std::string& middle) {
    return complaint(
        file(write("t.obj", "v 0 0 0\nv 1 0 0\n" + middle + "v 0 1 0\nv 0 0 1\nf 1 2 3\n")));
  };
  EXPECT_EQ(with("# comment\nvt 0 0\n"), "");
  EXPECT_TRUE(says(with("v 0.\x01\n"), ":3: "));
  EXPECT_TRUE(says(with("v 1 2\n"), ":3: vertex 3"));
  EXPECT_TRUE(says(with("v 1 2 3x\n"), ":3: vertex 3"));
  EXPECT_TRUE(says(with(".7 0.3 1\n"), ":3: "));
  EXPECT_TRUE(says(with("vt 0 0\n.7 0.3 1\n"), ":4: "));
  EXPECT_TRUE(says(with(".7 0.3 1\nvt 0 0\n"), ":3: "));
  EXPECT_TRUE(says(with("o a\x02\n"), ":3: "));
  EXPECT_TRUE(says(with("vt 0 x\n"), ":3: "));
  EXPECT_EQ(with("vt 0 0\n.7 0.3 1\nvt 1 1\n"), "");
  EXPECT_EQ(with("f 1 2\n"), "");  // a face, if a broken one
}

TEST_F(MeshFile, AnObjHasUpTo65536Materials) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 65536; ++i) text += fmt::format("usemtl m{}\nf 1 2 3\n", i);
  EXPECT_EQ(load_mesh(file(write("t.obj", text))).materials.size(), 65536U);
  EXPECT_TRUE(says(complaint(file(write("u.obj", text + "usemtl more\nf 1 2 3\n"))),
                   "u.obj: more than 65536 materials"));
}

TEST_F(MeshFile, MissingMaterialFileIsReported) {
  std::vector<std::string> warnings;
  const fs::path path =
      write("t.obj", "mtllib absent.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl steel\nf 1 2 3\n");
  const TriangleMesh mesh = load_mesh(file(path), &warnings);
  EXPECT_EQ(mesh.materials.at(0).name, "steel");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(says(warnings[0], "t.obj:1: material file absent.mtl not found")) << warnings[0];
}

}  // namespace
}  // namespace gnbv
