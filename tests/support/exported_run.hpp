// A mission that is flown once, and exported in every format.
#pragma once

#include <gtest/gtest.h>

#include "sim/core/file.hpp"
#include "sim/core/image.hpp"
#include "tests/support/export_text.hpp"
#include "tests/support/program.hpp"

namespace gnbv {

class Export : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::temp_directory_path() / ("gnbv_export_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    const Outcome flown = gnbv("run smoke --quiet --frames --out " + run().string());
    ASSERT_EQ(flown.exit_code, 0) << flown.output;
    for (const std::string format : {"colmap", "nerfstudio", "plain", "tum"}) {
      const Outcome written = gnbv("export " + run().string() + " --quiet --format " + format);
      ASSERT_EQ(written.exit_code, 0) << written.output;
      ASSERT_EQ(written.output, out(format).string() + "\n");
    }
    read_own_frames();
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }

  static std::filesystem::path run() { return folder_ / "run"; }
  static std::filesystem::path out(const std::string& format) { return run() / "export" / format; }

  static void read_own_frames() {
    for (const std::string& line : lines_of(run() / "frames" / "poses.csv")) {
      const auto cells = cells_of(line, ',');
      if (cells[0] == "iteration") continue;
      T_world_camera_.push_back(pose_of(cells, 3));
      depth_.push_back(read_png_grey16(run() / "frames" / cells[11]));
      colour_.push_back(read_png(run() / "frames" / cells[10]));
    }
  }

  static Numbers intrinsics() { return colmap_intrinsics(out("colmap") / "sparse/0"); }
  static std::vector<ColmapImage> images() { return colmap_images(out("colmap") / "sparse/0"); }
  static std::map<int, ColmapPoint> points() { return colmap_points(out("colmap") / "sparse/0"); }

  static double depth_m(std::size_t frame, double u_px, double v_px) {
    const GreyImage16& image = depth_[frame];
    return 0.001 *
           image.values[static_cast<std::size_t>(v_px) * static_cast<std::size_t>(image.width_px) +
                        static_cast<std::size_t>(u_px)];
  }

  static inline std::filesystem::path folder_;
  static inline std::vector<Isometry> T_world_camera_;
  static inline std::vector<GreyImage16> depth_;
  static inline std::vector<Image> colour_;
};

}  // namespace gnbv
