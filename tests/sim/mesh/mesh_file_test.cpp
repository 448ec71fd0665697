// What load_mesh() refuses, leaves out and reports, whatever the format.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "sim/core/file.hpp"
#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using namespace test;

TEST_F(MeshFile, SilentFormatsAreMetresWithZUp) {
  const std::string path = write("t.obj", "v 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 2 3\n");
  EXPECT_EQ(load_mesh(file(path)).vertices_m[2], Vec3f(0, 0, 3));
  const TriangleMesh placed = load_mesh(
      {.path = path, .scale = 4.0, .offset_m = {10, 20, 30}, .up_axis = "y", .unit_m = 0.5});
  EXPECT_EQ(placed.vertices_m[1], Vec3f(10, 20, 34));  // (0, 2, 0) -> up
  EXPECT_EQ(placed.vertices_m[2], Vec3f(10, 14, 30));  // (0, 0, 3) -> -y
}

TEST_F(MeshFile, FacesWithoutAreaAreDroppedAndReported) {
  const fs::path path = write("t.obj",
                              "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 0\n"
                              "f 1 2 4\nf 1 2 3\nf 1 1 4\nf 1 5 4\n");
  std::vector<std::string> warnings;
  EXPECT_EQ(load_mesh(file(path), &warnings).faces.size(), 1U);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(says(warnings[0], {"3 faces without area"}));
}

TEST_F(MeshFile, BadFilesAreNamedWithTheirFault) {
  EXPECT_TRUE(says(complaint(file(folder_ / "absent.obj")), {"absent.obj: No such file"}));
  EXPECT_TRUE(says(complaint(file(folder_)), {"is a directory without model.sdf"}));
  EXPECT_TRUE(says(fault("a.xyzzy", "1 2 3"), {"a.xyzzy: '.xyzzy' is no known"}));
  for (const char* name : {"a.fbx", "a.x3d", "a.3ds", "a.off", "a.blend", "a.ifc", "a.obj.gz"}) {
    EXPECT_TRUE(says(fault(name, "1 2 3"), {".obj, .ply, .stl, .dae, .gltf, .glb"}));
  }
  EXPECT_TRUE(says(fault("noextension", "1"), {"no known mesh format"}));
  for (const char* name : {"e.obj", "e.ply", "e.stl", "e.dae", "e.glb"}) {
    EXPECT_TRUE(says(fault(name, ""), {std::string(name) + ": is empty"})) << name;
  }
  for (const char* name : {"b.obj", "b.ply", "b.stl", "b.dae", "b.glb", "b.gltf"}) {
    EXPECT_TRUE(says(fault(name, "no mesh at all\n"), {name})) << name;
  }
  EXPECT_TRUE(says(complaint(file("")), {"path is empty"}));
}

TEST_F(MeshFile, CoordinatesThatAreNotFiniteAreNamed) {
  for (const char* bad : {"nan", "inf", "-inf", "1e999"}) {
    const std::string text = std::string("v 0 0 0\nv 1 0 0\nv 0 ") + bad + " 0\nf 1 2 3\n";
    EXPECT_TRUE(says(fault("n.obj", text), {":3: vertex 3"})) << bad;
  }
  TriangleMesh mesh = two_coloured_box();
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    mesh.vertices_m[5].y() = bad;
    write_mesh(mesh, folder_ / "n.ply");
    EXPECT_TRUE(says(complaint(file(folder_ / "n.ply")), {"n.ply: vertex 5"})) << bad;
  }
}

TEST_F(MeshFile, UnusableConfigIsNamed) {
  const std::string path = write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_TRUE(says(complaint({.path = path, .scale = 0.0}), {"scale = 0"}));
  EXPECT_TRUE(says(complaint({.path = path, .up_axis = "w"}), {"up_axis = w"}));
  EXPECT_TRUE(says(complaint({.path = path, .unit_m = -1.0}), {"unit_m = -1"}));
}

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

TEST_F(MeshFile, GarbageOutsideTheVerticesIsLeftOutAndReported) {
  std::string garbage;  // 4 KB of every byte value, as found in a real download
  for (int i = 0; i < 4096; ++i) garbage += static_cast<char>((i * 167 + 13) % 256);
  const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\n";
  const std::string tail = "\nvt 0.5 x\nvt 1 1\nf 1/1 2/1 3/2\nf 1/1 2/2 99/1\nf 1 4 2\nf 1 2\n";
  std::vector<std::string> warnings;
  const TriangleMesh mesh = load_mesh(forgiven(write("t.obj", head + garbage + tail)), &warnings);
  EXPECT_EQ(mesh.vertices_m.size(), 4U);
  ASSERT_EQ(mesh.faces.size(), 2U);
  EXPECT_EQ(mesh.faces[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(mesh.faces[1], (std::array<std::uint32_t, 3>{0, 3, 1}));
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_TRUE(says(warnings[0], {"unreadable lines left out, the first in line 6"}));
  EXPECT_TRUE(says(warnings[1], {"1 faces of vertices that do not exist"}));
}

TEST_F(MeshFile, GarbageAmongTheVerticesIsRefused) {
  const auto with = [&](const std::string& middle) {
    return complaint(
        forgiven(write("t.obj", "v 0 0 0\nv 1 0 0\n" + middle + "v 0 1 0\nv 0 0 1\nf 1 2 3\n")));
  };
  EXPECT_EQ(with("# comment\nvt 0 0\n"), "");
  for (const auto& [middle, where] :
       {std::pair("v 0.\x01\n", ":3: "), std::pair("v 1 2\n", ":3: vertex 3"),
        std::pair("v 1 2 3x\n", ":3: vertex 3"), std::pair(".7 0.3 1\n", ":3: "),
        std::pair("vt 0 0\n.7 0.3 1\n", ":4: "), std::pair(".7 0.3 1\nvt 0 0\n", ":3: "),
        std::pair("o a\x02\n", ":3: "), std::pair("x 1 2 3\n", ":3: ")}) {
    EXPECT_TRUE(says(with(middle), {where})) << middle;
  }
  EXPECT_EQ(with("vt 0 0\n.7 0.3 1\nvt 1 1\n"), "");
  EXPECT_EQ(with("f 1 2\n"), "");  // a face, if a broken one
}

TEST_F(MeshFile, MoreThanAHundredthOfTheFacesLostIsRefusedUnlessAskedFor) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n";
  for (int i = 0; i < 98; ++i) text += "f 1 2 3\n";
  EXPECT_EQ(fault("a.obj", text + "f 1 2 3\n"), "");
  const auto path = write("b.obj", text);
  EXPECT_EQ(complaint(file(path)),
            path.string() +
                ": 1 faces of 99 could not be used, more than its key lost_max = 0.01 "
                "allows: 1 faces of vertices that do not exist left out, the first in "
                "line 4");
  EXPECT_EQ(load_mesh(forgiven(path)).faces.size(), 98U);
  EXPECT_TRUE(says(fault("c.obj", replaced(text, "f 1 2 9", "f 1 \x01 3")),
                   {"1 faces of 99 could not be used"}));
}

TEST_F(MeshFile, MillimetresBesideTheOffsetOfAMapGridAreKept) {
  const std::string rows =
      "500001.234 5000002.345 0.003\n500002.234 5000002.345 0.003\n"
      "500001.234 5000003.345 1.003\n";
  const std::string obj = "v " + replaced(replaced(rows, "\n5", "\nv 5"), "0.003\n5", "0.003\nv 5");
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\n"
      "property double y\nproperty double z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n" +
      rows + "3 0 1 2\n";
  const std::string dae =
      "<COLLADA><asset><up_axis>Z_UP</up_axis></asset><library_geometries><geometry id='g'><mesh>"
      "<source id='s'><float_array id='f'>" +
      rows +
      "</float_array><technique_common><accessor "
      "source='#f' count='3' stride='3'/></technique_common></source><vertices id='v'><input "
      "semantic='POSITION' source='#s'/></vertices><triangles count='1'><input semantic='VERTEX' "
      "source='#v' offset='0'/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>"
      "</COLLADA>";
  for (const auto& [name, text] :
       {std::pair("a.obj", obj + "f 1 2 3\n"), {"a.ply", ply}, {"a.dae", dae}, {"a.stl", ""}}) {
    const bool is_stl = std::string(name) == "a.stl";
    std::string stl = "solid a\nfacet normal 0 0 1\nouter loop\n";
    std::istringstream lines(rows);
    for (std::string line; std::getline(lines, line);) stl += "vertex " + line + "\n";
    MeshFileConfig config =
        file(write(name, is_stl ? stl + "endloop\nendfacet\nendsolid\n" : text));
    EXPECT_TRUE(says(complaint(config), {"offset_m to [-500002, -5000003, 0]"})) << name;
    config.offset_m = Vec3(-500'000, -5'000'000, 0);
    const MeshFileConfig sdf = file(write(
        "m.sdf",
        fmt::format("<sdf><model name='m'><pose>0 0 -3 0 0 0</pose><link name='l'><visual name='v'>"
                    "<pose>-500000 -5000000 3 0 0 0</pose><geometry><mesh><uri>{}</uri></mesh>"
                    "</geometry></visual></link></model></sdf>",
                    name)));
    const MeshFileConfig urdf = file(
        write("m.urdf", fmt::format("<robot name='r'><link name='l'><visual><origin xyz='-1000000 "
                                    "-10000000 0'/><geometry><mesh filename='{}' scale='2 2 2'/>"
                                    "</geometry></visual></link></robot>",
                                    name)));
    for (const auto& [placed, scale] : {std::pair(config, 1.0), {sdf, 1.0}, {urdf, 2.0}}) {
      const Box3 box_m = bounds_m(load_mesh(placed));
      EXPECT_LT((box_m.min() / scale - Vec3(1.234, 2.345, 0.003)).norm(), 1e-6) << placed.path;
      EXPECT_LT((box_m.max() / scale - Vec3(2.234, 3.345, 1.003)).norm(), 1e-6) << placed.path;
    }
  }
}

TEST_F(MeshFile, AnObjHasUpTo65536Materials) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 65536; ++i) text += fmt::format("usemtl m{}\nf 1 2 3\n", i);
  EXPECT_EQ(load_mesh(file(write("t.obj", text))).materials.size(), 65536U);
  EXPECT_TRUE(
      says(fault("u.obj", text + "usemtl more\nf 1 2 3\n"), {"u.obj: more than 65536 materials"}));
}

TEST_F(MeshFile, ObjAndPlyRoundTripsKeepEveryVertexFaceAndMaterial) {
  const TriangleMesh box = two_coloured_box();
  for (const char* name : {"box.obj", "box.ply"}) {
    write_mesh(box, folder_ / name);
    std::vector<std::string> warnings;
    const TriangleMesh back = load_mesh(file(folder_ / name), &warnings);
    EXPECT_TRUE(warnings.empty());
    EXPECT_EQ(back.vertices_m, box.vertices_m);  // shortest decimals give the same floats
    EXPECT_EQ(back.faces, box.faces);
    EXPECT_EQ(back.face_material, box.face_material);
    ASSERT_EQ(back.materials.size(), 2U);
    for (std::size_t i = 0; i < 6; ++i) {
      // of a PLY half a byte's step where sRGB is steepest against linear light, 2.4 / 1.055 / 255
      // / 2
      EXPECT_NEAR(back.materials[i / 3].rgb[i % 3], box.materials[i / 3].rgb[i % 3],
                  name == std::string("box.ply") ? 0.0045 : 0.0);
    }
  }
  EXPECT_EQ(load_mesh(file(folder_ / "box.obj")).materials[1].name, "tail fin");
  const std::string bytes = read_file(folder_ / "box.ply");
  // the last face's, linear (1, 0, 0.125); 1.055 * 0.125^(1/2.4) - 0.055 is 99 of 255
  EXPECT_EQ(bytes.substr(bytes.size() - 3), std::string("\xff\0\x63", 3));
  TriangleMesh strip;  // numbers of many vertices
  for (std::uint32_t i = 0; i < 9000; ++i) {
    strip.vertices_m.emplace_back(0.1F * static_cast<float>(i / 2), i % 2 == 0 ? 0.0F : 1.0F, 0.0F);
    if (i >= 2) strip.faces.push_back({i - 2, i - 1, i});
  }
  write_mesh(strip, folder_ / "strip.obj");
  EXPECT_EQ(load_mesh(file(folder_ / "strip.obj")).vertices_m, strip.vertices_m);
  EXPECT_EQ(load_mesh(file(folder_ / "strip.obj")).faces, strip.faces);
}

TEST_F(MeshFile, GlbRoundTripKeepsShapeAndColoursWithZUp) {
  const TriangleMesh box = two_coloured_box();
  write_mesh(box, folder_ / "box.glb");
  const TriangleMesh back = load_mesh(file(folder_ / "box.glb"));
  EXPECT_EQ(back.vertices_m.size(), 8U);  // the doubled vertex is joined
  EXPECT_EQ(coloured_triangles(back), coloured_triangles(box));
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
