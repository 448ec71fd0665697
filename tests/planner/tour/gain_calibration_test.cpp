#include <gtest/gtest.h>

#include "planner/tour/gains.hpp"
#include "tests/planner/map/drawn_map.hpp"

namespace gnbv {
namespace {

// like those that Thin lacks
const Patch kPatch{.missing = 1.0F, .source = PatchSource::sampled};
const Box3 kBox(Vec3(-2, -2, 0), Vec3(2, 2, 2));

/// Points on the plane z = 1.03, `step_m` apart, with |x|, |y| < half.
std::vector<Vec3f> plane(double half_m, double step_m) {
  std::vector<Vec3f> points;
  for (double x = -half_m; x < half_m; x += step_m) {
    for (double y = -half_m; y < half_m; y += step_m) {
      points.push_back(Vec3(x, y, 1.03).cast<float>());
    }
  }
  return points;
}

struct Thin {
  Thin() { cells.add(plane(0.9, 0.15), grid, 1); }
  std::vector<Patch> patches() const { return find_patches(cells, grid, 1); }
  /// All that lack something, seen from above face on.
  std::vector<SeenPatch> seen() const {
    std::vector<SeenPatch> all;
    const auto now = patches();
    for (PatchId id = 0; id < now.size(); ++id) {
      if (now[id].missing > 0.0F && now[id].normal.z() > 0.9F) all.push_back({id, 0});
    }
    return all;
  }
  OccupancyGrid grid = free_grid(kBox);
  SurfaceCells cells{kBox, 0.05};
};

double missing(const Thin& thin, const std::vector<SeenPatch>& seen) {
  double sum = 0.0;
  const auto patches = thin.patches();
  for (const SeenPatch& one : seen) sum += static_cast<double>(patches[one.patch].missing);
  return sum;
}

TEST(GainCalibration, FindsAllThatADenseScanBringsAndNothingThatNoneDoes) {
  for (const bool is_scanned : {true, false}) {
    Thin thin;
    const auto seen = thin.seen();
    const double lacking = missing(thin, seen);
    ASSERT_GT(lacking, 300.0);
    GainCalibration calibration(0.05);
    const float before = calibration.yield().share(kPatch, {});
    EXPECT_NEAR(calibration.expected(seen, thin.patches()), static_cast<double>(before) * lacking,
                0.2 * lacking);
    calibration.note(seen, thin.patches(), thin.cells);
    if (is_scanned) thin.cells.add(plane(1.2, 0.01), thin.grid, 1);
    EXPECT_NEAR(calibration.settle(thin.cells).found, is_scanned ? lacking : 0.0, 0.1 * lacking);
    const float after = calibration.yield().share(kPatch, {});
    if (is_scanned) {
      EXPECT_GE(after, before - 0.02F);
    } else {
      EXPECT_LT(after, 0.7F * before);
    }
    for (const SeenPatch& one : seen) {
      EXPECT_EQ(thin.cells.cells()[cell_of(one.patch)].observations[side_of(one.patch)], 1);
    }
    calibration.settle(thin.cells);
    EXPECT_TRUE(calibration.outcomes().empty()) << "nothing was predicted";
  }
}

TEST(GainCalibration, ReliabilityFallsWherePredictionsFailAndComesBackThere) {
  Thin thin;
  GainCalibration calibration(0.05);
  const auto cube_m = static_cast<float>(0.05 * GainCalibration::kReliabilityCube);
  const auto reliability_at = [&](const Vec3f& p_m) {
    std::vector<Patch> patches = {{.target_m = p_m, .missing = 1.0F}};
    calibration.set_reliability(patches);
    return patches.front().reliability;
  };
  const Vec3f here(0.5F * cube_m, 0.5F * cube_m, 1.03F);
  EXPECT_EQ(reliability_at(here), 1.0F);
  for (int view = 0; view < 4; ++view) {
    calibration.note(thin.seen(), thin.patches(), thin.cells);
    calibration.settle(thin.cells);  // nothing came
  }
  const float before = reliability_at(here);
  EXPECT_LT(before, 0.5F);
  EXPECT_EQ(reliability_at(here + 3.0F * cube_m * Vec3f::UnitX()), 1.0F) << "nobody looked there";
  std::vector<Patch> patches = thin.patches();
  calibration.set_reliability(patches);
  calibration.note(thin.seen(), patches, thin.cells);
  thin.cells.add(plane(1.2, 0.01), thin.grid, 1);
  calibration.settle(thin.cells);
  EXPECT_GT(reliability_at(here), before);
  EXPECT_LE(reliability_at(here), 1.0F);
}

TEST(GainCalibration, ReliabilityIsOfThePredictionWithoutIt) {
  // what half-believed predictions keep must not make them whole: twice the same, half kept
  Thin thin;
  GainCalibration calibration(0.05);
  GainCalibration doubted(0.05);
  std::vector<Patch> halved = thin.patches();
  for (Patch& patch : halved) patch.reliability = 0.5F;
  EXPECT_NEAR(2.0 * doubted.expected(thin.seen(), halved),
              calibration.expected(thin.seen(), thin.patches()), 1e-3);
  doubted.note(thin.seen(), halved, thin.cells);
  calibration.note(thin.seen(), thin.patches(), thin.cells);
  SurfaceCells others = thin.cells;
  calibration.settle(thin.cells);
  doubted.settle(others);
  std::vector<Patch> a = thin.patches();
  std::vector<Patch> b = a;
  calibration.set_reliability(a);
  doubted.set_reliability(b);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i].reliability, b[i].reliability, 1e-5F);
}

Patch observed(std::uint8_t looks, std::uint8_t points = 0) {
  return {
      .missing = 10.0F, .source = PatchSource::sampled, .observations = looks, .points = points};
}

TEST(ObservationYield, BelievesWhatItSawOftenEnoughOfItsKindAlone) {
  ObservationYield yield;
  const ObservationYield fresh;
  for (int i = 0; i < 100; ++i) yield.learn(observed(0), {}, 1000.0, 250.0);
  EXPECT_GT(fresh.share(observed(0), {}), 0.5F);
  EXPECT_NEAR(yield.share(observed(0), {}), 0.25F, 0.01F);
  EXPECT_EQ(yield.share(observed(0), {.incidence = 1}), fresh.share(observed(0), {.incidence = 1}));
  EXPECT_EQ(yield.share(observed(0, 1), {}), fresh.share(observed(0, 1), {}));
  // all observations beyond the last bin are alike
  yield.learn(observed(200), {.incidence = 2}, 1e6, 5e5);
  EXPECT_EQ(yield.share(observed(4), {.incidence = 2}), yield.share(observed(9), {.incidence = 2}));
  EXPECT_NEAR(yield.share(observed(4), {.incidence = 2}), 0.5F, 0.01F);
  Patch patch = observed(1);
  const float whole = fresh.share(patch, {});
  patch.reliability = 0.5F;
  EXPECT_EQ(fresh.share(patch, {}), 0.5F * whole);
  for (const auto& [deg, bin] :
       {std::pair(44.9, 0U), std::pair(45.1, 1U), std::pair(64.9, 1U), std::pair(65.1, 2U)}) {
    EXPECT_EQ(incidence_bin(static_cast<float>(std::cos(deg_to_rad(deg)))), bin) << deg;
  }
}

}  // namespace
}  // namespace gnbv
