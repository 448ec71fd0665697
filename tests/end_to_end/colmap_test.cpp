// The real COLMAP reads what `gnbv export` writes, and triangulates features of our images, from
// our poses, onto the true surface.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "scenarios/load.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/file.hpp"
#include "tests/support/export_text.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/mission/load_world.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

// images as large as the paper's; the mission's own have a sixteenth of the pixels, and no features
constexpr const char* kFlight =
    " --set cameras.0.width_px=640 --set cameras.0.height_px=480"
    " --set planner.termination.max_iterations=20";

/// A command of COLMAP, on the processor and without a display; fails the test with its last words.
std::string colmap(const std::string& arguments) {
  const Outcome outcome = shell("QT_QPA_PLATFORM=offscreen colmap " + arguments + " 2>&1");
  EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.output;
  return outcome.output;
}

double figure(const std::string& report, const std::string& name) {
  const std::size_t at = report.find(name + ":");
  if (at != std::string::npos) return std::stod(report.substr(at + name.size() + 1));
  ADD_FAILURE() << "no " << name << " in:\n" << report;
  return 0.0;
}

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

void print_distances(const std::string& name, const std::vector<double>& off_m) {
  const auto near = std::count_if(off_m.begin(), off_m.end(), [](double d) { return d < 0.05; });
  fmt::print(
      "{} {}: {:.0f} mm from the surface at the median, {:.0f} mm at 90 %, {:.0f} % within 5 cm\n",
      off_m.size(), name, 1000.0 * quantile(off_m, 0.5), 1000.0 * quantile(off_m, 0.9),
      100.0 * static_cast<double>(near) / static_cast<double>(off_m.size()));
}

TEST(Colmap, TriangulatesOurImagesOntoTheTrueSurface) {
  if (shell("command -v colmap").exit_code != 0) GTEST_SKIP() << "colmap is not installed";
  TempFolder temp;
  const fs::path run = temp.path() / "run";
  const fs::path model = temp.path() / "model";
  const Outcome flown = gnbv("run smoke --quiet --frames --out " + run.string() + kFlight);
  ASSERT_EQ(flown.exit_code, 0) << flown.output;
  ASSERT_EQ(
      gnbv("export " + run.string() + " --quiet --format colmap -o " + model.string()).exit_code,
      0);

  const std::string report = colmap("model_analyzer --path " + (model / "sparse/0").string());
  const auto exported = colmap_images(model / "sparse/0");
  EXPECT_EQ(figure(report, "Registered images"), static_cast<double>(exported.size()));
  EXPECT_EQ(figure(report, "Points"),
            static_cast<double>(colmap_points(model / "sparse/0").size()));
  EXPECT_GT(figure(report, "Mean track length"), 2.0);
  EXPECT_LT(figure(report, "Mean reprojection error"), 0.5);

  const std::string database = " --database_path " + (temp.path() / "d.db").string();
  const std::string pictures = " --image_path " + (model / "images").string();
  colmap(
      "feature_extractor --SiftExtraction.use_gpu 0 --ImageReader.camera_model PINHOLE "
      "--ImageReader.single_camera_per_folder 1 --ImageReader.camera_params " +
      fmt::format("{}", fmt::join(colmap_intrinsics(model / "sparse/0"), ",")) + database +
      pictures);
  colmap("exhaustive_matcher --SiftMatching.use_gpu 0" + database);
  const fs::path triangulated = temp.path() / "triangulated";
  fs::create_directories(triangulated);
  colmap(
      "point_triangulator --clear_points 1 --Mapper.ba_refine_focal_length 0 "
      "--Mapper.filter_max_reproj_error 2 --Mapper.filter_min_tri_angle 5 --Mapper.tri_min_angle 5 "
      "--input_path " +
      (model / "sparse/0").string() + " --output_path " + triangulated.string() + database +
      pictures);
  colmap("model_converter --output_type TXT --input_path " + triangulated.string() +
         " --output_path " + triangulated.string());

  std::vector<std::string> warnings;
  const Scenario scenario = load_scenario("smoke", {});
  const RayScene scene(load_world(scenario, warnings));
  const Box3 around(scenario.workspace_m.min() - Vec3(0, 0, 1), scenario.workspace_m.max());
  std::vector<double> all_m;
  std::vector<double> sure_m;
  for (const auto& [number, point] : colmap_points(triangulated)) {
    // COLMAP also finds the ground far beyond the hall, and the edge of the sky
    if (!around.contains(point.p_world_m)) continue;
    const double off_m = std::min(scene.distance_to_structure_m(point.p_world_m, 1e3),
                                  std::abs(point.p_world_m.z()));
    all_m.push_back(off_m);
    if (point.track.size() > 2) sure_m.push_back(off_m);
  }
  ASSERT_GT(sure_m.size(), 60U);
  print_distances("all points", all_m);
  print_distances("points of three images or more", sure_m);
  // two images can agree on two different bricks of one row; a third seldom joins them
  EXPECT_LT(quantile(all_m, 0.5), 0.05);
  EXPECT_LT(quantile(sure_m, 0.5), 0.02);
  EXPECT_LT(quantile(sure_m, 0.85), 0.05);
}

}  // namespace
}  // namespace gnbv
