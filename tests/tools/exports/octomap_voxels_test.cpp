#include "tools/exports/octomap_voxels.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "planner/map/octomap_io.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/rng.hpp"
#include "tests/support/export_text.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/exports/colmap.hpp"

namespace gnbv {
namespace {

/// Files of a map, every voxel of which is free, occupied or unmeasured by chance.
class OctomapVoxels : public ::testing::Test {
 protected:
  OctomapVoxels() : grid_(OccupancyConfig{}, Box3(Vec3(-3, -2, 0), Vec3(3, 2, 2))) {
    ScanUpdate update;
    for (VoxelIndex v = 0; v < grid_.geometry().voxel_count(); ++v) {
      const double u = uniform01({53, Stream::bench, 0, v});
      if (u < 0.5) update.free.push_back(v);
      if (u > 0.8) update.occupied.push_back(v);
    }
    grid_.apply(update);
  }

  TempFolder folder_;
  OccupancyGrid grid_;
};

TEST_F(OctomapVoxels, ReadBackAsTheVoxelsOfTheMap) {
  // a whole cube of occupied voxels is pruned to one node, and has to come apart again
  ScanUpdate update;
  for (VoxelIndex v = 0; v < grid_.geometry().voxel_count(); ++v) {
    const Key key = grid_.geometry().key_at(v);
    const bool is_in = std::ranges::all_of(key, [](std::int32_t k) { return k >= 0 && k < 4; });
    if (is_in) update.occupied.push_back(v);
  }
  grid_.apply(update);
  write_octomap(grid_, folder_.path() / "map");
  const MeasuredVoxels read = read_octomap(folder_.path() / "map.bt");
  EXPECT_EQ(read.voxel_m, 0.2);
  std::vector<VoxelIndex> occupied;
  for (const Vec3f& centre_m : read.occupied_world_m) {
    const Vec3 scaled = centre_m.cast<double>() / read.voxel_m - Vec3::Constant(0.5);
    EXPECT_LT((scaled - scaled.array().round().matrix()).norm(), 1e-4);
    const Key key = {static_cast<std::int32_t>(std::lround(scaled.x())),
                     static_cast<std::int32_t>(std::lround(scaled.y())),
                     static_cast<std::int32_t>(std::lround(scaled.z()))};
    occupied.push_back(grid_.geometry().index_of(key));
  }
  std::ranges::sort(occupied);
  std::vector<VoxelIndex> expected;
  for (VoxelIndex v = 0; v < grid_.geometry().voxel_count(); ++v) {
    if (grid_.state(v) == VoxelState::occupied) expected.push_back(v);
  }
  EXPECT_EQ(occupied, expected);
  std::size_t measured = 0;
  for (VoxelIndex v = 0; v < grid_.geometry().voxel_count(); ++v) {
    measured += static_cast<std::size_t>(grid_.is_measured(v));
  }
  EXPECT_EQ(read.free_voxels + expected.size(), measured);
}

TEST_F(OctomapVoxels, OfDamagedFilesAreRefused) {
  write_octomap(grid_, folder_.path() / "map");
  const std::string whole = read_file(folder_.path() / "map.bt");
  for (const std::string& text : {std::string("some words"), whole.substr(0, whole.size() / 2),
                                  whole.substr(0, 40), read_file(folder_.path() / "map.ot")}) {
    write_file_atomically(folder_.path() / "damaged.bt", text);
    EXPECT_THROW(read_octomap(folder_.path() / "damaged.bt"), BadInput);
  }
  EXPECT_THROW(read_octomap(folder_.path() / "none.bt"), BadInput);
  const std::string header = "# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.1\ndata\n";
  const auto write_tree = [&](const std::string& data) {
    write_file_atomically(folder_.path() / "made.bt", header + data);
    return folder_.path() / "made.bt";
  };
  EXPECT_THROW(read_octomap(write_tree({2, 0})), BadInput);  // an eighth of all there can be
  EXPECT_EQ(read_octomap(write_tree({1, 0})).free_voxels, std::size_t{1} << 45U);
  EXPECT_THROW(read_octomap(write_tree({5, 0})), BadInput);  // three nodes
  // eight levels down a cube of two million voxels: some bytes that would take all memory
  std::string cube = "# Octomap OcTree binary file\nid OcTree\nsize 10\nres 0.1\ndata\n";
  for (int level = 0; level < 8; ++level) cube += std::string({3, 0});
  write_file_atomically(folder_.path() / "cube.bt", cube + std::string({2, 0}));
  EXPECT_THROW(read_octomap(folder_.path() / "cube.bt"), BadInput);
}

TEST_F(OctomapVoxels, OfAMapThatNothingTouchedAreNone) {
  write_octomap(OccupancyGrid(OccupancyConfig{}, Box3(Vec3(0, 0, 0), Vec3(1, 1, 1))),
                folder_.path() / "empty");
  EXPECT_TRUE(read_octomap(folder_.path() / "empty.bt").occupied_world_m.empty());
}

// The numbers of images and cameras in a COLMAP model are those that COLMAP's own programs give.

/// Two views of each camera, in the order given; cameras differ in their width.
FrameRecord frames_of(const std::vector<std::string>& names, const TempFolder& temp) {
  FrameRecord frames;
  const std::filesystem::path picture = temp.path() / "picture.png";
  write_file_atomically(picture, "of no interest");
  for (const std::string& name : names) {
    const int width_px = 100 + static_cast<int>(frames.cameras.size());
    frames.cameras.push_back({.name = name,
                              .width_px = width_px,
                              .height_px = 48,
                              .fx_px = 32.0,
                              .fy_px = 32.0,
                              .cx_px = 32.0,
                              .cy_px = 24.0});
  }
  for (int view = 0; view < 2; ++view) {
    for (std::size_t camera = 0; camera < names.size(); ++camera) {
      frames.frames.push_back(
          {.iteration = view, .camera = camera, .colour = picture, .depth = picture});
    }
  }
  return frames;
}

/// COLMAP sorts the names of all images as bytes, numbers them from 1, and numbers folders (with
/// --ImageReader.single_camera_per_folder) as it meets them.
TEST(ColmapNumbers, AreThoseOfTheSortedImageNames) {
  for (const std::vector<std::string>& names : {std::vector<std::string>{"rgbd", "rgbd-down"},
                                                {"rgbd.a", "rgbd", "rgbd0", "rgbd_1"},
                                                {"up", "down"},
                                                {"B", "a", "a.b", "a-b-c", "a-b"}}) {
    TempFolder temp;
    const FrameRecord frames = frames_of(names, temp);
    SparseModel model;
    model.observations.resize(frames.frames.size());
    write_colmap(frames, model, temp.path() / "model");
    std::map<std::string, std::string> width_of_id;
    for (const std::string& line : lines_of(temp.path() / "model/sparse/0/cameras.txt")) {
      const auto cells = cells_of(line, ' ');
      width_of_id[cells[0]] = cells[2];
    }
    std::set<std::string> sorted;
    for (const std::string& name : names) {
      for (int view = 0; view < 2; ++view) sorted.insert(fmt::format("{}/{:06}.png", name, view));
    }
    std::map<std::string, std::size_t> id_of_folder;
    const auto lines = lines_of(temp.path() / "model/sparse/0/images.txt");
    std::size_t line = 0;
    for (const std::string& image : sorted) {
      const std::string folder = image.substr(0, image.find('/'));
      const std::size_t id = id_of_folder.emplace(folder, id_of_folder.size() + 1).first->second;
      const auto cells = cells_of(lines.at(line), ' ');
      EXPECT_EQ(cells[0], fmt::format("{}", line / 2 + 1));
      EXPECT_EQ(cells[9], image);
      EXPECT_EQ(cells[8], fmt::format("{}", id)) << image;
      const auto camera = std::find(names.begin(), names.end(), folder) - names.begin();
      EXPECT_EQ(width_of_id[cells[8]], fmt::format("{}", 100 + camera)) << image;
      line += 2;
    }
  }
}

}  // namespace
}  // namespace gnbv
