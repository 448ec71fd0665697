// The files of the built-in structures, and what the program says of damaged ones.
#include <gtest/gtest.h>

#include <array>

#include "assets/catalog.hpp"
#include "scenarios/scenario.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

TEST(StructureFiles, AreWhatTheProgramWritesOfTheStructure) {
  const TempFolder temp;
  for (const std::string_view name : kStructureNames) {
    const StructureTexts texts = builtin_structure_texts(name);
    const std::filesystem::path path = temp.path() / (std::string(name) + ".obj");
    write_mesh(read_structure(texts), path);
    EXPECT_TRUE(read_file(path) == texts.obj) << name;
    EXPECT_TRUE(read_file(std::filesystem::path(path).replace_extension(".mtl")) == texts.mtl);
  }
}

std::string complaint(const StructureTexts& texts) {
  return test::fault_of([&] { read_structure(texts); });
}

const std::string kObj = "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl clay\nf 1 2 3\n";
const std::string kMtl = "newmtl clay\nKd 0.5 0.25 0.125\nnewmtl sand\nKd 1 1 0\n";
const std::string kClay = "t:\n  clay: {pattern: bricks, rgb_2: [0.1, 0.2, 0.3], ";
const std::string kTable = kClay + "pattern_size_m: 0.5}\n";

TEST(StructureFiles, GiveAMaterialItsColourAndItsSolidTexture) {
  const TriangleMesh mesh = read_structure({"t", kObj, kMtl, kTable});
  ASSERT_EQ(mesh.materials.size(), 1U);
  const Material& clay = mesh.materials[0];
  EXPECT_EQ(clay.name, "clay");
  EXPECT_EQ(clay.rgb, (std::array{0.5F, 0.25F, 0.125F}));
  EXPECT_EQ(clay.pattern, Pattern::bricks);
  EXPECT_EQ(clay.rgb_2, (std::array{0.1F, 0.2F, 0.3F}));
  EXPECT_EQ(clay.pattern_size_m, 0.5F);
}

TEST(StructureFiles, NumberMaterialsAsTheTableDoes) {
  const std::string sand = "  sand: {pattern: noise, rgb_2: [0, 0, 0], pattern_size_m: 1}\n";
  const std::string obj = kObj + "usemtl sand\nf 3 2 1\n";
  const TriangleMesh mesh = read_structure({"t", obj, kMtl, "t:\n" + sand + kTable.substr(3)});
  EXPECT_EQ(mesh.materials.at(0).name, "sand");
  EXPECT_EQ(mesh.face_material, (std::vector<std::uint16_t>{1, 0}));
}

TEST(StructureFiles, ThatAreDamagedGetOneClearError) {
  struct Damage {
    std::string obj, table, error;
  };
  const std::vector<Damage> damages = {
      {"", kTable, "assets/t.obj: holds no faces"},
      {"v 0 0\n", kTable, "assets/t.obj:1: vertex 1 has no three coordinates"},
      {kObj + "f 1 2 9\n", kTable,
       "assets/t.obj: 1 faces of vertices that do not exist left out, the first in line 7"},
      {kObj + "garbage\n", kTable,
       "assets/t.obj: 1 unreadable lines left out, the first in line 7"},
      {kObj + "v nan 0 0\n", kTable, "assets/t.obj:7: vertex 4 has the coordinate nan"},
      {kObj + "usemtl sand\nf 3 2 1\n", kTable,
       "assets/materials.yaml:2: t.sand: is missing: faces of assets/t.obj have this material"},
      {kObj, "", "assets/materials.yaml:1: is empty; a scenario is a map of keys"},
      {kObj, "u: {}\n", "assets/materials.yaml:1: t: is missing"},
      {kObj, kTable + "  sand: {}\n",
       "assets/materials.yaml:3: t.sand: no face of assets/t.obj has this material"},
      {kObj, kClay + "}\n", "assets/materials.yaml:2: t.clay.pattern_size_m: is missing"},
      {kObj, kClay + "pattern_size_m: 0}\n",
       "assets/materials.yaml:2: t.clay.pattern_size_m: value '0': is out of range (allowed: above "
       "0, up to 100)"},
      {kObj, kClay + "pattern_size_m: 1, shine: 2}\n",
       "assets/materials.yaml:2: t.clay.shine: is no known key (known here: pattern, rgb_2, "
       "pattern_size_m)"}};
  for (const auto& [obj, table, error] : damages) {
    EXPECT_EQ(complaint({"t", obj, kMtl, table}), error);
  }
}

}  // namespace
}  // namespace gnbv
