// The numbers of images and cameras in a COLMAP model are those that COLMAP's own programs give.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

#include "sim/core/file.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/exports/formats.hpp"

namespace gnbv {
namespace {

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::istringstream text(read_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with('#')) lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::istringstream text(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(text, cell, separator);) cells.push_back(cell);
  return cells;
}

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

/// COLMAP sorts the names of all images as bytes and numbers them from 1; cameras are numbered as
/// their images come. Readers of splats look for the last part of a name in images/.
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
      for (int view = 0; view < 2; ++view) sorted.insert(fmt::format("{}_{:06}.png", name, view));
    }
    std::map<std::string, std::size_t> id_of_folder;
    const auto lines = lines_of(temp.path() / "model/sparse/0/images.txt");
    std::size_t line = 0;
    for (const std::string& image : sorted) {
      const std::string folder = image.substr(0, image.rfind('_'));
      const std::size_t id = id_of_folder.emplace(folder, id_of_folder.size() + 1).first->second;
      const auto cells = cells_of(lines.at(line), ' ');
      EXPECT_EQ(cells[0], fmt::format("{}", line / 2 + 1));
      EXPECT_EQ(cells[9], image);
      EXPECT_EQ(cells[8], fmt::format("{}", id)) << image;
      const auto camera = std::find(names.begin(), names.end(), folder) - names.begin();
      EXPECT_TRUE(std::filesystem::exists(temp.path() / "model/images" / image)) << image;
      EXPECT_EQ(width_of_id[cells[8]], fmt::format("{}", 100 + camera)) << image;
      line += 2;
    }
  }
}

}  // namespace
}  // namespace gnbv
