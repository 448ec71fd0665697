#include "planner/tour/look_ledger.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "tests/planner/tour/free_grid.hpp"

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
  for (const SeenPatch& look : seen) sum += static_cast<double>(patches[look.patch].missing);
  return sum;
}

TEST(LookLedger, FindsAllThatADenseScanBringsAndNothingThatNoneDoes) {
  for (const bool is_scanned : {true, false}) {
    Thin thin;
    const auto seen = thin.seen();
    const double lacking = missing(thin, seen);
    ASSERT_GT(lacking, 300.0);
    LookLedger ledger(TourSuccess::learned, 0.05);
    const float before = ledger.success().share(kPatch, 0);
    EXPECT_NEAR(ledger.promise(seen, thin.patches(), thin.cells),
                static_cast<double>(before) * lacking, 0.2 * lacking);
    if (is_scanned) thin.cells.add(plane(1.2, 0.01), thin.grid, 1);
    ledger.settle(thin.cells);
    EXPECT_NEAR(ledger.found(), is_scanned ? lacking : 0.0, 0.1 * lacking);
    const float after = ledger.success().share(kPatch, 0);
    if (is_scanned) {
      EXPECT_GE(after, before - 0.02F);
    } else {
      EXPECT_LT(after, 0.7F * before);
    }
    for (const SeenPatch& look : seen) {
      EXPECT_EQ(thin.cells.cells()[cell_of(look.patch)].looks[side_of(look.patch)], 1);
    }
    ledger.settle(thin.cells);
    EXPECT_TRUE(ledger.outcomes().empty()) << "nothing was under way";
  }
}

TEST(LookLedger, CreditFallsWherePromisesFailAndComesBackThere) {
  Thin thin;
  LookLedger ledger(TourSuccess::learned, 0.05);
  const auto cube_m = static_cast<float>(0.05 * LookLedger::kCreditCube);
  const auto credit_at = [&](const Vec3f& p_m) {
    std::vector<Patch> patches = {{.target_m = p_m, .missing = 1.0F}};
    ledger.give_credit(patches);
    return patches.front().credit;
  };
  const Vec3f here(0.5F * cube_m, 0.5F * cube_m, 1.03F);
  EXPECT_EQ(credit_at(here), 1.0F);
  for (int view = 0; view < 4; ++view) {
    ledger.promise(thin.seen(), thin.patches(), thin.cells);
    ledger.settle(thin.cells);  // nothing came
  }
  const float before = credit_at(here);
  EXPECT_LT(before, 0.5F);
  EXPECT_EQ(credit_at(here + 3.0F * cube_m * Vec3f::UnitX()), 1.0F) << "nobody looked there";
  std::vector<Patch> patches = thin.patches();
  ledger.give_credit(patches);
  ledger.promise(thin.seen(), patches, thin.cells);
  thin.cells.add(plane(1.2, 0.01), thin.grid, 1);
  ledger.settle(thin.cells);
  EXPECT_GT(credit_at(here), before);
  EXPECT_LE(credit_at(here), 1.0F);
}

TEST(LookLedger, CreditIsOfThePromiseWithoutIt) {
  // what half-believed promises keep must not make them whole: twice the same, half kept
  Thin thin;
  LookLedger ledger(TourSuccess::learned, 0.05);
  LookLedger doubted(TourSuccess::learned, 0.05);
  std::vector<Patch> halved = thin.patches();
  for (Patch& patch : halved) patch.credit = 0.5F;
  EXPECT_NEAR(2.0 * doubted.promise(thin.seen(), halved, thin.cells),
              ledger.promise(thin.seen(), thin.patches(), thin.cells), 1e-3);
  SurfaceCells others = thin.cells;
  ledger.settle(thin.cells);
  doubted.settle(others);
  std::vector<Patch> a = thin.patches();
  std::vector<Patch> b = a;
  ledger.give_credit(a);
  doubted.give_credit(b);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i].credit, b[i].credit, 1e-5F);
}

TEST(LookLedger, FixedSuccessGivesFullCredit) {
  Thin thin;
  LookLedger ledger(TourSuccess::fixed, 0.05);
  ledger.promise(thin.seen(), thin.patches(), thin.cells);
  ledger.settle(thin.cells);
  std::vector<Patch> patches = thin.patches();
  ledger.give_credit(patches);
  for (const Patch& patch : patches) EXPECT_EQ(patch.credit, 1.0F);
}

}  // namespace
}  // namespace gnbv
