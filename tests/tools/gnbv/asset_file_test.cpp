// `gnbv asset`: what is written is the structure.
#include <gtest/gtest.h>

#include "assets/catalog.hpp"
#include "scenarios/scenario.hpp"
#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

TEST(AssetFile, EveryStructureReadsBackAsItWasInEveryFormat) {
  TempFolder temp;
  for (const std::string_view name : kStructureNames) {
    const TriangleMesh mesh = make_builtin_structure(name);
    for (const char* extension : {".obj", ".ply", ".glb"}) {
      const std::filesystem::path path = temp.path() / (std::string(name) + extension);
      write_mesh(mesh, path);
      std::vector<std::string> warnings;
      const TriangleMesh back = load_mesh(test::file(path), &warnings);
      EXPECT_TRUE(warnings.empty()) << warnings.front();
      const bool has_materials = std::string_view(extension) != ".ply";  // colours of faces instead
      EXPECT_TRUE(test::coloured_triangles(back, has_materials) ==
                  test::coloured_triangles(mesh, has_materials))
          << path;
    }
  }
}

}  // namespace
}  // namespace gnbv
