#include "tools/run/cloud_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

const std::vector<Vec3f> kPoints = {Vec3f(1, 2, 3), Vec3f(-4.5F, 0, 1e-3F), Vec3f(0.1F, 7, -8)};

fs::path written(const TempFolder& temp, const std::string& name, const std::string& content) {
  std::ofstream(temp.path() / name, std::ios::binary) << content;
  return temp.path() / name;
}

template <typename T>
std::string bytes_of(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

TEST(CloudFile, ColoursAndViewsFollowEachPoint) {
  TempFolder temp;
  const std::vector<Rgb8> colours = {{1, 2, 3}, {4, 5, 6}, {250, 251, 252}};
  const std::vector<std::int32_t> views = {-1, 0, 70'000};
  const fs::path path = temp.path() / "a.ply";
  write_cloud_ply({}, path);
  EXPECT_TRUE(read_cloud(path).empty());
  write_cloud_ply(kPoints, path, {.colours = colours, .views = views});
  EXPECT_EQ(read_cloud(path), kPoints);
  std::string records;
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    for (const float x : kPoints[i]) records += bytes_of(x);
    records += bytes_of(colours[i]) + bytes_of(views[i]);
  }
  const std::string content = read_file(path);
  EXPECT_TRUE(content.ends_with(
      "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property int view\nend_header\n" +
      records));
  EXPECT_THROW(write_cloud_ply(kPoints, path, {.colours = std::span(colours).first(2)}),
               BrokenInvariant);
}

TEST(CloudFile, EveryLayoutGivesTheSamePoints) {
  TempFolder temp;
  std::string labelled;
  for (const Vec3f& p : kPoints) {
    labelled += bytes_of(std::uint8_t{9});
    for (const float x : p) labelled += bytes_of(static_cast<double>(x));
    labelled += bytes_of(std::int16_t{7});
  }
  const fs::path between =
      written(temp, "b.ply",
              "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar red\n"
              "property double x\nproperty double y\nproperty double z\nproperty short label\n"
              "element face 0\nproperty list uchar int vertex_indices\nend_header\n" +
                  labelled);
  EXPECT_EQ(read_cloud(between), kPoints);
  std::vector<std::string> warnings;  // more than the header says
  EXPECT_EQ(read_cloud(written(temp, "more.ply", read_file(between) + labelled), {}, &warnings),
            kPoints);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("bytes after all that its header announces"), std::string::npos);
  EXPECT_EQ(read_cloud(
                written(temp, "m.xyz",
                        "\xEF\xBB\xBF# x y z\r\r" + std::string("1 2 3\r-4.5 0 1e-3\r0.1 7 -8\r"))),
            kPoints);
  EXPECT_EQ(read_cloud(written(temp, "e.xyz", "+1,2,3,255,0,0\r\n-4.5;0;1e-3\n0.1\t7 -8")),
            kPoints);
}

TEST(CloudFile, AMeshGivesItsVerticesWhateverItsFacesAre) {
  TempFolder temp;
  TriangleMesh mesh;
  mesh.vertices_m = kPoints;
  mesh.faces = {{0, 1, 2}, {2, 1, 0}};
  write_mesh(mesh, temp.path() / "mesh.ply");
  EXPECT_EQ(read_cloud(temp.path() / "mesh.ply"), kPoints);
  EXPECT_EQ(load_mesh({.path = temp.path() / "mesh.ply"}).vertices_m, kPoints);
  const std::string whole = read_file(temp.path() / "mesh.ply");
  const fs::path cut = written(temp, "cut.ply", whole.substr(0, whole.size() - 1));
  EXPECT_EQ(read_cloud(cut), kPoints);
  EXPECT_THROW(load_mesh({.path = cut}), BadInput);
}

TEST(CloudFile, WhatIsNotANumberStaysForTheJudge) {
  TempFolder temp;
  const std::vector<Vec3f> points =
      read_cloud(written(temp, "a.xyz", "1 nan 3\n1 2 inf\n1 2 1e999\n1 2 1e-999\n"));
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[3].z(), 0.0F);
  EXPECT_TRUE(std::isnan(points[0].y()));
  EXPECT_TRUE(std::isinf(points[1].z()));
  EXPECT_TRUE(std::isinf(points[2].z()));
}

TEST(CloudFile, WhatIsNoCloudIsNamedWithItsLine) {
  TempFolder temp;
  write_cloud_ply(kPoints, temp.path() / "whole.ply");
  std::ifstream in(temp.path() / "whole.ply", std::ios::binary);
  std::string whole{std::istreambuf_iterator<char>(in), {}};
  const auto complaint_of = [](const fs::path& file) {
    return test::fault_of([&] { read_cloud(file); });
  };
  const std::string cut = complaint_of(written(temp, "cut.ply", whole.substr(0, whole.size() - 1)));
  EXPECT_NE(cut.find("cut.ply: ends before"), std::string::npos) << cut;
  const std::string prose = complaint_of(written(temp, "prose.ply", "Lorem ipsum\n"));
  EXPECT_NE(prose.find("prose.ply: is no PLY"), std::string::npos) << prose;
  EXPECT_NE(complaint_of(written(temp, "c.xyz", "1.5 2 3\r1 2\r")).find("c.xyz:2: "),
            std::string::npos);
  EXPECT_NE(complaint_of(written(temp, "a.stl", "")).find(".ply, .pcd, .las"), std::string::npos);
  EXPECT_NE(complaint_of(temp.path() / "absent.ply").find("absent.ply"), std::string::npos);
}

}  // namespace
}  // namespace gnbv
