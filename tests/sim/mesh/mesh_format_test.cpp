// What a PLY header promises, colours of vertices, and what a file declares.
#include <gtest/gtest.h>

#include "sim/core/file.hpp"
#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using namespace test;

std::string ply_header(std::size_t vertices, std::size_t faces) {
  return fmt::format(
      "ply\nformat ascii 1.0\ncomment a box\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      vertices, faces);
}

TEST_F(MeshFile, AFaceHasTheMeanColourOfItsCornersInSrgb) {
  const TriangleMesh mesh = load_mesh(file(
      write("p.ply", ply_header(3, 1) + "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 0 0 255\n3 0 1 2\n")));
  const Material& material = mesh.materials.at(0);
  EXPECT_EQ(material.name, "colour_aa0055");
  EXPECT_NEAR(material.rgb[0], 0.4019778F, 1e-5);  // of 170 of 255 in linear light
  EXPECT_NEAR(material.rgb[2], 0.0908417F, 1e-5);
}

TEST_F(MeshFile, PlyThatBreaksItsHeadersPromisesIsRefused) {
  const std::string head = ply_header(8, 1);
  std::string vertices;
  for (int i = 0; i < 8; ++i) vertices += fmt::format("{} {} 0 0 0 0\n", i % 2, i / 2);
  const auto with = [&](const std::string& text) { return fault("p.ply", text); };
  EXPECT_EQ(with(head + vertices + "3 0 1 2\n"), "");
  for (const auto& [text, what] : std::vector<std::pair<std::string, const char*>>{
           {head + vertices + "3 0 1\n", "p.ply: ends before"},
           {head + "0 0 0 0 0 0\n", "p.ply: ends before"},
           {head + vertices + "3 0 one 2\n", "'one' is no number"},
           {head + vertices + "3 0 1 8\n", "no faces"},
           {head + vertices + "3 0 1 -1\n", "no faces"},
           {head + vertices + "-3\n", "p.ply:22: 'vertex_indices' has -3 where a whole number"},
           {head + vertices + "3 0 1 0.5\n", "has 0.5 where a whole number"},
           {head + vertices + std::string("3 0 1 2\0\x1b\n", 10), "'2\\x00\\x1b' is no number"},
           {head.substr(0, 35), "no end_header"},
           {"ply\nformat ascii 1.0\nelement vertex many\n",
            "p.ply:3: its header has a bad 'element'"},
           {"ply\nelement vertex 1\nproperty real x\n", "p.ply:3: its header names"}}) {
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

TEST_F(MeshFile, AReadingTellsWhatTheFileDeclares) {
  write_mesh(two_coloured_box(), folder_ / "box.ply");
  const MeshReading silent = read_mesh(file(folder_ / "box.ply"));
  EXPECT_FALSE(silent.declared.unit_m || silent.declared.up_axis);
  EXPECT_EQ(silent.unit_m, 1.0);
  EXPECT_EQ(silent.up_axis, 'z');
  write_mesh(two_coloured_box(), folder_ / "box.glb");
  MeshFileConfig config = file(folder_ / "box.glb");
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
