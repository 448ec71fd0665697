#include "sim/mesh_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

class MeshFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("gnbv_mesh_file_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  fs::path folder_;
};

MeshFileConfig file(const fs::path& path) {
  MeshFileConfig config;
  config.path = path.string();
  return config;
}

/// The message of the BadInput that loading throws; empty when it loads.
std::string complaint(const MeshFileConfig& config) {
  try {
    load_mesh(config);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A box whose six sides take two materials in turn, with one vertex doubled on purpose.
TriangleMesh two_coloured_box() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices_m.emplace_back((i & 1) != 0 ? 2.1F : -0.3F, (i & 2) != 0 ? 1.7F : 0.1F,
                                 (i & 4) != 0 ? 4.3F : 0.7F);
  }
  mesh.vertices_m.push_back(mesh.vertices_m[7]);
  mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 8, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  mesh.materials = {{"hull", {0.25F, 0.5F, 0.75F}}, {"tail fin", {1.0F, 0.0F, 0.125F}}};
  mesh.face_material = {0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 1, 1};
  return mesh;
}

/// Every corner of every face with its face's colour, in an order that files cannot change.
std::vector<std::array<float, 12>> coloured_triangles(const TriangleMesh& mesh, bool with_colours) {
  std::vector<std::array<float, 12>> out;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    auto& row = out.emplace_back();
    auto face = mesh.faces[i];
    // start at the smallest corner; the sense of rotation stays
    std::array<std::array<float, 3>, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f& p = mesh.vertices_m[face[k]];
      corner[k] = {p.x(), p.y(), p.z()};
    }
    std::rotate(corner.begin(), std::min_element(corner.begin(), corner.end()), corner.end());
    for (std::size_t k = 0; k < 9; ++k) row[k] = corner[k / 3][k % 3];
    if (!with_colours) continue;
    const auto& rgb = mesh.materials[mesh.face_material.empty() ? 0 : mesh.face_material[i]].rgb;
    std::copy(rgb.begin(), rgb.end(), row.begin() + 9);
  }
  std::sort(out.begin(), out.end());
  return out;
}

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
  TriangleMesh strip;  // more vertices than kObjNumberBase, so that both parts of a number count
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

TEST_F(MeshFile, StlTrianglesShareTheirVertices) {
  std::string stl = "solid two\n";
  for (const char* third : {"0 1 0", "0 0 1"}) {
    stl += std::string("facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex ") +
           third + "\nendloop\nendfacet\n";
  }
  const TriangleMesh mesh = load_mesh(file(write("two.stl", stl + "endsolid two\n")));
  EXPECT_EQ(mesh.faces.size(), 2U);
  EXPECT_EQ(mesh.vertices_m.size(), 4U);
}

/// One triangle (1,0,0) (0,2,0) (0,0,3), instanced by two nodes: moved by 10 along the file's x,
/// and mirrored in x.
std::string collada(const std::string& unit, const std::string& up_axis) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>)" +
         unit + up_axis + R"(</asset>
<library_effects><effect id="paint"><profile_COMMON><technique sid="t"><lambert>
<diffuse><color>0.25 0.5 0.75 1</color></diffuse></lambert></technique></profile_COMMON></effect>
</library_effects>
<library_materials><material id="red" name="red"><instance_effect url="#paint"/></material>
</library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">1 0 0 0 2 0 0 0 3</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p>
</triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
<node id="outer"><translate>10 0 0</translate><node id="inner"><instance_geometry url="#g">
<bind_material><technique_common><instance_material symbol="m" target="#red"/></technique_common>
</bind_material></instance_geometry></node></node>
<node id="mirror"><scale>-1 1 1</scale><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="m" target="#red"/></technique_common></bind_material>
</instance_geometry></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

const char* const kCentimetres = R"(<unit name="centimetre" meter="0.01"/>)";

/// The six corners of collada() in file units.
std::vector<Vec3> collada_corners() {
  return {{11, 0, 0}, {10, 2, 0}, {10, 0, 3}, {-1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
}

template <typename Turn>
void expect_collada(const TriangleMesh& mesh, double factor, const Turn& turn) {
  ASSERT_EQ(mesh.faces.size(), 2U);
  const std::vector<Vec3> corners = collada_corners();
  for (std::size_t instance = 0; instance < 2; ++instance) {
    std::array<Vec3, 3> expected;
    for (std::size_t k = 0; k < 3; ++k) expected[k] = factor * turn(corners[3 * instance + k]);
    // the mirrored instance keeps its outside by turning round
    if (instance == 1) std::swap(expected[1], expected[2]);
    std::array<Vec3, 3> found;
    for (std::size_t k = 0; k < 3; ++k) {
      found[k] = mesh.vertices_m[mesh.faces[instance][k]].cast<double>();
    }
    double best = 1e9;  // over the corner the face starts with
    for (std::size_t shift = 0; shift < 3; ++shift) {
      double worst = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        worst = std::max(worst, (found[(k + shift) % 3] - expected[k]).norm());
      }
      best = std::min(best, worst);
    }
    EXPECT_LT(best, 2e-6 * factor * 11) << "instance " << instance;  // float transforms
  }
}

Vec3 z_stays(const Vec3& p) { return p; }
Vec3 y_to_z(const Vec3& p) { return {p.x(), -p.z(), p.y()}; }
Vec3 x_to_z(const Vec3& p) { return {-p.y(), -p.z(), p.x()}; }

TEST_F(MeshFile, ColladaUnitUpAxisAndInstancesAreHonoured) {
  const std::string z_up = "<up_axis>Z_UP</up_axis>";
  const TriangleMesh z = load_mesh(file(write("z.dae", collada(kCentimetres, z_up))));
  expect_collada(z, 0.01, z_stays);
  EXPECT_EQ(z.materials.at(0).name, "red");
  EXPECT_EQ(z.materials.at(0).rgb, (std::array<float, 3>{0.25F, 0.5F, 0.75F}));
  expect_collada(load_mesh(file(write("y.dae", collada("", "<up_axis>Y_UP</up_axis>")))), 1.0,
                 y_to_z);
  expect_collada(load_mesh(file(write("silent.dae", collada("", "")))), 1.0, y_to_z);
  expect_collada(load_mesh(file(write("x.dae", collada("", "<up_axis>X_UP</up_axis>")))), 1.0,
                 x_to_z);
}

TEST_F(MeshFile, ConfigOverridesUnitAndUpAxis) {
  MeshFileConfig config = file(write("z.dae", collada(kCentimetres, "<up_axis>Z_UP</up_axis>")));
  config.unit_m = 0.5;
  expect_collada(load_mesh(config), 0.5, z_stays);
  config.scale = 3.0;
  expect_collada(load_mesh(config), 1.5, z_stays);
  config.up_axis = "y";
  expect_collada(load_mesh(config), 1.5, y_to_z);
  config.up_axis = "x";
  config.unit_m = 0.0;
  config.scale = 1.0;
  expect_collada(load_mesh(config), 0.01, x_to_z);
}

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

TEST_F(MeshFile, MissingMaterialFileIsReported) {
  std::vector<std::string> warnings;
  const fs::path path =
      write("t.obj", "mtllib absent.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl steel\nf 1 2 3\n");
  const TriangleMesh mesh = load_mesh(file(path), &warnings);
  EXPECT_EQ(mesh.materials.at(0).name, "steel");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(says(warnings[0], "t.obj:1: material file absent.mtl not found")) << warnings[0];
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

// The paper's own structures are never committed: these run on machines that have them.

TEST(PaperMesh, A340HasTheVerticesFacesAndSizeOfTheFile) {
  const fs::path path = fs::path(GNBV_SHARED_MESHES) / "a340.obj";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not here";
  const TriangleMesh mesh = load_mesh(file(path));
  EXPECT_EQ(mesh.vertices_m.size(), 17899U);
  EXPECT_EQ(mesh.faces.size(), 31878U);
  const Box3 box = bounds_m(mesh);
  // the figures of the meshes' README, rounded to centimetres
  EXPECT_LT((box.min() - Vec3(-14.93, -17.68, 0.42)).cwiseAbs().maxCoeff(), 0.006);
  EXPECT_LT((box.max() - Vec3(14.93, 17.69, 8.09)).cwiseAbs().maxCoeff(), 0.006);
}

TEST(PaperMesh, A340WithGarbageAmongItsTextureCoordinatesIsTheSame) {
  const fs::path path = fs::path(GNBV_SHARED_MESHES) / "a340.obj";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not here";
  const std::string clean = read_file(path);
  const std::size_t first_face = clean.find("\nf ") + 1;
  std::string garbage = "vt 0.1 0.2\nvt 0.3 0.";
  for (int i = 0; i < 4096; ++i) garbage += static_cast<char>((i * 167 + 13) % 256);
  garbage += "25 0.5\nvt 0.1 0.9\n";
  const fs::path dirty = fs::path(testing::TempDir()) / "gnbv_a340_dirty.obj";
  write_file_atomically(dirty, clean.substr(0, first_face) + garbage + clean.substr(first_face));
  std::vector<std::string> warnings;
  const TriangleMesh mesh = load_mesh(file(dirty), &warnings);
  fs::remove(dirty);
  const TriangleMesh expected = load_mesh(file(path));
  EXPECT_EQ(mesh.vertices_m, expected.vertices_m);
  EXPECT_EQ(mesh.faces, expected.faces);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(says(warnings[0], "unreadable lines")) << warnings[0];
}

TEST(PaperMesh, PowerPlantAtAQuarterHasThePapersHeight) {
  MeshFileConfig config = file(fs::path(GNBV_SHARED_MESHES) / "powerplant.dae");
  if (!fs::exists(config.path)) GTEST_SKIP() << config.path << " is not here";
  config.scale = 0.25;
  std::vector<std::string> warnings;
  const TriangleMesh mesh = load_mesh(config, &warnings);
  // the file instances 4,693 triangles, 19 of them on a line
  EXPECT_EQ(mesh.faces.size(), 4693U - 19U);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(says(warnings[0], "19 faces without area")) << warnings[0];
  const Vec3 size_m = bounds_m(mesh).sizes();
  EXPECT_NEAR(size_m.x(), 24.8, 0.05);  // README, rounded to decimetres
  EXPECT_NEAR(size_m.y(), 16.2, 0.05);
  EXPECT_NEAR(size_m.z(), 12.0, 0.05);
  EXPECT_NEAR(surface_area_m2(mesh), 1824.0, 0.5);
}

}  // namespace
}  // namespace gnbv
