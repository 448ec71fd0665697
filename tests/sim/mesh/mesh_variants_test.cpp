// Files as programs write them, beside what the specifications show: the shape is the same, or the
// file is refused by what it is.
#include <gtest/gtest.h>

#include <functional>

#include "sim/core/file.hpp"
#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

using namespace test;

constexpr std::array<std::array<int, 4>, 6> kSides = {
    {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}};

Vec3 corner(int i) { return Eigen::Vector3i((i >> 2) & 1, (i >> 1) & 1, i & 1).cast<double>(); }

std::string rows(const char* before) {
  std::string out;
  for (int i = 0; i < 8; ++i) {
    out += fmt::format("{}{} {} {}\n", before, corner(i).x(), corner(i).y(), corner(i).z());
  }
  return out;
}

std::string obj() {
  std::string out = "# a cube\n" + rows("v ");
  for (const auto& [a, b, c, d] : kSides) {
    out += fmt::format("f {} {} {} {}\n", a + 1, b + 1, c + 1, d + 1);
  }
  return out;
}

std::string ply() {
  std::string out =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n" +
      rows("");
  for (const auto& [a, b, c, d] : kSides) out += fmt::format("4 {} {} {} {}\n", a, b, c, d);
  return out;
}

std::string stl() {
  std::string out = "solid a cube\n";
  for (const auto& side : kSides) {
    out += " facet normal 0 0 0\n  outer loop\n";
    for (const int i : side) {
      out += fmt::format("   vertex {} {} {}\n", corner(i).x(), corner(i).y(), corner(i).z());
    }
    out += "  endloop\n endfacet\n";
  }
  return out + "endsolid a cube\n";
}

std::string dae() {
  std::string p;
  for (const auto& [a, b, c, d] : kSides) p += fmt::format(" {} {} {} {}", a, b, c, d);
  std::string positions = rows("");
  return R"(<?xml version="1.0"?>
<COLLADA version="1.4.1"><asset><up_axis>Z_UP</up_axis></asset>
<library_images><image id="i"><init_from>t.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><phong><diffuse>
<color>1 0 0 1</color></diffuse></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="24">)" +
         positions + R"(</float_array><technique_common><accessor source="#a" count="8" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<source id="n"><float_array id="na" count="3">0 0 1</float_array></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="6"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4 4 4 4 4 4</vcount>
<p>)" + p +
         R"(</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="o"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";
}

std::string with_ends(const std::string& text, const std::string& end) {
  std::string out;
  for (const char c : text) c == '\n' ? out += end : out += c;
  return out;
}

class MeshVariant : public MeshFile {
 protected:
  /// The unit cube, in any order.
  void expect_cube(const std::string& name, const std::string& content, const std::string& what) {
    SCOPED_TRACE(what);
    const MeshReading found = read(name, content);
    EXPECT_EQ(found.mesh.faces.size(), 12U);
    EXPECT_NEAR(surface_area_m2(found.mesh), 6.0, 1e-5);
    EXPECT_TRUE(bounds_m(found.mesh).isApprox(Box3(Vec3::Zero(), Vec3::Ones()), 1e-6));
  }
};

TEST_F(MeshVariant, EncodingAndLineEndsDoNotMatter) {
  for (const auto& [name, text] : {std::pair("t.obj", obj()), std::pair("t.ply", ply()),
                                   std::pair("t.stl", stl()), std::pair("t.dae", dae())}) {
    expect_cube(name, text, name);
    expect_cube(name, "\xEF\xBB\xBF" + text, std::string(name) + " with a byte order mark");
    expect_cube(name, with_ends(text, "\r\n"), std::string(name) + " with CR LF");
    expect_cube(name, with_ends(text, "\r"), std::string(name) + " with CR");
    for (const bool is_big : {false, true}) {
      expect_cube(name, in_utf16(text, is_big, true), std::string(name) + " in UTF-16");
      expect_cube(name, in_utf16(with_ends(text, "\r\n"), is_big, true),
                  std::string(name) + " in UTF-16 with CR LF");
    }
  }
}

TEST_F(MeshVariant, AnObjsShapeNeedsNoneOfItsOtherStatements) {
  for (const std::string line :
       {"# saved in C:\\models\\", "vn -1.#IND nan x", "vt 0 x", "vt", "shadow_obj other.obj",
        "trace_obj other.obj", "vcolor 1 0 0", "Kd 1 0 0", "v_weight 3", "g a #1", "o \xC3\xA9"}) {
    expect_cube("t.obj", line + "\n" + obj(), line);
    expect_cube("t.obj", replaced(obj(), "v 0 1 1\n", line + "\nv 0 1 1\n"), line);
    expect_cube("t.obj", obj() + line, line);
  }
  expect_cube("t.obj", replaced(obj(), "f 1 2 4 3\n", "f 1 2 4 3 # bottom \\\n"), "comment");
  expect_cube("t.obj", replaced(obj(), "v 0 1 1\n", "v 0 1 1 #here\n"), "comment");
  write("a.mtl", "newmtl red\nKd 1 0 0\n");
  write("b.mtl", "newmtl blue\nkd 0 0 1\n");
  for (const std::string named : {"a.mtl b.mtl", ".\\b.mtl", "C:\\models\\b.mtl"}) {
    const MeshReading two = read("t.obj", "mtllib " + named + "\nusemtl blue # the sky\n" + obj());
    EXPECT_EQ(two.mesh.materials.at(0).rgb, (std::array{0.0F, 0.0F, 1.0F})) << named;
    EXPECT_TRUE(two.warnings.empty()) << named;
  }
  const MeshReading without = read("t.obj", "mtllib none.mtl\nusemtl steel\n" + obj());
  EXPECT_EQ(without.mesh.materials.at(0).name, "steel");
  ASSERT_EQ(without.warnings.size(), 1U);
  EXPECT_TRUE(says(without.warnings[0], {"t.obj:1: material file none.mtl not found"}));
}

TEST_F(MeshVariant, WhatIsLeftOutIsCounted) {
  const auto expect_lost = [&](const std::string& name, const std::string& text, std::size_t count,
                               const char* says_so) {
    const MeshReading found = read(name, text);
    EXPECT_EQ(found.lost_faces, count) << says_so;
    ASSERT_FALSE(found.warnings.empty()) << says_so;
    EXPECT_TRUE(says(found.warnings.back(), {says_so}));
  };
  expect_lost("t.obj", obj() + "f 1 2 99\n", 1, "vertices that do not exist");
  expect_lost("t.obj", obj() + "f 1 2\n", 1, "unreadable lines");
  expect_lost("t.obj", obj() + "cstype bspline\nsurf 0 1 0 1 1 2 3 4\nend\n", 1, "no polygons");
  expect_lost("t.ply", replaced(ply(), "4 0 1 3 2", "4 0 1 3 8"), 1, "vertices that do not exist");
  expect_lost("t.ply", ply() + "4 0 1 3 2\n", 1, "1 rows after all");
  expect_lost("t.stl", replaced(stl(), "   vertex 0 0 0\n   vertex 0 0 1\n", ""), 1,
              "fewer than three vertices");
  for (const char* const indices : {"0 1 3 8", "0 1 3 2.5"}) {
    expect_lost("t.dae", replaced(dae(), "0 1 3 2", indices), 1, "vertices that do not exist");
  }
  expect_lost("t.dae", replaced(dae(), "</node>", "<instance_geometry url='b.dae#g'/></node>"), 1,
              "not in this file");
}

TEST_F(MeshVariant, AnStlIsItsTriangles) {
  expect_cube("t.stl", replaced(stl(), "normal 0 0 0", "normal #IND00e+000 -1.#IND nan"), "normal");
  expect_cube("t.stl", replaced(stl(), "facet normal 0 0 0", "FACET"), "no normal");
  expect_cube("t.stl", with_ends(stl(), " \n\n\t"), "blanks");
  expect_cube("t.stl", "\n" + stl(), "a blank line first");
  expect_cube("t.stl", replaced(stl(), "solid", std::string("solid a\0\0", 9)),
              "zeros in its name");
  const std::string whole = stl();
  EXPECT_TRUE(
      says(fault("t.stl", whole.substr(0, whole.rfind("vertex"))), {"ends within a facet"}));
  EXPECT_TRUE(says(fault("t.stl", replaced(whole, "vertex 0 1 1", "vertex 0 x 1")),
                   {"t.stl:6: a vertex without three coordinates"}));
  const MeshReading cut = read("t.stl", whole.substr(0, whole.find("endsolid")));
  ASSERT_EQ(cut.warnings.size(), 1U);
  EXPECT_TRUE(says(cut.warnings[0], {"may be cut off"}));
  std::string bytes = "solid, as some programs begin the free header of a binary file";
  bytes.resize(80);
  append_bytes(bytes, std::uint32_t{1});
  for (const float x : {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F})
    append_bytes(bytes, x);
  append_bytes(bytes, std::uint16_t{0x801F});
  EXPECT_EQ(read("t.stl", bytes).mesh.vertices_m,
            (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  const MeshReading longer = read("t.stl", bytes + "trailer");
  EXPECT_EQ(longer.mesh.faces.size(), 1U);
  ASSERT_EQ(longer.warnings.size(), 2U);
  EXPECT_TRUE(says(longer.warnings[0], {"1 triangles have attributes"}));
  EXPECT_TRUE(says(longer.warnings[1], {"7 bytes after the 1 triangles"}));
  EXPECT_TRUE(says(fault("t.stl", bytes.substr(0, 100)), {"ends after 0 of the 1 triangles"}));
}

TEST_F(MeshVariant, APlyIsReadByItsHeader) {
  expect_cube("t.ply", replaced(ply(), "vertex_indices", "vertex_indexes"), "vertex_indexes");
  expect_cube("t.ply", replaced(replaced(ply(), "float x", "float X"), "float z", "float Z"), "X");
  const std::string with_normals = replaced(ply(), "float z\n", "float z\nproperty float nx\n");
  std::string text = with_normals;
  for (std::size_t at = text.find("end_header\n") + 10, i = 0; i < 8; ++i) {
    at = text.find('\n', at + 1);
    text.insert(at, " -1.#IND");
    at = text.find('\n', at);
  }
  expect_cube("t.ply", text, "normals that are no numbers");
  expect_cube("t.ply", ply() + "7 8\n9\n", "rows after the end");
  expect_cube("t.ply", replaced(ply(), "end_header", "element edge 1\nproperty int a\nend_header"),
              "an element of no shape that is cut off");
  EXPECT_TRUE(says(fault("t.ply", replaced(ply(), "4 0 1 3 2", "4 0 1 3 2 7")),
                   {"t.ply:18: a row of 'face' has more words"}));
  EXPECT_TRUE(says(fault("t.ply", replaced(ply(), "property float z\n", "")), {"no property 'z'"}));
  EXPECT_TRUE(says(fault("t.ply", replaced(ply(), "vertex_indices", "corners")), {"'corners'"}));
  const std::string strips =
      replaced(replaced(ply(), "element face 6", "element tristrips 1"), "uchar int", "int int");
  const std::string body = strips.substr(0, strips.find("4 0 1 3 2"));
  const MeshReading strip = read("t.ply", body + "11 0 1 2 3 6 7 -1 0 4 1 5\n");
  EXPECT_EQ(strip.mesh.faces.size(), 6U);
  EXPECT_EQ(strip.mesh.faces[1], (std::array<std::uint32_t, 3>{2, 1, 3}));  // the same sense
  EXPECT_NEAR(surface_area_m2(strip.mesh), 3.0, 1e-6);
}

TEST_F(MeshVariant, AColladasShapeNeedsNoLooksAndNoOneDialect) {
  const std::string image = "<init_from>t.png</init_from>";
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {image, ""},
           {image, "<init_from/>"},
           {image, "<init_from></init_from>"},
           {"<image id=\"i\">" + image + "</image>", "<image/>"},
           {"<color>1 0 0 1</color>", "<color>\n 1 0 0 1</color>"},
           {"<color>1 0 0 1</color>", "<color>red</color>"},
           {"<color>1 0 0 1</color>", "<texture/>"},
           {" count=\"24\"", ""},
           {"count=\"6\"", "count=\"many\""},
           {"0 0 1</float_array></source>", "0 0 nought</float_array></source>"},
           {"Z_UP", "\n  Z_UP <!-- up -->\n"},
           {"<p> 0", "<p><!-- sides --> 0"},
           {"url=\"#g\"", "url=\" #g \""},
           {"<node id=\"o\">", "<node id=\"o\" name=\"a & b\">"}}) {
    expect_cube("t.dae", replaced(dae(), from, to), to);
  }
  std::string prefixed = replaced(dae(), "<COLLADA", "<COLLADA xmlns:c='urn:c'");
  for (std::size_t at = 0; (at = prefixed.find('<', at)) != prefixed.npos; ++at) {
    if (prefixed[at + 1] != '?') prefixed.insert(at + (prefixed[at + 1] == '/' ? 2 : 1), "c:");
  }
  expect_cube("t.dae", prefixed, "a prefix");
  EXPECT_TRUE(says(fault("t.dae", replaced(dae(), "<instance_geometry url=\"#g\"/>",
                                           "<instance_node url=\"#o\"/>")),
                   {"t.dae:", "the node 'o' is within itself"}));
  EXPECT_TRUE(says(fault("t.dae", dae().substr(0, 900)), {"t.dae:"}));
  const std::string holed = replaced(dae(), "</polylist>",
                                     "</polylist><polygons count='1'><input semantic='VERTEX' "
                                     "source='#w' offset='0'/><ph><p>0 1 2 "
                                     "3</p><h>4 5 6 7</h></ph></polygons>");
  const std::string ring = replaced(
      replaced(holed, "<vertices id",
               "<source id='q'><float_array id='b'>0 0 0 3 0 0 3 3 0 0 3 0 1 1 0 2 1 0 2 2 0 1 2 0"
               "</float_array></source><vertices id='w'><input semantic='POSITION' source='#q'/>"
               "</vertices><vertices id"),
      "source='#w'", "source='#v'");
  // the positions of the first <vertices> are the mesh's own
  const MeshReading found = read(
      "t.dae",
      replaced(replaced(ring,
                        "<vertices id='w'><input semantic='POSITION' source='#q'/></vertices>", ""),
               "semantic='VERTEX' source='#v'", "semantic='POSITION' source='#q'"));
  EXPECT_NEAR(surface_area_m2(found.mesh), 6.0 + 8.0, 1e-6);
}

TEST_F(MeshVariant, AFileOfAnotherKindIsCalledByItsName) {
  const std::string lfs = "version https://git-lfs.github.com/spec/v1\noid sha256:1\nsize 9\n";
  for (const char* name : {"t.obj", "t.ply", "t.stl", "t.dae", "t.gltf", "t.glb"}) {
    EXPECT_TRUE(says(fault(name, lfs), {"is a Git LFS pointer", "git lfs pull"})) << name;
    EXPECT_TRUE(says(fault(name, "\n<!DOCTYPE html>\n<html></html>"), {"is an HTML page"})) << name;
    EXPECT_TRUE(says(fault(name, "PK\x03\x04rest"), {"is a ZIP archive"})) << name;
    if (std::string_view(name) == "t.dae") continue;
    EXPECT_TRUE(says(fault(name, dae()), {"name it .dae"})) << name;
  }
  for (const char* name : {"t.xyz", "t.pcd", "t.las"}) {
    EXPECT_TRUE(says(fault(name, "1 2 3\n"), {"is a point cloud", "gnbv score"})) << name;
  }
  EXPECT_TRUE(says(fault("t.obj", rows("v ")), {"only 8 points", "gnbv score"}));
  EXPECT_TRUE(
      says(fault("t.obj", rows("v ") + "f 1 2 9\n"), {"no faces: 1 faces of vertices that"}));
  EXPECT_TRUE(says(fault("t.obj", "solid a\nfacet normal 0 0 1\n"), {"name it .stl"}));
  EXPECT_TRUE(says(fault("t.obj", "{\"asset\": {}}"), {"name it .gltf"}));
  EXPECT_TRUE(says(fault("t.3mf", "PK\x03\x04rest"), {"is a 3MF file"}));
  EXPECT_TRUE(says(fault("t.usdz", "PK\x03\x04rest"), {"is a USD file"}));
}

}  // namespace
}  // namespace gnbv
