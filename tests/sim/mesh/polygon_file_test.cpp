// One mesh of polygons in OBJ and in every kind of PLY.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/core/file.hpp"
#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/polygon_mesh.hpp"
#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

using namespace test;

/// A house with a gable: walls of four and five corners, a roof, and an arrow head over it.
PolygonMesh house() {
  PolygonMesh out;
  out.vertices = {{0, 0, 0}, {4, 0, 0},   {4, 6, 0}, {0, 6, 0},   {0, 0, 3},
                  {4, 0, 3}, {4, 6, 3},   {0, 6, 3}, {2, 0, 4.5}, {2, 6, 4.5},
                  {0, 0, 5}, {2, 1, 5.1}, {4, 0, 5}, {2, 4, 5}};
  out.corners = {0, 1, 5, 8, 4, 2, 3, 7, 9, 6, 1, 2,  6,  5,  3,  0, 4, 7, 4,
                 8, 9, 7, 8, 5, 6, 9, 0, 3, 2, 1, 10, 11, 12, 13, 0, 1, 2};
  out.face_ends = {5, 10, 14, 18, 22, 26, 30, 34, 37};
  return out;
}

template <typename Use>
void for_each_face(const PolygonMesh& mesh, const Use& use) {
  std::size_t begin = 0;
  for (const std::uint32_t end : mesh.face_ends) {
    use(std::span(mesh.corners).subspan(begin, end - begin));
    begin = end;
  }
}

std::string obj_of(const PolygonMesh& mesh) {
  std::string out;
  for (const Vec3& p : mesh.vertices) out += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for_each_face(mesh, [&](auto corners) {
    out += "f";
    for (const std::uint32_t corner : corners) out += fmt::format(" {}", corner + 1);
    out += "\n";
  });
  return out;
}

std::string ply_of(const PolygonMesh& mesh, std::string_view format, bool has_faces_first = false) {
  const std::string vertex =
      fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
                  mesh.vertices.size());
  const std::string face = fmt::format(
      "element face {}\nproperty list uchar uint vertex_indices\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\n",
      mesh.face_ends.size());
  const auto put = [&](std::string& out, auto value) {
    if (format == "ascii") {
      out += fmt::format("{} ", value);
      return;
    }
    std::string bytes;
    append_bytes(bytes, value);
    if (format == "binary_big_endian") std::reverse(bytes.begin(), bytes.end());
    out += bytes;
  };
  std::string vertices, faces;
  for (const Vec3& p : mesh.vertices) {
    for (const double x : p) put(vertices, x);
  }
  std::uint8_t red = 0;
  for_each_face(mesh, [&](auto corners) {
    put(faces, static_cast<std::uint8_t>(corners.size()));
    for (const std::uint32_t corner : corners) put(faces, corner);
    for (const std::uint8_t level : {++red, std::uint8_t{0}, std::uint8_t{255}}) put(faces, level);
  });
  return fmt::format("ply\nformat {} 1.0\n", format) +
         (has_faces_first ? face + vertex : vertex + face) + "end_header\n" +
         (has_faces_first ? faces + vertices : vertices + faces);
}

TEST_F(MeshFile, TheSamePolygonsAreTheSameTrianglesInEveryFormat) {
  const TriangleMesh by_obj = load_mesh(file(write("house.obj", obj_of(house()))));
  ASSERT_EQ(by_obj.faces.size(), house().corners.size() - 2 * house().face_ends.size());
  EXPECT_EQ(by_obj.faces, triangulated(house()).faces);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const bool has_faces_first : {false, true}) {
      const std::string ply = ply_of(house(), format, has_faces_first);
      const TriangleMesh by_ply = load_mesh(file(write("house.ply", ply)));
      EXPECT_EQ(by_ply.vertices_m, by_obj.vertices_m) << format;
      EXPECT_EQ(by_ply.faces, by_obj.faces) << format;
    }
  }
}

TEST_F(MeshFile, TrianglesHaveTheColourOfTheirPolygon) {
  const TriangleMesh mesh = load_mesh(file(write("house.ply", ply_of(house(), "ascii"))));
  std::size_t triangle = 0, polygon = 0;
  for_each_face(house(), [&](auto corners) {
    const std::string name = fmt::format("colour_{:02x}00ff", ++polygon);
    for (std::size_t i = 2; i < corners.size(); ++i, ++triangle) {
      EXPECT_EQ(mesh.materials[mesh.face_material[triangle]].name, name);
    }
  });
  EXPECT_EQ(mesh.faces.size(), triangle);
}

TEST_F(MeshFile, ImpossibleFacesTakeTheirColoursWithThem) {
  PolygonMesh mesh = house();
  mesh.corners[6] = 99;  // of the second face
  std::vector<std::string> warnings;
  const auto path = write("house.ply", ply_of(mesh, "binary_little_endian"));
  const TriangleMesh read = load_mesh(test::forgiven(path), &warnings);
  ASSERT_EQ(read.faces.size(), house().corners.size() - 2 * house().face_ends.size() - 3);
  EXPECT_EQ(read.materials.size(), 8U);
  EXPECT_EQ(read.materials[read.face_material[2]].name, "colour_0100ff");
  EXPECT_EQ(read.materials[read.face_material[3]].name, "colour_0300ff");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(says(warnings[0], {"1 faces of vertices that do not exist"}));
}

TEST_F(MeshFile, ACountThatNoFileHoldsIsRefusedAtItsEnd) {
  std::string ply = ply_of(house(), "binary_little_endian");
  for (const char* element : {"element face ", "element vertex "}) {
    std::string lie = ply;
    const std::size_t at = lie.find(element) + std::string_view(element).size();
    lie.replace(at, lie.find('\n', at) - at, "18446744073709551615");
    EXPECT_TRUE(says(fault("lie.ply", lie), {"ends before all"})) << element;
  }
}

TEST_F(MeshFile, ObjFacesHaveTheMaterialThatIsCurrent) {
  write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl dark  steel \r\nKd 0.25\nKa 1 1 1\n");
  const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto names = [&](const std::string& text) {
    std::vector<std::string> out;
    const TriangleMesh mesh = load_mesh(file(write("t.obj", head + text)));
    for (const std::uint16_t index : mesh.face_material) out.push_back(mesh.materials[index].name);
    return out;
  };
  using Names = std::vector<std::string>;
  const std::string f = "f 1 2 3\n";
  EXPECT_EQ(names(f), Names{"DefaultMaterial"});
  EXPECT_EQ(names("mtllib a.mtl\n" + f), Names{"dark  steel"});
  EXPECT_EQ(names(f + "usemtl red\n" + f), (Names{"red", "red"}));
  EXPECT_EQ(
      names("mtllib a.mtl\n" + f + "usemtl red\n" + f + "usemtl new\n" + f + "usemtl red\n" + f),
      (Names{"dark  steel", "red", "new", "red"}));
  const TriangleMesh mesh = load_mesh(
      file(write("t.obj", head + "usemtl dark  steel\n" + f + "usemtl red\nmtllib a.mtl\n" + f)));
  EXPECT_EQ(mesh.materials[0].rgb, (std::array{0.25F, 0.25F, 0.25F}));  // one number is a grey
  EXPECT_EQ(mesh.materials[1].rgb, (std::array{1.0F, 0.0F, 0.0F}));
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(PlainText, ADecimalIsTheNearestDoubleAndOutOfItsRangeInfiniteOrZero) {
  const std::string many(400, '0');
  for (const auto& [text, value] : std::vector<std::pair<std::string, double>>{
           {"0.1", 0.1},
           {"+1", 1.0},
           {"-.5", -0.5},
           {"2.", 2.0},
           {"1E3", 1000.0},
           {"4.9e-324", std::numeric_limits<double>::denorm_min()},
           {"-inf", -kInfinity},
           {"1e309", kInfinity},
           {"0.0001e999", kInfinity},
           {"-1e+999999999999999999999", -kInfinity},
           {"1" + many, kInfinity},
           {"-1" + many + ".5e-10", -kInfinity},
           {"1e-400", 0.0},
           {"-9999e-999", -0.0},
           {"-1e-999999999999999999999", -0.0},
           {"." + many + "1", 0.0},
           {"-0." + many + "1e10", -0.0}}) {
    EXPECT_EQ(read_decimal(text), value) << text;
    EXPECT_EQ(std::signbit(read_decimal(text).value()), std::signbit(value)) << text;
  }
  EXPECT_TRUE(std::isnan(*read_decimal("nan")));
  for (const char* text :
       {"", "+", "-", "+-1", "++1", "--1", "1x", "x", "1,5", "1 ", " 1", "0x10", ".", "e5", "1e"}) {
    EXPECT_FALSE(read_decimal(text)) << text;
  }
}

TEST(PlainText, WordsStandBetweenBlanks) {
  std::vector<std::string_view> words = {"old"};
  split("  a\tbc   d e \r", words);
  EXPECT_EQ(words, (std::vector<std::string_view>{"a", "bc", "d", "e"}));
  EXPECT_EQ(joined(Words(words).subspan(1)), "bc   d e");
  split(" \t\r", words);
  EXPECT_TRUE(words.empty());
}

}  // namespace
}  // namespace gnbv
