// Laws of `gnbv export`, on a mission that is flown once: what other programs read, parsed here
// anew, agrees with the run's own frames, pixel by pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "scenarios/load.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/file.hpp"
#include "sim/core/image.hpp"
#include "tests/support/export_text.hpp"
#include "tests/support/program.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/run/cloud_file.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {
namespace {

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

namespace fs = std::filesystem;

/// What is exported is read from the run; of a whole one nothing is missing.
TEST_F(Export, AWholeRunIsReadWithItsFigures) {
  const RunRecord record = read_run(run());
  EXPECT_TRUE(record.missing.empty());
  ASSERT_TRUE(record.figures.has_value());
  EXPECT_EQ(record.figures->curve.views(), record.views.size());
  EXPECT_GE(*record.views_begin_s, *record.profile_end_s);
}

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
    const bool is_of_a_nearest =
        std::any_of(colours.begin(), colours.end(), [&, rgb = point.rgb](const auto& c) {
          return c.first < colours.begin()->first + 1e-6 && c.second == rgb;
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
  // each point of the cloud with its colour and the view that brought it
  const std::string ply = read_file(out("plain") / "cloud.ply");
  constexpr std::string_view kLast = "property int view\nend_header\n";
  const std::size_t header = ply.find(kLast);
  ASSERT_NE(header, std::string::npos);
  const std::vector<ViewRecord> views = read_view_records(run() / "iterations.csv");
  const std::size_t count = views.back().cloud_points;
  const std::size_t begin = header + kLast.size();
  constexpr std::size_t kPointBytes = 3 * 4 + 3 + 4;
  ASSERT_EQ(ply.size() - begin, kPointBytes * count);
  std::size_t before = read_cloud(run() / "profile.ply").size();
  const auto view_of = [&](std::size_t point) {
    std::int32_t view = 0;
    std::memcpy(&view, ply.data() + begin + (point + 1) * kPointBytes - 4, sizeof view);
    return view;
  };
  EXPECT_EQ(view_of(0), -1);
  EXPECT_EQ(view_of(before - 1), -1);
  for (const ViewRecord& view : views) {
    if (view.cloud_points == before) continue;
    EXPECT_EQ(view_of(before), view.iteration);
    EXPECT_EQ(view_of(view.cloud_points - 1), view.iteration);
    before = view.cloud_points;
  }
  const std::string readme = read_file(out("plain") / "README.txt");
  for (const auto& entry : fs::directory_iterator(out("plain"))) {
    const std::string name = entry.path().filename().string();
    if (name == "README.txt" || name == "gnbv-export.json") continue;
    EXPECT_NE(readme.find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace gnbv
