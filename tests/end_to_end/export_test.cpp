// Laws of `gnbv export`, on a mission that is flown once: what other programs read, parsed here
// anew, agrees with the run's own frames, pixel by pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "scenarios/load.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/file.hpp"
#include "tests/support/export_text.hpp"
#include "tests/support/program.hpp"
#include "tools/mission/cloud_file.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/render/image.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
class Export : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("gnbv_export_" + std::to_string(getpid()));
    fs::create_directories(folder_);
    const Outcome flown = gnbv("run smoke --quiet --frames --out " + run().string());
    ASSERT_EQ(flown.exit_code, 0) << flown.output;
    for (const std::string format : {"colmap", "nerfstudio", "plain", "tum"}) {
      const Outcome written = gnbv("export " + run().string() + " --quiet --format " + format);
      ASSERT_EQ(written.exit_code, 0) << written.output;
      ASSERT_EQ(written.output, out(format).string() + "\n");
    }
    read_own_frames();
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static fs::path run() { return folder_ / "run"; }
  static fs::path out(const std::string& format) { return run() / "export" / format; }

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

  static inline fs::path folder_;
  static inline std::vector<Isometry> T_world_camera_;
  static inline std::vector<GreyImage16> depth_;
  static inline std::vector<Image> colour_;
};

TEST_F(Export, ColmapPointsProjectWhereTheImagesShowThem) {
  const Numbers k = intrinsics();
  const auto all = points();
  const auto seen_by = images();
  ASSERT_EQ(seen_by.size(), T_world_camera_.size());
  ASSERT_GT(all.size(), 500U);
  std::vector<double> off_m;
  for (std::size_t i = 0; i < seen_by.size(); ++i) {
    EXPECT_TRUE(
        (seen_by[i].T_camera_world * T_world_camera_[i]).isApprox(Isometry::Identity(), 1e-6));
    for (const Vec3& o : seen_by[i].points2d) {
      const Vec3 p = seen_by[i].T_camera_world * all.at(static_cast<int>(o.z())).p_world_m;
      const double u_px = k[0] * p.x() / p.z() + k[2];
      const double v_px = k[1] * p.y() / p.z() + k[3];
      EXPECT_NEAR(u_px, o.x(), 0.01);
      EXPECT_NEAR(v_px, o.y(), 0.01);
      off_m.push_back(std::abs(depth_m(i, u_px, v_px) - p.z()));
    }
  }
  std::sort(off_m.begin(), off_m.end());
  // half a leaf, and half a pixel of a steep surface; most are on the surface to some millimetres
  EXPECT_LT(off_m.back(), 0.025 + 0.5 * 5.0 / k[0] * 5.7 + 0.001);
  EXPECT_LT(off_m[off_m.size() / 2], 0.008);
}

TEST_F(Export, ColmapTracksAndColoursAreThoseOfTheImages) {
  const auto seen_by = images();
  const Numbers k = intrinsics();
  std::size_t strange = 0;
  std::size_t in_tracks = 0;
  std::size_t in_images = 0;
  for (const ColmapImage& image : seen_by) in_images += image.points2d.size();
  for (const auto& [number, point] : points()) {
    EXPECT_GE(point.track.size(), 2U);
    in_tracks += point.track.size();
    std::multimap<double, std::array<int, 3>> colours;  // by distance
    for (const auto& [image, index] : point.track) {
      const ColmapImage& by = seen_by[static_cast<std::size_t>(image - 1)];
      EXPECT_EQ(by.points2d[static_cast<std::size_t>(index)].z(), number);
      const Vec3 p = by.T_camera_world * point.p_world_m;
      const auto rgb = colour_[static_cast<std::size_t>(image - 1)].at(
          static_cast<int>(k[0] * p.x() / p.z() + k[2]),
          static_cast<int>(k[1] * p.y() / p.z() + k[3]));
      colours.insert({p.z(), {rgb[0], rgb[1], rgb[2]}});
    }
    // from one place, two frames are as near as each other: rounding may choose
    const bool is_of_a_nearest = std::any_of(colours.begin(), colours.end(), [&](const auto& c) {
      return c.first < colours.begin()->first + 1e-6 && c.second == point.rgb;
    });
    if (!is_of_a_nearest) ++strange;
  }
  EXPECT_EQ(in_tracks, in_images);
  EXPECT_LE(1000 * strange, points().size());  // on the border of two pixels rounding chooses, too
}

/// The true structure, seen through the centres of the pixels as COLMAP numbers them.
TEST_F(Export, PixelCentresLieAtHalfPixels) {
  std::vector<std::string> warnings;
  const RayScene scene(load_world(load_scenario("smoke", {}), warnings));
  const Numbers k = intrinsics();
  const auto share_agreeing = [&](std::size_t frame, double centre_px) {
    const Isometry T = T_world_camera_[frame];
    std::size_t agreeing = 0;
    std::size_t seen = 0;
    for (int v = 0; v < depth_[frame].height_px; ++v) {
      for (int u = 0; u < depth_[frame].width_px; ++u) {
        const Vec3 ray((u + centre_px - k[2]) / k[0], (v + centre_px - k[3]) / k[1], 1.0);
        const Vec3f direction = (T.linear() * ray).cast<float>();
        RayHit hit;
        scene.first_hits(T.translation().cast<float>(), {&direction, 1}, 0.01F, 100.0F, {&hit, 1});
        const double z_m = depth_m(frame, u, v);
        if (z_m == 0.0) continue;
        ++seen;
        if (std::abs(hit.distance_m - z_m) < 0.001) ++agreeing;
      }
    }
    return static_cast<double>(agreeing) / static_cast<double>(seen);
  };
  for (std::size_t frame = 0; frame < depth_.size(); frame += 4) {
    EXPECT_GT(share_agreeing(frame, 0.5), 0.99);
    EXPECT_LT(share_agreeing(frame, 0.0), 0.9);
    EXPECT_LT(share_agreeing(frame, 1.0), 0.9);
  }
}

TEST_F(Export, NerfstudioPosesAreOurs) {
  const auto json = nlohmann::json::parse(read_file(out("nerfstudio") / "transforms.json"));
  ASSERT_EQ(json.at("frames").size(), T_world_camera_.size());
  for (std::size_t i = 0; i < T_world_camera_.size(); ++i) {
    const auto& frame = json["frames"][i];
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c < 4; ++c) {
        const double sign = c == 1 || c == 2 ? -1.0 : 1.0;  // y up, z back
        EXPECT_NEAR(sign * frame["transform_matrix"][r][c].get<double>(), T_world_camera_[i](r, c),
                    1e-6);
      }
    }
    EXPECT_EQ(frame["fl_y"].get<double>(), intrinsics()[1]);
    EXPECT_EQ(
        read_png_grey16(out("nerfstudio") / frame["depth_file_path"].get<std::string>()).values,
        depth_[i].values);
    EXPECT_EQ(read_png(out("nerfstudio") / frame["file_path"].get<std::string>()).rgb,
              colour_[i].rgb);
  }
  EXPECT_EQ(json["depth_unit_scale_factor"], 0.001);
  EXPECT_TRUE(fs::exists(out("nerfstudio") / json["ply_file_path"].get<std::string>()));
}

/// Without errors of the estimate, what was believed is what was.
TEST_F(Export, TumTruthAndEstimateAgree) {
  std::map<std::string, Isometry> truth;
  double before_s = 0.0;
  for (const std::string& line : lines_of(out("tum") / "rgbd/groundtruth.txt")) {
    const auto cells = cells_of(line, ' ');
    ASSERT_EQ(cells.size(), 8U) << line;
    EXPECT_GT(std::stod(cells[0]), before_s);
    before_s = std::stod(cells[0]);
    truth[cells[0]] = pose_of(cells, 1);
  }
  const auto estimates = lines_of(out("tum") / "rgbd/estimate.txt");
  const auto pairs = lines_of(out("tum") / "rgbd/associations.txt");
  ASSERT_EQ(estimates.size(), T_world_camera_.size());
  EXPECT_EQ(before_s, std::stod(cells_of(estimates.back(), ' ')[0]));
  ASSERT_EQ(pairs.size(), T_world_camera_.size());
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const auto cells = cells_of(estimates[i], ' ');
    ASSERT_TRUE(truth.contains(cells[0])) << cells[0];
    const Isometry off = truth[cells[0]].inverse() * pose_of(cells, 1);
    EXPECT_LT(off.translation().norm(), 0.003);
    EXPECT_LT(Eigen::AngleAxisd(off.linear()).angle(), deg_to_rad(1.0));
    EXPECT_TRUE(pose_of(cells, 1).isApprox(T_world_camera_[i], 1e-6));
    EXPECT_EQ(read_png(out("tum") / "rgbd" / cells_of(pairs[i], ' ')[1]).rgb, colour_[i].rgb);
  }
}

TEST_F(Export, PlainFilesHoldBodyAndCamera) {
  const auto json = nlohmann::json::parse(read_file(out("plain") / "intrinsics.json"));
  Isometry T_body_camera;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) {
      T_body_camera(r, c) = json["cameras"][0]["T_body_camera"][r][c].get<double>();
    }
  }
  const auto rows = lines_of(out("plain") / "views.csv");
  ASSERT_EQ(rows.size(), T_world_camera_.size() + 1);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto cells = cells_of(rows[i], ',');
    EXPECT_TRUE((pose_of(cells, 3) * T_body_camera).isApprox(pose_of(cells, 10), 1e-6));
    EXPECT_TRUE(pose_of(cells, 10).isApprox(T_world_camera_[i - 1], 1e-6));
  }
  const std::string readme = read_file(out("plain") / "README.txt");
  for (const auto& entry : fs::directory_iterator(out("plain"))) {
    const std::string name = entry.path().filename().string();
    if (name == "README.txt" || name == "gnbv-export.json") continue;
    EXPECT_NE(readme.find(name), std::string::npos) << name;
  }
}

TEST_F(Export, ThreadsChangeNothing) {
  for (const std::string format : {"colmap", "nerfstudio", "plain", "tum"}) {
    const fs::path one = folder_ / ("one-" + format);
    ASSERT_EQ(gnbv("export " + run().string() + " --quiet --threads 1 --format " + format + " -o " +
                   one.string())
                  .exit_code,
              0);
    const auto files_of = [](const fs::path& folder) {
      std::map<std::string, std::string> files;
      for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        files[entry.path().lexically_relative(folder).string()] = read_file(entry.path());
      }
      return files;
    };
    EXPECT_TRUE(files_of(one) == files_of(out(format))) << format;
  }
}

TEST_F(Export, WritesOverNothingButAnExport) {
  const fs::path other = folder_ / "thesis";
  fs::create_directories(other);
  write_file_atomically(other / "thesis.txt", "words");
  const std::string command = "export " + run().string() + " --quiet --format tum -o ";
  const Outcome refused = gnbv(command + other.string());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(has(refused, "no earlier export")) << refused.output;
  EXPECT_EQ(read_file(other / "thesis.txt"), "words");
  const fs::path stray = out("tum") / "rgbd" / "stray.db";
  write_file_atomically(stray, "features");
  const Outcome kept = gnbv(command + out("tum").string());
  EXPECT_EQ(kept.exit_code, 2);
  EXPECT_TRUE(has(kept, "rgbd/stray.db")) << kept.output;
  EXPECT_EQ(read_file(stray), "features");
  fs::remove(stray);
  EXPECT_EQ(gnbv(command + out("tum").string()).exit_code, 0);
  for (const auto& entry : fs::directory_iterator(run() / "export")) {
    EXPECT_FALSE(entry.path().filename().string().starts_with('.')) << entry.path();
  }
}

TEST_F(Export, ClearsUpAfterAnExportThatWasKilled) {
  const fs::path folder = folder_ / "killed" / "tum";
  const fs::path old = folder_ / "killed" / ".tum.gnbv-old";
  const fs::path part = folder_ / "killed" / ".tum.gnbv-part";
  const std::string command = "export " + run().string() + " --quiet --format tum -o ";
  ASSERT_EQ(gnbv(command + folder.string()).exit_code, 0);
  fs::rename(folder, old);
  fs::create_directories(part);
  write_file_atomically(part / "half", "");
  write_file_atomically(old / "stray", "");
  EXPECT_EQ(gnbv(command + folder.string()).exit_code, 2);  // it came back, and holds a stray file
  EXPECT_TRUE(fs::exists(folder / "stray"));
  fs::remove(folder / "stray");
  fs::create_directories(old);
  EXPECT_EQ(gnbv(command + folder.string()).exit_code, 0);
  EXPECT_FALSE(fs::exists(old));
  EXPECT_FALSE(fs::exists(part));
}

/// As many points as are allowed are taken.
TEST_F(Export, TakesAsManyPointsAsItMay) {
  const std::size_t count = read_cloud(run() / "cloud.ply").size();
  const auto points_of = [&](std::size_t max_points) {
    const fs::path folder = folder_ / ("points-" + std::to_string(max_points));
    EXPECT_EQ(gnbv("export " + run().string() + " --quiet --format colmap --points " +
                   std::to_string(max_points) + " -o " + folder.string())
                  .exit_code,
              0);
    return colmap_points(folder / "sparse/0").size();
  };
  EXPECT_EQ(points_of(count), points().size());
  EXPECT_LT(points_of(count - 1), 0.6 * static_cast<double>(points().size()));
}

TEST_F(Export, WithoutFramesThePathIsStillThere) {
  const fs::path bare = folder_ / "bare";
  fs::copy(run(), bare);  // files only
  for (const std::string format : {"colmap", "nerfstudio"}) {
    const Outcome refused = gnbv("export " + bare.string() + " --format " + format);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_TRUE(has(refused, "--frames")) << refused.output;
    EXPECT_FALSE(fs::exists(bare / "export" / format));
  }
  ASSERT_EQ(gnbv("export " + bare.string() + " --format tum").exit_code, 0);
  const auto written = lines_of(bare / "export/tum/trajectory.txt");
  const auto own = lines_of(bare / "trajectory.tum");
  ASSERT_EQ(written.size(), own.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    const auto cells = cells_of(written[i], ' ');
    ASSERT_EQ(cells.size(), 8U);
    EXPECT_EQ(cells[0], cells_of(own[i], ' ')[0]);
    EXPECT_TRUE(pose_of(cells, 1).isApprox(pose_of(cells_of(own[i], ' '), 1), 1e-6));
  }
  EXPECT_TRUE(fs::remove(bare / "profile.ply") && fs::remove(bare / "map.bt"));
  const Outcome plain = gnbv("export " + bare.string() + " --format plain");
  ASSERT_EQ(plain.exit_code, 0) << plain.output;
  for (const char* what : {"profile.ply: is missing", "map.bt: is missing", "--frames"}) {
    EXPECT_TRUE(has(plain, what)) << plain.output;
  }
  EXPECT_NE(read_file(bare / "export/plain/views.csv").find(",planned,"), std::string::npos);
  fs::remove(bare / "trajectory.tum");
  const Outcome refused = gnbv("export " + bare.string() + " --format tum");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(has(refused, "--resume")) << refused.output;
}

}  // namespace
}  // namespace gnbv
