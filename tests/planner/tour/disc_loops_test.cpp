#include "planner/tour/disc_loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/core/pose.hpp"
#include "sim/core/rng.hpp"
#include "tests/support/at_simd_level.hpp"

namespace gnbv {
namespace {

constexpr int kWidth_px = 37;
constexpr int kHeight_px = 23;
constexpr float kFocal_px = 30.0F;
constexpr float kNoDepth = std::numeric_limits<float>::infinity();

std::vector<float> rays(int pixels) {
  std::vector<float> at;
  for (int i = 0; i < pixels; ++i) {
    at.push_back((static_cast<float>(i) + 0.5F - 0.5F * static_cast<float>(pixels)) / kFocal_px);
  }
  at.resize(at.size() + kDiscPadding);
  return at;
}

/// Before the camera or partly beside its image, turned anyhow.
Disc random_disc(Rng& rng) {
  const auto within = [&](double low, double high) {
    return static_cast<float>(low + (high - low) * rng.uniform());
  };
  const Vec3f p(within(-2, 2), within(-1, 1), within(1, 4));
  const Vec3f normal = Vec3f(within(-1, 1), within(-1, 1), within(-1, 1)).normalized();
  const float radius_m = within(0.02, 0.6);
  const auto below = [&](std::uint64_t count) { return static_cast<int>(rng.below(count)); };
  const auto first = [&](float across, int pixels) {  // about its middle
    return static_cast<int>(kFocal_px * across / p.z()) + pixels / 2 - below(10);
  };
  const int u0 = std::clamp(first(p.x(), kWidth_px), 0, kWidth_px - 1);
  const int v0 = std::clamp(first(p.y(), kHeight_px), 0, kHeight_px - 1);
  return {.p_m = {p.x(), p.y(), p.z()},
          .normal = {normal.x(), normal.y(), normal.z()},
          .along_m = normal.dot(p),
          .radius2_m2 = radius_m * radius_m,
          .u0 = u0,
          .u1 = std::min(kWidth_px - 1, u0 + below(20) - 1),
          .v0 = v0,
          .v1 = std::min(kHeight_px - 1, v0 + below(12) - 1)};
}

/// By what is known of the disc: where the ray of a pixel meets its plane.
void draw_one(const Disc& disc, int u, int v, std::vector<float>& depth_m) {
  const Vec3 ray((u + 0.5 - 0.5 * kWidth_px) / kFocal_px, (v + 0.5 - 0.5 * kHeight_px) / kFocal_px,
                 1.0);
  const Vec3 p = Eigen::Map<const Vec3f>(disc.p_m).cast<double>();
  const Vec3 normal = Eigen::Map<const Vec3f>(disc.normal).cast<double>();
  const double z_m = normal.dot(p) / normal.dot(ray);
  float& pixel_m = depth_m[static_cast<std::size_t>(v * kWidth_px + u)];
  if ((z_m * ray - p).squaredNorm() <= static_cast<double>(disc.radius2_m2)) {
    pixel_m = std::min(pixel_m, static_cast<float>(z_m));
  }
}

class DiscLoops : public AtSimdLevel {};

TEST_P(DiscLoops, DrawWhatEachPixelsRayMeets) {
  const std::vector<float> ray_x = rays(kWidth_px);
  const std::vector<float> ray_y = rays(kHeight_px);
  int covered = 0, other = 0;
  for (int round = 0; round < 200; ++round) {
    Rng rng(7, Stream::bench, round);
    std::vector<Disc> discs;
    for (int i = 0; i < 20; ++i) discs.push_back(random_disc(rng));
    std::vector<float> drawn_m(kWidth_px * kHeight_px + kDiscPadding, kNoDepth);
    std::vector<float> expected_m = drawn_m;
    disc_kernels().draw(discs.data(), discs.size(),
                        {ray_x.data(), ray_y.data(), drawn_m.data(), kWidth_px});
    for (const Disc& disc : discs) {
      for (int v = disc.v0; v <= disc.v1; ++v) {
        for (int u = disc.u0; u <= disc.u1; ++u) draw_one(disc, u, v, expected_m);
      }
    }
    for (std::size_t i = 0; i < drawn_m.size(); ++i) {
      covered += std::isfinite(drawn_m[i]) ? 1 : 0;
      const bool is_same = drawn_m[i] == expected_m[i] ||
                           std::fabs(drawn_m[i] - expected_m[i]) < 1e-3F * expected_m[i];
      other += is_same ? 0 : 1;  // a pixel at a disc's edge may round either way
    }
  }
  EXPECT_GT(covered, 5000);
  EXPECT_LT(other, covered / 1000);
}

GNBV_AT_EVERY_SIMD_LEVEL(DiscLoops);

}  // namespace
}  // namespace gnbv
