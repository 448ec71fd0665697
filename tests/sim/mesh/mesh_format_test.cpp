// The same box, [0, 1] x [0, 2] x [0, 3] in file units, in every format that is not tested alone.
#include <gtest/gtest.h>

#include "sim/core/file.hpp"
#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using namespace test;

const std::array<std::array<std::uint16_t, 3>, 12> kBoxFaces = {{{0, 2, 3},
                                                                 {0, 3, 1},
                                                                 {4, 5, 7},
                                                                 {4, 7, 6},
                                                                 {0, 1, 5},
                                                                 {0, 5, 4},
                                                                 {2, 6, 7},
                                                                 {2, 7, 3},
                                                                 {0, 4, 6},
                                                                 {0, 6, 2},
                                                                 {1, 3, 7},
                                                                 {1, 7, 5}}};

Vec3f box_corner(unsigned i) {
  return {(i & 1U) != 0 ? 1.0F : 0.0F, (i & 2U) != 0 ? 2.0F : 0.0F, (i & 4U) != 0 ? 3.0F : 0.0F};
}

/// Positive for a closed mesh whose faces look outwards.
double volume_m3(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.faces) {
    const Vec3 bc = mesh.vertices_m[b].cast<double>().cross(mesh.vertices_m[c].cast<double>());
    sum += mesh.vertices_m[a].cast<double>().dot(bc) / 6.0;
  }
  return sum;
}

void expect_box(const TriangleMesh& mesh, const Vec3& min_m, const Vec3& max_m, double m3) {
  const Box3 box = bounds_m(mesh);
  // float coordinates of up to 16 m
  EXPECT_LT((box.min() - min_m).cwiseAbs().maxCoeff(), 3e-6) << box.min().transpose();
  EXPECT_LT((box.max() - max_m).cwiseAbs().maxCoeff(), 3e-6) << box.max().transpose();
  EXPECT_NEAR(volume_m3(mesh), m3, 1e-4);
}

std::string ascii_stl() {
  std::string out = "solid box\n";
  for (const auto& face : kBoxFaces) {
    out += "facet normal 0 0 0\nouter loop\n";
    for (const auto i : face) {
      const Vec3f p = box_corner(i);
      out += fmt::format("vertex {} {} {}\n", p.x(), p.y(), p.z());
    }
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid box\n";
}

std::string binary_stl(std::string header) {
  header.resize(80, ' ');
  append_bytes(header, std::uint32_t{12});
  for (const auto& face : kBoxFaces) {
    for (int i = 0; i < 3; ++i) append_bytes(header, 0.0F);
    for (const auto i : face) {
      for (const float x : box_corner(i)) append_bytes(header, x);
    }
    append_bytes(header, std::uint16_t{0});
  }
  return header;
}

TEST_F(MeshFile, StlInTextAndBytesSharesItsVertices) {
  // some programs begin the free header of a binary file like a text file
  for (const std::string& stl : {ascii_stl(), binary_stl("made by hand"), binary_stl("solid x")}) {
    const TriangleMesh mesh = load_mesh(file(write("box.stl", stl)));
    EXPECT_EQ(mesh.faces.size(), 12U);
    EXPECT_EQ(mesh.vertices_m.size(), 8U);
    expect_box(mesh, {0, 0, 0}, {1, 2, 3}, 6.0);
  }
  MeshFileConfig millimetres = file(folder_ / "box.stl");
  millimetres.unit_m = 0.001;
  millimetres.scale = 1000.0;
  millimetres.up_axis = "y";
  expect_box(load_mesh(millimetres), {0, -3, 0}, {1, 0, 2}, 6.0);
}

std::string ply_header(std::size_t vertices, std::size_t faces) {
  return fmt::format(
      "ply\nformat ascii 1.0\ncomment a box\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      vertices, faces);
}

TEST_F(MeshFile, PlyInTextTakesQuadsAndTheColoursOfItsVertices) {
  std::string ply = ply_header(8, 6);
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3f p = box_corner(i);
    // the lower four corners red, the upper four blue
    ply += fmt::format("{} {} {} {}\n", p.x(), p.y(), p.z(), i < 4 ? "255 0 0" : "0 0 255");
  }
  ply += "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  const TriangleMesh mesh = load_mesh(file(write("box.ply", ply)));
  EXPECT_EQ(mesh.faces.size(), 12U);
  expect_box(mesh, {0, 0, 0}, {1, 2, 3}, 6.0);
  const auto light = [](float share) {
    return std::array{0.0F, 0.0908417F, 0.4019778F,
                      1.0F}[static_cast<std::size_t>(std::lround(3.0F * share))];
  };
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    float height = 0.0F;
    for (const auto v : mesh.faces[i]) height += mesh.vertices_m[v].z() / 9.0F;
    // the mean in sRGB: 85 or 170 of 255 is 0.0908 or 0.402 in linear light
    const auto& rgb = mesh.materials[mesh.face_material[i]].rgb;
    const float red = 1.0F - height;
    EXPECT_NEAR(rgb[0], light(red), 1e-5);
    EXPECT_NEAR(rgb[2], light(height), 1e-5);
    EXPECT_EQ(rgb[1], 0.0F);
  }
}

TEST_F(MeshFile, PlyThatBreaksItsHeadersPromisesIsRefused) {
  const std::string head = ply_header(8, 1);
  std::string vertices;
  for (int i = 0; i < 8; ++i) vertices += fmt::format("{} {} 0 0 0 0\n", i % 2, i / 2);
  const auto with = [&](const std::string& text) { return complaint(file(write("p.ply", text))); };
  EXPECT_EQ(with(head + vertices + "3 0 1 2\n"), "");
  for (const auto& [text, what] : std::vector<std::pair<std::string, const char*>>{
           {head + vertices + "3 0 1\n", "p.ply: ends before"},
           {head + "0 0 0 0 0 0\n", "p.ply: ends before"},
           {head + vertices + "3 0 one 2\n", "'one' is no number"},
           {head + vertices + "3 0 1 8\n", "no faces"},
           {head + vertices + "3 0 1 -1\n", "no faces"},
           {head + vertices + "-3\n", "no faces"},
           {head.substr(0, 35), "no end_header"},
           {"ply\nformat ascii 1.0\nelement vertex many\n", "bad 'element' line"},
           {"ply\nelement vertex 1\nproperty real x\n", "unknown type 'real'"}}) {
    EXPECT_TRUE(says(with(text), {what}));
  }
}

TEST_F(MeshFile, PlyWithManyColoursKeepsThemInSteps) {
  std::string ply = ply_header(900, 300);
  for (int i = 0; i < 900; ++i) {  // three vertices of one colour to each face
    ply += fmt::format("{} {} {} {} {} 7\n", i, i % 3, i % 2, i / 3 % 256, i / 3);
  }
  for (int i = 0; i < 300; ++i) ply += fmt::format("3 {} {} {}\n", 3 * i, 3 * i + 1, 3 * i + 2);
  const TriangleMesh mesh = load_mesh(file(write("p.ply", ply)));
  EXPECT_LE(mesh.materials.size(), 64U);
  const auto& rgb = mesh.materials[mesh.face_material[120]].rgb;
  EXPECT_EQ(mesh.materials[mesh.face_material[120]].name, "colour_777700");  // of 120, 120, 7
  EXPECT_NEAR(rgb[0], 0.184475, 1e-5);  // ((119 / 255 + 0.055) / 1.055)^2.4
}

std::string gltf_bytes() {
  std::string bytes;
  for (unsigned i = 0; i < 8; ++i) {
    for (const float x : box_corner(i)) append_bytes(bytes, x);
  }
  for (const auto& face : kBoxFaces) {
    for (const auto i : face) append_bytes(bytes, i);
  }
  return bytes;  // 96 of positions, 72 of indices
}

/// The box by two nodes: turned, doubled and moved by its parent, and mirrored by a matrix.
std::string gltf_json(const std::string& buffer) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 2]}],
"nodes": [{"translation": [10, 0, 0], "children": [1]},
 {"mesh": 0, "rotation": [0, 0.70710678, 0, 0.70710678], "scale": [2, 2, 2]},
 {"mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}],
"materials": [{"name": "brass", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 1]}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
  "min": [0, 0, 0], "max": [1, 2, 3]},
 {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 96, "target": 34962},
 {"buffer": 0, "byteOffset": 96, "byteLength": 72, "target": 34963}],
"buffers": [{)" +
         buffer + R"("byteLength": 168}]})";
}

std::string glb() {
  std::string json = gltf_json("");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string out = "glTF";
  append_bytes(out, std::uint32_t{2});
  append_bytes(out, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + 168));
  append_bytes(out, static_cast<std::uint32_t>(json.size()));
  out += "JSON" + json;
  append_bytes(out, std::uint32_t{168});
  return out + std::string("BIN\0", 4) + gltf_bytes();
}

TEST_F(MeshFile, GltfNodesPlaceTheirMeshesWithYUp) {
  write("box.bin", gltf_bytes());
  const fs::path text = write("box.gltf", gltf_json(R"("uri": "box.bin", )"));
  for (const fs::path& path : {text, write("box.glb", glb())}) {
    const TriangleMesh mesh = load_mesh(file(path));
    EXPECT_EQ(mesh.faces.size(), 24U);
    // turned about y, (x, y, z) becomes (z, y, -x); y up, (x, y, z) becomes (x, -z, y)
    expect_box(mesh, {-1, -3, 0}, {16, 2, 4}, 48.0 + 6.0);
    EXPECT_EQ(mesh.materials.at(0).name, "brass");
    EXPECT_EQ(mesh.materials.at(0).rgb, (std::array<float, 3>{0.5F, 0.25F, 0.125F}));
  }
  const fs::path cut_off = write("box.gltf", gltf_json(R"("uri": "absent.bin", )"));
  EXPECT_TRUE(says(complaint(file(cut_off)), {"box.gltf: ", "absent.bin"}));
}

TEST_F(MeshFile, AReadingTellsWhatTheFileDeclares) {
  const MeshReading silent = read_mesh(file(write("box.stl", ascii_stl())));
  EXPECT_FALSE(silent.declared.unit_m || silent.declared.up_axis);
  EXPECT_EQ(silent.unit_m, 1.0);
  EXPECT_EQ(silent.up_axis, 'z');
  MeshFileConfig config = file(write("box.glb", glb()));
  config.unit_m = 0.5;
  config.up_axis = "x";
  const MeshReading overridden = read_mesh(config);
  EXPECT_EQ(overridden.declared.unit_m, 1.0);
  EXPECT_EQ(overridden.declared.up_axis, 'y');
  EXPECT_EQ(overridden.unit_m, 0.5);
  EXPECT_EQ(overridden.up_axis, 'x');
}

}  // namespace
}  // namespace gnbv
