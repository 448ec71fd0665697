#include <gtest/gtest.h>

#include "sim/core/file.hpp"
#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using namespace test;

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
  // inches, as the file declares: the README's figures, rounded to decimetres
  const Vec3 full_m = bounds_m(load_mesh(config)).sizes();
  EXPECT_LT((full_m - Vec3(99.1, 64.7, 48.0)).cwiseAbs().maxCoeff(), 0.06) << full_m.transpose();
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
