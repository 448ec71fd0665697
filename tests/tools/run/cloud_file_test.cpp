// Clouds that we write, and that other programs do: PCL writes the PCD files, so that it says what
// stands in them.
#include "tools/run/cloud_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <random>

#include "sim/core/file.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using test::says;

const std::vector<Vec3f> kPoints = {Vec3f(1, 2, 3), Vec3f(-4.5F, 0, 1e-3F), Vec3f(0.1F, 7, -8)};

class CloudFile : public testing::Test {
 protected:
  std::vector<Vec3f> points_of(const std::string& name, const std::string& content) {
    warnings_.clear();
    return read_cloud(temp_.write(name, content), Vec3::Zero(), &warnings_);
  }
  std::string complaint_of(const std::string& name, const std::string& content) {
    const std::string fault = test::fault_of([&] { points_of(name, content); });
    return fault.substr(std::min(fault.size(), temp_.path().string().size() + 1));
  }

  TempFolder temp_;
  std::vector<std::string> warnings_;
};

TEST_F(CloudFile, ReadsBackWhatItWrote) {
  write_cloud_ply(kPoints, temp_.path() / "a.ply");
  EXPECT_EQ(read_cloud(temp_.path() / "a.ply"), kPoints);
  write_cloud_ply({}, temp_.path() / "empty.ply");
  EXPECT_TRUE(read_cloud(temp_.path() / "empty.ply").empty());
}

TEST_F(CloudFile, ColoursAndViewsFollowEachPoint) {
  const std::vector<Rgb8> colours = {{1, 2, 3}, {4, 5, 6}, {250, 251, 252}};
  const std::vector<std::int32_t> views = {-1, 0, 70'000};
  const fs::path path = temp_.path() / "a.ply";
  write_cloud_ply(kPoints, path, {.colours = colours, .views = views});
  EXPECT_EQ(read_cloud(path), kPoints);
  std::string records;
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    for (const float x : kPoints[i]) append_bytes(records, x);
    for (const std::uint8_t level : colours[i]) append_bytes(records, level);
    append_bytes(records, views[i]);
  }
  const std::string content = read_file(path);
  EXPECT_TRUE(content.ends_with(
      "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property int view\nend_header\n" +
      records));
  EXPECT_THROW(write_cloud_ply(kPoints, path, {.colours = std::span(colours).first(2)}),
               BrokenInvariant);
}

TEST_F(CloudFile, EveryLayoutGivesTheSamePoints) {
  std::string text, labelled;
  for (const Vec3f& p : kPoints) {
    text += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
    append_bytes(labelled, std::uint8_t{9});
    for (const float x : p) append_bytes(labelled, static_cast<double>(x));
    append_bytes(labelled, std::int16_t{7});
  }
  const fs::path between =
      temp_.write("b.ply",
                  "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar red\n"
                  "property double x\nproperty double y\nproperty double z\nproperty short label\n"
                  "element face 0\nproperty list uchar int vertex_indices\nend_header\n" +
                      labelled);
  EXPECT_EQ(read_cloud(between), kPoints);
  EXPECT_EQ(points_of("more.ply", read_file(between) + labelled), kPoints);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_TRUE(says(warnings_[0], {"bytes after all that its header announces"}));
  EXPECT_EQ(points_of("d.xyz", "# x y z\n\n" + text), kPoints);
  EXPECT_EQ(points_of("m.xyz", "\xEF\xBB\xBF# x y z\r\r1 2 3\r-4.5 0 1e-3\r0.1 7 -8\r"), kPoints);
  EXPECT_EQ(points_of("e.xyz", "+1,2,3,255,0,0\r\n-4.5;0;1e-3\n0.1\t7 -8"), kPoints);
}

TEST_F(CloudFile, AMeshGivesItsVerticesWhateverItsFacesAre) {
  TriangleMesh mesh;
  mesh.vertices_m = kPoints;
  mesh.faces = {{0, 1, 2}, {2, 1, 0}};
  write_mesh(mesh, temp_.path() / "mesh.ply");
  EXPECT_EQ(read_cloud(temp_.path() / "mesh.ply"), kPoints);
  EXPECT_EQ(load_mesh({.path = temp_.path() / "mesh.ply"}).vertices_m, kPoints);
  const std::string whole = read_file(temp_.path() / "mesh.ply");
  const fs::path cut = temp_.write("cut.ply", whole.substr(0, whole.size() - 1));
  EXPECT_EQ(read_cloud(cut), kPoints);
  EXPECT_THROW(load_mesh({.path = cut}), BadInput);
  std::string fewer = whole;
  fewer.replace(fewer.find("element vertex 3"), 16, "element vertex 2");
  EXPECT_EQ(points_of("fewer.ply", fewer).size(), 2U);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_TRUE(says(warnings_[0], {"fewer.ply", "points may be missing"}));
  EXPECT_EQ(points_of("mesh.ply", whole), kPoints);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(CloudFile, WhatIsNotANumberStaysForTheJudge) {
  const std::vector<Vec3f> points =
      read_cloud(temp_.write("a.xyz", "1 nan 3\n1 2 inf\n1 2 1e999\n1 2 1e-999\n"));
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[3].z(), 0.0F);
  EXPECT_TRUE(std::isnan(points[0].y()));
  EXPECT_TRUE(std::isinf(points[1].z()));
  EXPECT_TRUE(std::isinf(points[2].z()));
}

TEST_F(CloudFile, WhatIsNoCloudIsNamedWithItsLine) {
  write_cloud_ply(kPoints, temp_.path() / "whole.ply");
  const std::string whole = read_file(temp_.path() / "whole.ply");
  for (const auto& [name, content, why] : std::vector<std::array<std::string, 3>>{
           {"cut.ply", whole.substr(0, whole.size() - 1), "cut.ply: ends before"},
           {"prose.ply", "Lorem ipsum\n", "prose.ply: is no PLY"},
           {"c.xyz", "1.5 2 3\r0,5 1,25 3,5\r", "c.xyz:2: "},  // decimal commas
           {"line.xyz", "1 2 3\n1 2\n", "line.xyz:2"},
           {"a.stl", "", ".ply, .pcd, .las"}}) {
    EXPECT_TRUE(says(complaint_of(name, content), {why}));
  }
  EXPECT_TRUE(
      says(test::fault_of([&] { read_cloud(temp_.path() / "absent.ply"); }), {"absent.ply"}));
}

TEST_F(CloudFile, PclsFilesHoldPclsPoints) {
  std::mt19937 random(5);  // NOLINT
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud(40, 25);
  std::vector<Vec3f> finite;
  for (auto& point : cloud) {
    for (float& x : point.data) x = static_cast<float>(random()) * 1e-8F;
    point.x = random() % 10 == 0 ? NAN : point.x;
    point.y = std::round(point.y);  // so that there is something to compress
    if (!std::isnan(point.x)) finite.push_back(point.getVector3fMap());
  }
  const std::string path = (temp_.path() / "cloud.pcd").string();
  for (int kind = 0; kind < 3; ++kind) {
    pcl::PCDWriter writer;
    if (kind == 0) writer.writeASCII(path, cloud, 9);
    if (kind == 1) writer.writeBinary(path, cloud);
    if (kind == 2) writer.writeBinaryCompressed(path, cloud);
    const std::string whole = read_file(path);
    EXPECT_EQ(points_of("same.pcd", whole), finite) << kind;
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_TRUE(
        says(warnings_[0], {fmt::format("{} points that are not finite", 1000 - finite.size())}));
    for (std::size_t size = 0; size + 1 < whole.size(); size += 1 + size / 3) {
      EXPECT_NE(complaint_of("cut.pcd", whole.substr(0, size)), "") << kind << " " << size;
    }
    std::string damaged = whole;  // never a crash, whatever comes of it
    for (int i = 0; i < 300; ++i) {
      damaged[random() % damaged.size()] = static_cast<char>(random());
      complaint_of("damaged.pcd", damaged);
    }
  }
}

TEST_F(CloudFile, PcdSaysWhatItHolds) {
  const std::string head =
      "# .PCD v.7\nVERSION .7\nFIELDS label z y x\nSIZE 2 8 4 4\n"
      "TYPE U F I F\nCOUNT 3 1 1 1\nWIDTH 2\nHEIGHT 1\n";
  EXPECT_EQ(points_of("a.pcd", head + "DATA ascii\n1 2 3 9.5 -8 7\n1 2 3 0 0 -0.5\n"),
            (std::vector{Vec3f(7, -8, 9.5F), Vec3f(-0.5F, 0, 0)}));
  std::string old_mac = "\xEF\xBB\xBF" + head + "DATA ascii\n1 2 3 9.5 -8 7\n1 2 3 0 0 -0.5\n";
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  EXPECT_EQ(points_of("a.pcd", old_mac), (std::vector{Vec3f(7, -8, 9.5F), Vec3f(-0.5F, 0, 0)}));
  EXPECT_EQ(complaint_of("a.pcd", head + "DATA ascii\n1 2 3 9.5 -8 7\n1 2 0 0 0\n"),
            "a.pcd:11: 5 words, its header says 6");
  EXPECT_EQ(complaint_of("a.pcd", head + "POINTS 3\nDATA ascii\n"),
            "a.pcd: its POINTS 3 are not WIDTH 2 times HEIGHT 1");
  EXPECT_EQ(complaint_of("a.pcd", head + "DATA ascii\n1 2 3 9.5 -8 7\n"),
            "a.pcd: ends after 1 of the 2 points that its header announces");
  points_of("a.pcd",
            head + "VIEWPOINT 1 0 0 1 0 0 0\nDATA ascii\n1 2 3 9.5 -8 7\n1 2 3 0 0 0\n9\n");
  ASSERT_EQ(warnings_.size(), 2U);
  EXPECT_TRUE(says(warnings_[0], {"VIEWPOINT 1 0 0 1 0 0 0 is not applied"}));
  EXPECT_TRUE(says(warnings_[1], {"1 rows after the last point left out"}));
  const std::string huge = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2000000000\nDATA binary";
  EXPECT_TRUE(says(complaint_of("h.pcd", huge + "\nabc"), {"ends after 0 of the"}));
  EXPECT_NE(complaint_of("h.pcd", huge + "_compressed\nabcdefghi"), "");
}

TEST_F(CloudFile, TextsOfManyPrograms) {
  const std::string rows = "1 2 3\n-4.5 0 1e-3\n0.1 7 -8\n";
  for (const char* name : {"a.xyz", "a.txt", "a.asc", "a.pts", "a.csv"}) {
    EXPECT_EQ(points_of(name, "// X Y Z\n% made by hand\n" + rows), kPoints) << name;
  }
  EXPECT_EQ(points_of("a.pts", "1\r\n1 2 3 -1024 9 9 9\r\n2\n-4.5 0 1e-3 7\n0.1 7 -8 7\n"),
            kPoints);
  EXPECT_EQ(points_of("a.csv", "\"id\",\"Y\", X,Z\n1,2,1,3\n2,0,-4.5,1e-3\n3,7,0.1,-8\n"), kPoints);
  EXPECT_EQ(points_of("a.csv", "the note\tx\ty\tz\n1,5 m\t1\t2\t3\n\t-4.5\t0\t1e-3\n\t0.1\t7\t-8"),
            kPoints);
  EXPECT_EQ(points_of("a.csv", "1, 2,3\n-4.5 ,0 ,1e-3 7,5\n0.1 7.0,-8 9"), kPoints);
}

TEST_F(CloudFile, TextsThatMissSomethingAreNamedWithTheirLine) {
  EXPECT_EQ(complaint_of("a.csv", "id,Y,X,Z\n1,2,1,3\n3,,0.1,-8\n"),
            "a.csv:3: '3,,0.1,-8' has no number under x, y or z");
  const std::string commas = "' has decimal commas: write decimal points";
  for (const char* row : {"2,912;1,5;3,1", "2,5\t1,5\t3,1", "1,5 2,5 3", "1 2,5 3"}) {
    EXPECT_EQ(complaint_of("a.csv", row), fmt::format("a.csv:1: '{}{}", row, commas));
  }
  EXPECT_EQ(complaint_of("a.csv", "x;y;z\n2,912;1;3\n"), "a.csv:2: '2,912;1;3" + commas);
  EXPECT_EQ(complaint_of("a.csv", "x,y,z\n2,9,1,0,3,0\n"),
            "a.csv:2: '2,9,1,0,3,0' has 6 fields under 3 names");
  EXPECT_EQ(complaint_of("a.xyz", "1,,2,3\n"),
            "a.xyz:1: '1,,2,3' does not begin with three numbers");
  EXPECT_EQ(complaint_of("a.txt", "east north up\n1 2 3\n"),
            "a.txt:1: 'east north up' does not begin with three numbers");
  EXPECT_EQ(complaint_of("a.csv", "X [m],Y [m],Z [m]\n1,2,3\n"),
            "a.csv:1: 'X [m],Y [m],Z [m]' does not begin with three numbers");
  EXPECT_EQ(complaint_of("a.pts", "3\n1 2 3\n4 5 6\n"),
            "a.pts: holds 2 of the 3 points that it announces");
  EXPECT_EQ(complaint_of("a.pts", "1\n1 2 3\n4 5 6\n"),
            "a.pts:3: '4 5 6' follows the 1 points that the file announces");
  EXPECT_TRUE(says(complaint_of("a.e57", "x"), {"CloudCompare"}));
  EXPECT_EQ(complaint_of("a.xyz", std::string("1 2\0\n", 5)),
            "a.xyz:1: '1 2\\x00' does not begin with three numbers");
}

/// A LAS file of one version, point format 0, whose scale is a millimetre.
std::string las_of(std::uint8_t minor, const std::vector<std::array<std::int32_t, 3>>& points) {
  std::string las(minor >= 4 ? 375 : 227, '\0');
  const auto put = [&](std::size_t at, auto value) {
    std::string bytes;
    append_bytes(bytes, value);
    las.replace(at, bytes.size(), bytes);
  };
  las.replace(0, 4, "LASF");
  put(24, std::uint8_t{1});
  put(25, minor);
  put(96, static_cast<std::uint32_t>(las.size()));
  put(105, std::uint16_t{20});
  if (minor < 4) put(107, static_cast<std::uint32_t>(points.size()));
  if (minor >= 4) put(247, std::uint64_t{points.size()});
  for (std::size_t axis = 0; axis < 3; ++axis) put(131 + 8 * axis, 0.001);
  put(155, 500'000.0);
  put(163, 5'000'000.0);
  for (const auto& point : points) {
    for (const std::int32_t x : point) append_bytes(las, x);
    las += std::string(8, '\7');
  }
  return las;
}

TEST_F(CloudFile, LasKeepsItsMillimetresBesideTheOffsetOfAMapGrid) {
  for (const std::uint8_t minor : {std::uint8_t{2}, std::uint8_t{4}}) {
    const std::string whole = las_of(minor, {{1, -2, 3}, {40'001, 2'000'000, -1}});
    const auto points = read_cloud(temp_.write("a.las", whole), Vec3(-500'000, -5'000'000, 0));
    ASSERT_EQ(points.size(), 2U);
    EXPECT_LT((points[0] - Vec3f(0.001F, -0.002F, 0.003F)).norm(), 1e-6F);
    EXPECT_LT((points[1] - Vec3f(40.001F, 2000.0F, -0.001F)).norm(), 1e-4F);
    points_of("a.las", whole + whole);
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_TRUE(says(warnings_[0], {"points after those that its header"}));
    EXPECT_EQ(complaint_of("a.las", whole.substr(0, whole.size() - 1)),
              "a.las: ends after 1 of the 2 points that its header announces");
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_NE(complaint_of("a.las", whole.substr(0, size)), "") << size;
    }
  }
  std::string old_count = las_of(4, {{1, -2, 3}});
  std::swap(old_count[107], old_count[247]);
  EXPECT_EQ(points_of("a.las", old_count).size(), 1U);
  std::string packed = las_of(2, {});
  packed[104] = '\x81';
  EXPECT_TRUE(says(complaint_of("a.laz", packed), {"write('a.las')"}));
}

TEST_F(CloudFile, EveryTextKeepsMillimetresBesideTheOffsetOfAMapGrid) {
  const std::string row = "500001.234 5000002.345 3.456\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\n"
      "property double y\nproperty double z\nend_header\n" +
      row;
  const std::string pcd = "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nWIDTH 1\nDATA ascii\n" + row;
  for (const auto& [name, content] : {std::pair("a.xyz", row), {"a.ply", ply}, {"a.pcd", pcd}}) {
    const auto points = read_cloud(temp_.write(name, content), Vec3(-500'000, -5'000'000, 0));
    ASSERT_EQ(points.size(), 1U);
    EXPECT_LT((points[0] - Vec3f(1.234F, 2.345F, 3.456F)).norm(), 1e-6F) << name;
  }
}

}  // namespace
}  // namespace gnbv
