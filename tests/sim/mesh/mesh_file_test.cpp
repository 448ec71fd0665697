// What load_mesh() refuses, leaves out and reports, whatever the format.
#include <gtest/gtest.h>

#include <limits>

#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using namespace test;

TEST_F(MeshFile, SilentFormatsAreMetresWithZUp) {
  MeshFileConfig config = file(write("t.obj", "v 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 2 3\n"));
  EXPECT_EQ(load_mesh(config).vertices_m[2], Vec3f(0, 0, 3));
  config.up_axis = "y";
  config.unit_m = 0.5;
  config.scale = 4.0;
  config.offset_m = {10, 20, 30};
  EXPECT_EQ(load_mesh(config).vertices_m[1], Vec3f(10, 20, 34));  // (0, 2, 0) -> up
  EXPECT_EQ(load_mesh(config).vertices_m[2], Vec3f(10, 14, 30));  // (0, 0, 3) -> -y
}

TEST_F(MeshFile, FacesWithoutAreaAreDroppedAndReported) {
  const fs::path path = write("t.obj",
                              "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 0\n"
                              "f 1 2 4\nf 1 2 3\nf 1 1 4\nf 1 5 4\n");
  std::vector<std::string> warnings;
  EXPECT_EQ(load_mesh(file(path), &warnings).faces.size(), 1U);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(says(warnings[0], "3 faces without area")) << warnings[0];
}

TEST_F(MeshFile, BadFilesAreNamedWithTheirFault) {
  EXPECT_TRUE(says(complaint(file(folder_ / "absent.obj")), "absent.obj: No such file"));
  EXPECT_TRUE(says(complaint(file(folder_)), "is a directory"));
  EXPECT_TRUE(says(complaint(file(write("a.xyzzy", "1 2 3"))), "a.xyzzy: '.xyzzy' is no known"));
  EXPECT_TRUE(says(complaint(file(write("noextension", "1"))), "no known mesh format"));
  for (const char* name : {"e.obj", "e.ply", "e.stl", "e.dae", "e.glb"}) {
    EXPECT_TRUE(says(complaint(file(write(name, ""))), std::string(name) + ": is empty")) << name;
  }
  for (const char* name : {"b.obj", "b.ply", "b.stl", "b.dae", "b.glb", "b.gltf"}) {
    EXPECT_TRUE(says(complaint(file(write(name, "no mesh at all\n"))), name)) << name;
  }
  EXPECT_TRUE(says(complaint(file(write("p.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"))), "p.obj"));
  EXPECT_TRUE(says(complaint(file(write("p.ply",
                                        "ply\nformat ascii 1.0\nelement vertex 1\n"
                                        "property float x\nproperty float y\nproperty float z\n"
                                        "end_header\n1 2 3\n"))),
                   "p.ply"));
  EXPECT_TRUE(says(complaint(file("")), "path is empty"));
}

TEST_F(MeshFile, OtherFormatsAreRefusedWithTheNamesOfOurs) {
  for (const char* name : {"a.fbx", "a.x3d", "a.3ds", "a.off", "a.blend", "a.ifc", "a.obj.gz"}) {
    EXPECT_TRUE(says(complaint(file(write(name, "1 2 3"))), ".obj, .ply, .stl, .dae, .gltf, .glb"))
        << name;
  }
}

TEST_F(MeshFile, CoordinatesThatAreNotFiniteAreNamed) {
  for (const char* bad : {"nan", "inf", "-inf", "1e999"}) {
    const std::string text = std::string("v 0 0 0\nv 1 0 0\nv 0 ") + bad + " 0\nf 1 2 3\n";
    EXPECT_TRUE(says(complaint(file(write("n.obj", text))), ":3: vertex 3")) << bad;
  }
  TriangleMesh mesh = two_coloured_box();
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    mesh.vertices_m[5].y() = bad;
    write_mesh(mesh, folder_ / "n.ply");
    EXPECT_TRUE(says(complaint(file(folder_ / "n.ply")), "n.ply: vertex 5")) << bad;
  }
}

TEST_F(MeshFile, CoordinatesTooSmallForADoubleAreZero) {
  const std::string rows = "1e-400 0 0\n1 -1e-999999999999 0\n0 1 0.00000e-320\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n";
  std::string obj = "v " + rows;
  for (std::size_t at = 0; (at = obj.find('\n', at)) + 1 < obj.size();) obj.insert(++at, "v ");
  for (const fs::path& path :
       {write("t.obj", obj + "f 1 2 3\n"), write("t.ply", ply + rows + "3 0 1 2\n")}) {
    const TriangleMesh mesh = load_mesh(file(path));
    EXPECT_EQ(mesh.vertices_m, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << path;
  }
}

TEST_F(MeshFile, UnusableConfigIsNamed) {
  const fs::path path = write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  MeshFileConfig config = file(path);
  config.scale = 0.0;
  EXPECT_TRUE(says(complaint(config), "scale = 0"));
  config = file(path);
  config.up_axis = "w";
  EXPECT_TRUE(says(complaint(config), "up_axis = w"));
  config = file(path);
  config.unit_m = -1.0;
  EXPECT_TRUE(says(complaint(config), "unit_m = -1"));
}

}  // namespace
}  // namespace gnbv
