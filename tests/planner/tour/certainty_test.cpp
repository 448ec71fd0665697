#include "planner/tour/certainty.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "planner/core/belief.hpp"
#include "planner/tour/gains.hpp"
#include "sensors/depth_noise.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr double kDetail_m = 0.05;
constexpr double kNear_m = SurfaceCells::kNear * kDetail_m;
const Box3 kBox(Vec3(-3, -3, 0), Vec3(3, 3, 4));

CameraModel camera_with(DepthNoise noise) { return make_camera_model({.noise = {.model = noise}}); }

TEST(Certainty, IsTheShareOfGaussianErrorsThatAreSmall) {
  const CameraModel camera = camera_with(DepthNoise::stereo);
  for (const double depth_m : {1.0, 3.0, 7.0}) {
    const double sigma_m = depth_sigma_m(camera, depth_m, 0.0);
    int small = 0;
    constexpr int kDraws = 100000;
    for (std::uint64_t i = 0; i < kDraws; ++i) {
      small += std::fabs(sigma_m * standard_normal({1, Stream::depth_noise, 0, i})) <= kNear_m;
    }
    EXPECT_NEAR(certainty(camera, depth_m, kNear_m), static_cast<double>(small) / kDraws, 0.006);
  }
  EXPECT_EQ(certainty(camera_with(DepthNoise::none), 7.0, kNear_m), 1.0);
}

TEST(Certainty, OfAPointIsThatOfTheFirstFrameThatHasIt) {
  const CameraModel camera = camera_with(DepthNoise::stereo);
  const auto at = [](double x_m, double yaw_rad) {
    return FramePose{0, T_world_body({Vec3(x_m, 0, 0), yaw_rad}) * Isometry(R_body_optical())};
  };
  const std::vector<Vec3f> points = {{4, 0, 0}, {-4, 0, 0}, {1000, 0, 0}};
  const std::vector<FramePose> looks = {at(0.0, 0.0), at(2.0, 0.0), at(-2.5, kPi)};
  const std::vector<float> sure = certainties(points, looks, {&camera, 1}, kNear_m);
  EXPECT_FLOAT_EQ(sure[0], static_cast<float>(certainty(camera, 4.0, kNear_m)));
  EXPECT_FLOAT_EQ(sure[1], static_cast<float>(certainty(camera, 1.5, kNear_m)));
  EXPECT_EQ(sure[2], 1.0F) << "no frame has it";
  const CameraModel exact = camera_with(DepthNoise::none);
  EXPECT_TRUE(certainties(points, looks, {&exact, 1}, kNear_m).empty());
}

/// Points of the plane z = 2 as a camera of that noise measures them from above.
struct Noisy {
  std::vector<Vec3f> points;
  std::vector<float> sure;
};
Noisy plane_with(double sigma_m) {
  Noisy made;
  for (double x_m = -1.0; x_m <= 1.0; x_m += 0.02) {
    for (double y_m = -1.0; y_m <= 1.0; y_m += 0.02) {
      const double error = standard_normal({2, Stream::depth_noise, 0, made.points.size()});
      made.points.push_back(Vec3(x_m, y_m, 2.03 + sigma_m * error).cast<float>());
    }
  }
  const auto share =
      static_cast<float>(sigma_m > 0.0 ? std::erf(kNear_m / (std::sqrt(2.0) * sigma_m)) : 1.0);
  made.sure.assign(made.points.size(), share);
  return made;
}

std::size_t voxels_of(const SurfaceCells& cells, std::uint64_t SurfaceCell::*mask) {
  std::size_t sum = 0;
  for (const SurfaceCell& cell : cells.cells()) {
    sum += static_cast<std::size_t>(std::popcount(cell.*mask));
  }
  return sum;
}

TEST(Certainty, NoiseOfAPlaneIsNoSurfaceBesideIt) {
  const OccupancyGrid grid(OccupancyConfig{}, kBox);
  SurfaceCells exact(kBox, kDetail_m), noisy(kBox, kDetail_m), believed(kBox, kDetail_m);
  exact.add(plane_with(0.0).points, grid, 1);
  const auto [points, sure] = plane_with(0.12);
  noisy.add(points, grid, 1, {}, true, sure);
  believed.add(points, grid, 1);
  const auto surface = static_cast<double>(voxels_of(exact, &SurfaceCell::expected));
  EXPECT_NEAR(static_cast<double>(voxels_of(noisy, &SurfaceCell::expected)), surface,
              0.35 * surface);
  EXPECT_GT(static_cast<double>(voxels_of(believed, &SurfaceCell::expected)), 2.0 * surface)
      << "taken for exact, the noise is a slab of surfaces";
}

TEST(Certainty, PointsThatAreSurerSayWhereTheSurfaceIs) {
  const OccupancyGrid grid(OccupancyConfig{}, kBox);
  SurfaceCells cells(kBox, kDetail_m);
  Noisy far = plane_with(0.12);
  for (Vec3f& p_m : far.points) p_m.z() += 0.06F;  // all of them too far
  cells.add(far.points, grid, 1, {}, true, far.sure);
  const Noisy near = plane_with(0.01);
  cells.add(near.points, grid, 1, {}, true, near.sure);
  double sum_m = 0.0;
  int count = 0;
  for (const SurfaceCell& cell : cells.cells()) {
    const bool is_there = cell.key[2] == cells.lattice().key_of(Vec3(0, 0, 2.03))[2];
    if (!cell.has_plane() || cell.is_extrapolated() || !is_there) continue;
    sum_m += cell.on_plane_m.z();
    ++count;
  }
  ASSERT_GT(count, 50);
  EXPECT_NEAR(sum_m / count, 2.03, 0.01);
}

TEST(Certainty, PointsCoverAsOftenAsTheyAreNear) {
  const OccupancyGrid grid(OccupancyConfig{}, kBox);
  Noisy points = plane_with(0.0);
  SurfaceCells all(kBox, kDetail_m), some(kBox, kDetail_m);
  all.add(points.points, grid, 1);
  points.sure.assign(points.points.size(), 0.05F);
  some.add(points.points, grid, 1, {}, true, points.sure);
  // some 6.25 points a voxel, each of which covers it with a probability of 0.05
  const double share = 1.0 - std::pow(0.95, 6.25);
  EXPECT_NEAR(static_cast<double>(voxels_of(some, &SurfaceCell::covered)),
              share * static_cast<double>(voxels_of(all, &SurfaceCell::covered)),
              0.15 * static_cast<double>(voxels_of(all, &SurfaceCell::covered)));
}

}  // namespace
}  // namespace gnbv
