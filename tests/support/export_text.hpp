// The texts that `gnbv export` writes, read by parsers of their own.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/file.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

using Numbers = std::vector<double>;

inline std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::istringstream text(read_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with('#')) lines.push_back(line);
  }
  return lines;
}

inline std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::istringstream text(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(text, cell, separator);) cells.push_back(cell);
  return cells;
}

/// x y z qx qy qz qw from a cell on.
inline Isometry pose_of(const std::vector<std::string>& cells, std::size_t first) {
  Numbers n;
  for (std::size_t i = first; i < first + 7; ++i) n.push_back(std::stod(cells[i]));
  Isometry T = Isometry::Identity();
  T.translate(Vec3(n[0], n[1], n[2]));
  T.rotate(Eigen::Quaterniond(n[6], n[3], n[4], n[5]));
  return T;
}

struct ColmapImage {  // of images.txt
  std::string name;
  Isometry T_camera_world = Isometry::Identity();
  std::vector<Vec3> points2d = {};  // x, y, number of the point
};

struct ColmapPoint {  // of points3D.txt
  Vec3 p_world_m = Vec3::Zero();
  std::array<int, 3> rgb{};
  std::vector<std::pair<int, int>> track = {};  // image, index into its points2d
};

/// fx fy cx cy
inline Numbers colmap_intrinsics(const std::filesystem::path& model) {
  Numbers n;
  const auto cells = cells_of(lines_of(model / "cameras.txt").front(), ' ');
  EXPECT_EQ(cells[1], "PINHOLE");
  for (std::size_t i = 4; i < 8; ++i) n.push_back(std::stod(cells[i]));
  return n;
}

inline std::vector<ColmapImage> colmap_images(const std::filesystem::path& model) {
  std::vector<ColmapImage> images;
  const auto lines = lines_of(model / "images.txt");
  for (std::size_t i = 0; i + 1 < lines.size(); i += 2) {
    const auto c = cells_of(lines[i], ' ');
    EXPECT_EQ(std::stoul(c[0]), images.size() + 1);  // by name, from 1
    ColmapImage image{.name = c[9]};
    image.T_camera_world.translate(Vec3(std::stod(c[5]), std::stod(c[6]), std::stod(c[7])));
    image.T_camera_world.rotate(
        Eigen::Quaterniond(std::stod(c[1]), std::stod(c[2]), std::stod(c[3]), std::stod(c[4])));
    const auto p = cells_of(lines[i + 1], ' ');
    for (std::size_t j = 0; j + 2 < p.size(); j += 3) {
      image.points2d.emplace_back(std::stod(p[j]), std::stod(p[j + 1]), std::stod(p[j + 2]));
    }
    images.push_back(image);
  }
  return images;
}

inline std::map<int, ColmapPoint> colmap_points(const std::filesystem::path& model) {
  std::map<int, ColmapPoint> points;
  for (const std::string& line : lines_of(model / "points3D.txt")) {
    const auto c = cells_of(line, ' ');
    ColmapPoint& point = points[std::stoi(c[0])];
    point.p_world_m = Vec3(std::stod(c[1]), std::stod(c[2]), std::stod(c[3]));
    for (std::size_t i = 0; i < 3; ++i) point.rgb[i] = std::stoi(c[4 + i]);
    for (std::size_t i = 8; i + 1 < c.size(); i += 2) {
      point.track.emplace_back(std::stoi(c[i]), std::stoi(c[i + 1]));
    }
  }
  return points;
}

}  // namespace gnbv
