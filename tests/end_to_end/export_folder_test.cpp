// Laws of the folders that `gnbv export` writes: the same at any thread count, nothing of others is
// lost, what a run did not keep is named.
#include <map>

#include "tests/support/exported_run.hpp"
#include "tools/run/cloud_file.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

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

TEST_F(Export, ACameraThatCannotNameFilesIsRefused) {
  const fs::path named = folder_ / "named";
  fs::copy(run(), named, fs::copy_options::recursive);
  fs::remove_all(named / "export");
  for (const char* file : {"cameras.json", "poses.csv"}) {
    std::string text = read_file(named / "frames" / file);
    for (const char mark : {'"', ','}) {
      const std::string name = std::string(1, mark) + "rgbd" + mark;
      for (std::size_t at; (at = text.find(name)) != std::string::npos;) {
        text.replace(at + 1, 4, "a/b");
      }
    }
    write_file_atomically(named / "frames" / file, text);
  }
  for (const char* format : {"tum", "colmap"}) {
    const Outcome refused = gnbv("export " + named.string() + " --quiet --format " + format);
    EXPECT_EQ(refused.exit_code, 2) << format;
    EXPECT_TRUE(has(refused, "camera 'a/b' cannot name files")) << refused.output;
    EXPECT_FALSE(fs::exists(named / "export" / format));
  }
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
  EXPECT_EQ(gnbv("export " + run().string() + " --quiet --format tum --points 9").exit_code, 2)
      << "which has none";
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
  EXPECT_TRUE(fs::remove(bare / "profile.ply") && fs::remove(bare / "map.ot"));
  const Outcome plain = gnbv("export " + bare.string() + " --format plain");
  ASSERT_EQ(plain.exit_code, 0) << plain.output;
  for (const char* what : {"profile.ply: is missing", "map.ot: is missing", "--frames"}) {
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
