// `gnbv surface` as its users meet it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "sim/core/file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// A short mission with its frames, flown once for all tests; each has a copy.
class SurfaceProgram : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    flown_ = fs::temp_directory_path() / ("gnbv_surface_program_" + std::to_string(getpid()));
    const Outcome flown = gnbv(
        "run smoke --frames --set planner.termination.max_iterations=12 --out " + flown_.string());
    ASSERT_EQ(flown.exit_code, 0) << flown.output;
  }
  static void TearDownTestSuite() { fs::remove_all(flown_); }

  SurfaceProgram() { fs::copy(flown_, run(), fs::copy_options::recursive); }
  std::string run() const { return (temp_.path() / "run").string(); }
  nlohmann::json score(const std::string& folder) const {
    return nlohmann::json::parse(read_file(fs::path(folder) / "score.json"));
  }
  TempFolder temp_;

 private:
  inline static fs::path flown_;
};

TEST_F(SurfaceProgram, MakesATexturedSurfaceThatIsTheTrueOne) {
  const Outcome made = gnbv("surface " + run() + " --threads 1 2>/dev/null");
  ASSERT_EQ(made.exit_code, 0);
  for (const char* name : {"surface.glb", "surface.obj", "surface.mtl", "surface.png",
                           "surface.ply", "preview.png", "score.json"}) {
    const fs::path path = fs::path(run()) / "surface" / name;
    EXPECT_TRUE(fs::exists(path)) << name;
    EXPECT_TRUE(has(made, path.string() + "\n")) << name;
  }
  EXPECT_TRUE(has(made, "Precision")) << made.output;
  EXPECT_GT(score(run() + "/surface").at("at").at(1).at("f").get<double>(), 0.95);

  const std::string other = (temp_.path() / "other").string();
  const Outcome again =
      gnbv("surface " + run() + " --threads 2 --json -o " + other + " 2>/dev/null");
  ASSERT_EQ(again.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(again.output), score(other));
  for (const char* name : {"surface.glb", "surface.obj", "surface.png", "score.json"}) {
    EXPECT_EQ(read_file(fs::path(run()) / "surface" / name), read_file(fs::path(other) / name))
        << name;
  }
}

TEST_F(SurfaceProgram, SaysWhatIsMissingAndWhichCommandMakesIt) {
  fs::remove_all(fs::path(run()) / "frames");
  const Outcome plain = gnbv("surface " + run());
  EXPECT_EQ(plain.exit_code, 0) << plain.output;
  EXPECT_TRUE(has(plain, "--frames --out NEW")) << plain.output;
  EXPECT_FALSE(fs::exists(fs::path(run()) / "surface" / "surface.png"));

  const Outcome deep = gnbv("surface " + run() + " --depth 13");
  EXPECT_EQ(deep.exit_code, 2);
  EXPECT_TRUE(has(deep, "--depth: '13'")) << deep.output;

  fs::remove(fs::path(run()) / "cloud.ply");
  fs::remove_all(fs::path(run()) / "surface");
  const Outcome empty = gnbv("surface " + run());
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_TRUE(has(empty, "cloud.ply: is missing")) << empty.output;
  EXPECT_FALSE(fs::exists(fs::path(run()) / "surface"));  // nothing half made
}

TEST_F(SurfaceProgram, ADamagedPictureCostsTheTextureAndNoMore) {
  std::vector<fs::path> pngs;
  for (const auto& entry : fs::directory_iterator(fs::path(run()) / "frames")) {
    if (entry.path().extension() == ".png") pngs.push_back(entry.path());
  }
  ASSERT_GT(pngs.size(), 4U);
  for (const fs::path& png : pngs) write_file_atomically(png, "no picture");
  const Outcome damaged = gnbv("surface " + run() + " --depth 6");
  EXPECT_EQ(damaged.exit_code, 0) << damaged.output;
  EXPECT_TRUE(has(damaged, ".png")) << damaged.output;
  EXPECT_TRUE(has(damaged, "--frames --out NEW")) << damaged.output;
  EXPECT_TRUE(fs::exists(fs::path(run()) / "surface" / "surface.glb"));
  EXPECT_FALSE(fs::exists(fs::path(run()) / "surface" / "surface.png"));

  fs::remove(pngs.front());
  const Outcome missing = gnbv("surface " + run() + " --depth 6 --no-texture");
  EXPECT_EQ(missing.exit_code, 0) << missing.output;
  EXPECT_TRUE(has(missing, "no image `" + pngs.front().filename().string())) << missing.output;
}

TEST_F(SurfaceProgram, WithoutTheTrueStructureThereIsASurfaceButNoScore) {
  const fs::path mesh = temp_.path() / "damaged.obj";
  write_file_atomically(mesh, "f 1 2 3\n");
  std::string yaml = read_file(fs::path(run()) / "scenario.yaml");
  const std::string no_path = "path: \"\"";
  ASSERT_NE(yaml.find(no_path), std::string::npos);
  yaml.replace(yaml.find(no_path), no_path.size(), "path: " + mesh.string());
  write_file_atomically(fs::path(run()) / "scenario.yaml", yaml);
  fs::create_directories(fs::path(run()) / "surface");
  write_file_atomically(fs::path(run()) / "surface" / "score.json", "of an earlier call");

  const Outcome made = gnbv("surface " + run() + " --depth 6");
  EXPECT_EQ(made.exit_code, 0) << made.output;
  EXPECT_TRUE(has(made, "there is no score")) << made.output;
  EXPECT_TRUE(fs::exists(fs::path(run()) / "surface" / "surface.glb"));
  EXPECT_FALSE(fs::exists(fs::path(run()) / "surface" / "score.json"));
  EXPECT_EQ(gnbv("surface " + run() + " --depth 6 --json").exit_code, 2);
}

TEST_F(SurfaceProgram, AFolderThatCannotBeMadeCostsNoWork) {
  const std::string file = (temp_.path() / "file").string();
  write_file_atomically(file, "in the way");
  const Outcome made = gnbv("surface " + run() + " -o " + file + "/folder");
  EXPECT_EQ(made.exit_code, 2);
  EXPECT_TRUE(has(made, file + "/folder: cannot make the folder")) << made.output;
  EXPECT_FALSE(has(made, "Poisson")) << made.output;
}

}  // namespace
}  // namespace gnbv
