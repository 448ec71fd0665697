// A mesh from a cloud that nobody knows the sensors of: where the points lie, outwards out, and
// with the error that it has.
#include "tools/surface/cloud_surface.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "sim/mesh/mesh_file.hpp"
#include "tests/sim/mesh/mesh_files.hpp"
#include "tools/run/cloud_file.hpp"

namespace gnbv {
namespace {

constexpr double kSide_m = 2.0;

/// On the faces of a cube that stands on the origin's plane, in no order.
std::vector<Vec3f> cube_points(int count, double noise_m) {
  std::mt19937 random(3);  // NOLINT
  std::uniform_real_distribution<double> share(-0.5, 0.5);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<Vec3f> points;
  for (int i = 0; i < count; ++i) {
    Vec3 p_m(share(random), share(random), share(random));
    p_m[i % 3] = i / 3 % 2 == 0 ? -0.5 : 0.5;
    p_m *= kSide_m;
    p_m[i % 3] += noise_m * noise(random);
    points.push_back((p_m + Vec3(0, 0, 0.5 * kSide_m)).cast<float>());
  }
  return points;
}

class CloudSurfaces : public testing::Test {
 protected:
  CloudSurface made_of(const std::vector<Vec3f>& points) {
    write_cloud_ply(points, temp_.path() / "cloud.ply");
    return surface_of_cloud(
        temp_.path() / "cloud.ply", Vec3::Zero(), {}, folder_, 2, [](double, const std::string&) {},
        notes_);
  }
  TempFolder temp_;
  std::filesystem::path folder_ = temp_.path() / "made";
  std::vector<std::string> notes_;
};

TEST_F(CloudSurfaces, ACubeStaysACubeAndTheErrorIsThatOfItsPoints) {
  for (const double noise_m : {0.0, 0.01}) {
    const CloudSurface made = made_of(cube_points(30'000, noise_m));
    const TriangleMesh mesh = load_mesh({.path = (folder_ / "surface.ply").string()});
    EXPECT_NEAR(test::volume_m3(mesh), kSide_m * kSide_m * kSide_m, 0.15);
    EXPECT_NEAR(surface_area_m2(mesh), 6.0 * kSide_m * kSide_m, 1.2);
    const auto json = nlohmann::json::parse(made.json);
    EXPECT_EQ(json["points"], 30'000);
    const double mean_m = json["error_m"]["mean"], p95_m = json["error_m"]["p95"];
    EXPECT_LT(mean_m, 0.006 + noise_m);
    EXPECT_GT(mean_m, 0.5 * noise_m);  // E|x| of noise: 0.8 sigma
    EXPECT_GT(p95_m, mean_m);
    EXPECT_GE(json["error_m"]["max"], json["error_m"]["p95"]);
    EXPECT_TRUE(test::says(made.text, {"mean", "95 %", "largest", "--mesh"}));
  }
}

TEST_F(CloudSurfaces, PointsThatNoSurfaceIsNearCountInTheError) {
  std::vector<Vec3f> points = cube_points(30'000, 0.0);
  points.emplace_back(0.0F, 0.0F, 12.0F);
  const auto json = nlohmann::json::parse(made_of(points).json);
  EXPECT_NEAR(json["error_m"]["max"], 10.0, 0.1);
  EXPECT_LT(json["error_m"]["p95"], 0.03);
}

TEST_F(CloudSurfaces, WhatHoldsNoSurfaceIsRefused) {
  EXPECT_TRUE(test::says(test::fault_of([&] {
                           made_of({Vec3f(1, 2, 3), Vec3f(4, 5, 6)});
                         }),
                         {"cloud.ply", "2 points lie on no surface"}));
  EXPECT_TRUE(test::says(test::fault_of([&] { made_of(std::vector(50, Vec3f(1, 2, NAN))); }),
                         {"not finite"}));
  EXPECT_FALSE(std::filesystem::exists(folder_));
}

}  // namespace
}  // namespace gnbv
