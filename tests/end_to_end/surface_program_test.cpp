// `gnbv surface` as its users meet it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/core/file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// A short mission with its frames, flown once for all tests.
class SurfaceProgram : public ::testing::Test {
 protected:
  SurfaceProgram() {
    const Outcome flown =
        gnbv("run smoke --frames --set planner.termination.max_iterations=12 --out " + run());
    EXPECT_EQ(flown.exit_code, 0) << flown.output;
  }
  std::string run() const { return (temp_.path() / "run").string(); }
  nlohmann::json score(const std::string& folder) const {
    return nlohmann::json::parse(read_file(fs::path(folder) / "score.json"));
  }
  TempFolder temp_;
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

}  // namespace
}  // namespace gnbv
