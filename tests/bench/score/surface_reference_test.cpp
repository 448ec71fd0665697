#include "bench/score/surface_reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "assets/catalog.hpp"
#include "bench/score/surface_pieces.hpp"
#include "bench/score/surface_samples.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv {
namespace {

SurfaceReference reference_of(const TriangleMesh& mesh, int threads = 2,
                              const ReferenceConfig& config = {}) {
  const World world{mesh, true};
  const RayScene scene(world);
  return make_surface_reference(world, scene, config, threads);
}

VoxelSet voxels_of_mesh(const TriangleMesh& mesh, double size_m) {
  std::vector<Vec3f> points;
  for (const SurfaceSample& s : sample_surface(mesh, 0.0125)) points.push_back(s.p_world_m);
  return voxels_of(points, size_m);
}

std::size_t common(const VoxelSet& a, const VoxelSet& b) {
  VoxelSet both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both.size();
}

// Sides in the middle of voxels of 0.05 m, so that nothing lies between two voxels.
const Vec3 kMin(1.025, 1.025, 1.025);

TEST(SurfaceReference, CubeHasTheVoxelsOfItsShell) {
  TriangleMesh cube;
  test::add_box(cube, kMin, Vec3(1, 1, 1));
  const SurfaceReference reference = reference_of(cube);
  // from 1.025 to 2.025: 21 voxels of 0.05 and 11 of 0.10 m along each axis, without the inner
  // ones; of 0.50 m three, of which the last is entered by 0.025 m: an edge there has 0.025 m2 in a
  // whole voxel, just a tenth of a face, but less in the first one, and the corner has less
  const auto shell = [](int n) {
    return static_cast<std::size_t>(n * n * n - (n - 2) * (n - 2) * (n - 2));
  };
  const std::size_t poor = 3 + 1;
  const std::array<std::size_t, 3> expected = {shell(21), shell(11), shell(3) - poor};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(reference.raw[i].size(), expected[i]) << i;
    EXPECT_EQ(reference.counted[i], reference.raw[i]) << i;
  }
}

TEST(SurfaceReference, ASliverCountsFromATenthOfAFaceOn) {
  for (const double width_m : {0.0049, 0.0051}) {
    // across one voxel; the sheet goes on into the next one by the rest of its 0.04 m
    TriangleMesh sheet;
    test::add_sheet(sheet, Vec3(1.05 - width_m, 1.0, 1.025), Vec3(0.04, 0, 0), Vec3(0, 1, 0));
    const SurfaceReference reference = reference_of(sheet);
    const std::size_t columns = width_m < 0.005 ? 1 : 2;
    EXPECT_EQ(reference.raw[0].size(), columns * 20U) << width_m;
    EXPECT_EQ(reference.counted[0].size(), columns * 20U) << width_m;
  }
}

TEST(SurfaceReference, SliversOfFineVoxelsAddUpInACoarseOne) {
  // four strips of 0.004 m, each too poor for its voxel of 0.05 m, together 16 cm2 in each of
  // 0.10 m, where 10 are a tenth of a face
  TriangleMesh strips;
  for (int k = 0; k < 2; ++k) {
    for (int l = 0; l < 2; ++l) {
      test::add_sheet(strips, Vec3(1.02 + 0.05 * k, 1.0, 1.02 + 0.05 * l), Vec3(0.004, 0, 0),
                      Vec3(0, 1, 0));
    }
  }
  const SurfaceReference reference = reference_of(strips);
  EXPECT_TRUE(reference.raw[0].empty());
  EXPECT_EQ(reference.raw[1].size(), 10U);
  EXPECT_EQ(reference.counted[1].size(), 10U);
}

TEST(SurfaceReference, BoxInsideAClosedBoxIsNeverOutside) {
  TriangleMesh inner;
  test::add_box(inner, kMin + Vec3(0.5, 0.5, 0.5), Vec3(1, 1, 1));
  TriangleMesh both = inner;
  test::add_box(both, kMin, Vec3(2, 2, 2));
  const SurfaceReference reference = reference_of(both);
  const VoxelSet hidden = voxels_of_mesh(inner, 0.05);
  EXPECT_EQ(common(reference.raw[0], hidden), hidden.size());
  EXPECT_EQ(common(reference.counted[0], hidden), 0U);
  EXPECT_EQ(reference.counted[0].size(), reference.raw[0].size() - hidden.size());
}

TEST(SurfaceReference, OpenBoxShowsWhatItsMouthLooksAt) {
  // without its lid, the inner box sees the sky: every direction a little upward from its top
  // leaves
  TriangleMesh inner;
  test::add_box(inner, kMin + Vec3(0.5, 0.5, 0.5), Vec3(1, 1, 1));
  TriangleMesh open = inner;
  test::add_box(open, kMin, Vec3(2, 2, 2), false);
  const SurfaceReference reference = reference_of(open);
  const VoxelSet boxed = voxels_of_mesh(inner, 0.05);
  const std::size_t shown = common(reference.counted[0], boxed);
  // the top is 21 x 21; the bottom looks at the floor 0.5 m below, of which nothing leads out
  EXPECT_GE(shown, 21U * 21U);
  EXPECT_LE(shown, boxed.size() - 19U * 19U);
}

TEST(SurfaceReference, SheetIsSeenFromEitherSide) {
  // lid 0.2 m over a sheet: blocked along one normal, free along the other, whichever way it winds
  for (const bool flipped : {false, true}) {
    TriangleMesh mesh;
    test::add_sheet(mesh, kMin, flipped ? Vec3(0, 1, 0) : Vec3(1, 0, 0),
                    flipped ? Vec3(1, 0, 0) : Vec3(0, 1, 0));
    const SurfaceReference alone = reference_of(mesh);
    EXPECT_EQ(alone.raw[0].size(), 21U * 21U);
    EXPECT_EQ(alone.counted[0], alone.raw[0]);
    test::add_sheet(mesh, kMin + Vec3(0, 0, 0.2), Vec3(1, 0, 0), Vec3(0, 1, 0));
    const SurfaceReference covered = reference_of(mesh);
    EXPECT_EQ(covered.counted[0], covered.raw[0]);
  }
}

TEST(SurfaceReference, SheetBetweenTwoOthersIsSeenThroughTheGaps) {
  // seen from its middle, the sheet above ends 39 degrees over the horizon: the normals are
  // blocked, many directions are not
  TriangleMesh mesh;
  for (const double z_m : {0.0, 0.4, 0.8}) {
    test::add_sheet(mesh, kMin + Vec3(0, 0, z_m), Vec3(1, 0, 0), Vec3(0, 1, 0));
  }
  const SurfaceReference reference = reference_of(mesh);
  EXPECT_EQ(reference.raw[0].size(), 3U * 21U * 21U);
  EXPECT_EQ(reference.counted[0], reference.raw[0]);
}

TEST(SurfaceReference, BottomOfAShaftIsSeenAlongItsNormal) {
  // A plate in a shaft 0.2 m wide, 1 m below its mouth: 0.04 steradian of sky, less than the tenth
  // that counts aside the normal. The shaft is closed 0.2 m below the plate.
  for (const bool flipped : {false, true}) {
    TriangleMesh mesh;
    test::add_box(mesh, kMin, Vec3(0.2, 0.2, 1.2), false);
    const Vec3 a = flipped ? Vec3(0, 0.2, 0) : Vec3(0.2, 0, 0);
    const Vec3 b = flipped ? Vec3(0.2, 0, 0) : Vec3(0, 0.2, 0);
    test::add_sheet(mesh, kMin + Vec3(0, 0, 0.2), a, b);
    const std::uint64_t middle = voxel_code((kMin + Vec3(0.1, 0.1, 0.2)).cast<float>(), 0.05);
    const VoxelSet outside = reference_of(mesh).counted[0];
    EXPECT_TRUE(std::binary_search(outside.begin(), outside.end(), middle));
  }
}

TEST(SurfaceReference, AsideTheNormalATenthOfASteradianMustBeOpen) {
  // A plate below a slab with a hole aside its normal, wider or narrower than that; closed all
  // around and below, so that the hole is the only way out.
  for (const double hole_m : {0.15, 0.6}) {
    TriangleMesh mesh;
    test::add_box(mesh, kMin, Vec3(3, 3, 1), false);
    // the lid, 0.5 m above the plate, without a hole at its x end
    test::add_sheet(mesh, kMin + Vec3(0, 0, 1), Vec3(3.0 - hole_m, 0, 0), Vec3(0, 3, 0));
    test::add_sheet(mesh, kMin + Vec3(3.0 - hole_m, 0, 1), Vec3(hole_m, 0, 0),
                    Vec3(0, 1.5 - 0.5 * hole_m, 0));
    test::add_sheet(mesh, kMin + Vec3(3.0 - hole_m, 1.5 + 0.5 * hole_m, 1), Vec3(hole_m, 0, 0),
                    Vec3(0, 1.5 - 0.5 * hole_m, 0));
    test::add_sheet(mesh, kMin + Vec3(2.2, 1.4, 0.5), Vec3(0.2, 0, 0), Vec3(0, 0.2, 0));
    const std::uint64_t middle = voxel_code((kMin + Vec3(2.3, 1.5, 0.5)).cast<float>(), 0.05);
    const VoxelSet outside = reference_of(mesh).counted[0];
    EXPECT_EQ(std::binary_search(outside.begin(), outside.end(), middle), hole_m > 0.5) << hole_m;
  }
}

TEST(SurfaceReference, SurfaceBelowTheFloorIsNotAskedFor) {
  TriangleMesh wall;
  test::add_sheet(wall, Vec3(0.025, 0.025, 0.0), Vec3(1, 0, 0), Vec3(0, 0, 1));
  const SurfaceReference reference = reference_of(wall);
  // of the 20 voxels up the wall, the six below 0.3 m are missing
  EXPECT_EQ(reference.raw[0].size(), 21U * 14U);
  for (const std::uint64_t code : reference.raw[0]) {
    EXPECT_GT(voxel_centre_m(code, 0.05).z(), 0.3);
  }
  ReferenceConfig from_the_ground;
  from_the_ground.floor_z_m = 0.0;
  EXPECT_EQ(reference_of(wall, 1, from_the_ground).raw[0].size(), 21U * 20U);
}

TEST(AreaSamples, ASheetOfKVoxelsHasAsManyAsDrawsMeet) {
  // each draw meets any of the 400 voxels alike: a share of 1 - (1 - 1/400)^n of them holds one
  TriangleMesh sheet;
  test::add_sheet(sheet, Vec3(1, 1, 1.025), Vec3(1, 0, 0), Vec3(0, 1, 0));
  for (const std::size_t draws : {100U, 400U, 1000U, 10000U}) {
    const double missed = std::pow(1.0 - 1.0 / 400.0, static_cast<double>(draws));
    const auto held =
        static_cast<double>(reference_of(sheet, 2, {.area_samples = draws}).counted[0].size());
    EXPECT_NEAR(held, 400.0 * (1.0 - missed),
                4.0 * std::sqrt(400.0 * missed * (1.0 - missed)) + 1e-9)
        << draws;
  }
}

/// An open box with a closed one in it, on a pole that goes below the floor.
TriangleMesh boxes_on_a_pole() {
  TriangleMesh mesh;
  test::add_box(mesh, kMin, Vec3(2, 2, 2), false);
  test::add_box(mesh, kMin + Vec3(0.5, 0.5, 0.5), Vec3(1, 1, 1));
  test::add_box(mesh, Vec3(2.01, 2.01, -1.0), Vec3(0.1, 0.1, 2.0));
  return mesh;
}

TEST(AreaSamples, VoxelsAndShareAreThoseOfAPlainLoop) {
  constexpr std::size_t kDraws = 4000;
  const TriangleMesh mesh = boxes_on_a_pole();
  const SurfaceReference reference = reference_of(mesh, 2, {.area_samples = kDraws});
  const std::vector<Vec3f> drawn = drawn_by_area(mesh, 0.3, kDraws);
  std::vector<Vec3f> cloud;
  for (std::size_t i = 0; i < kDraws; ++i) {
    cloud.push_back(drawn[i] + Vec3f(0.02F, i % 3 == 0 ? 0.2F : 0.0F, -0.01F));
  }
  const auto shares = coverage_at_all_sizes(reference.counted, cloud);
  for (std::size_t size = 0; size < 3; ++size) {
    const auto voxels_per_m = static_cast<float>(1.0 / kCoverageSizes_m[size]);
    const auto cells_of = [&](const std::vector<Vec3f>& points) {
      std::set<std::array<float, 3>> cells;
      for (const Vec3f& p : points) {
        cells.insert({std::floor(p.x() * voxels_per_m), std::floor(p.y() * voxels_per_m),
                      std::floor(p.z() * voxels_per_m)});
      }
      return cells;
    };
    const auto held = cells_of(drawn);
    std::vector<Vec3f> around;  // corners of a cube of 0.3 mm: they lie in all that a point covers
    for (int k = 0; k < 8; ++k) {
      const Vec3f corner(k % 2 == 0 ? -1.0F : 1.0F, k / 2 % 2 == 0 ? -1.0F : 1.0F,
                         k / 4 == 0 ? -1.0F : 1.0F);
      for (const Vec3f& p : cloud) around.push_back(p + 0.00015F * corner);
    }
    const auto met = cells_of(around);
    const auto found = std::ranges::count_if(held, [&](const auto& c) { return met.contains(c); });
    EXPECT_EQ(reference.counted[size].size(), held.size()) << size;
    EXPECT_DOUBLE_EQ(shares[size], static_cast<double>(found) / static_cast<double>(held.size()));
    EXPECT_GT(shares[size], 0.1);
    EXPECT_LT(shares[size], 1.0);
  }
}

TEST(AreaSamples, ChangeNothingElseAndAreTheSameAtAnyNumberOfThreads) {
  const TriangleMesh mesh = boxes_on_a_pole();
  const SurfaceReference outside = reference_of(mesh, 2);
  const SurfaceReference one = reference_of(mesh, 1, {.area_samples = 3000});
  for (const int threads : {2, 5}) {
    EXPECT_EQ(reference_of(mesh, threads, {.area_samples = 3000}), one) << threads;
  }
  EXPECT_EQ(one.raw, outside.raw);
  EXPECT_EQ(one.samples_world_m, outside.samples_world_m);
  // the inner box is asked for, too
  TriangleMesh inner;
  test::add_box(inner, kMin + Vec3(0.5, 0.5, 0.5), Vec3(1, 1, 1));
  const VoxelSet low = voxels_of_mesh(inner, 0.05);
  EXPECT_GT(common(one.counted[0], low), low.size() / 10);
}

TEST(AreaSamples, OfARegionAreThoseWithTheirVoxelsCentresInIt) {
  const TriangleMesh mesh = boxes_on_a_pole();
  const auto counted_in = [&](double from_m, double to_m) {
    const Box3 region_m(Vec3(from_m, -9, -9), Vec3(to_m, 9, 9));
    return reference_of(mesh, 2, {.area_samples = 3000, .region_m = region_m}).counted;
  };
  const auto whole = counted_in(-9, 9), west = counted_in(-9, 2), east = counted_in(2, 9);
  for (std::size_t size = 0; size < 3; ++size) {
    VoxelSet both;
    std::ranges::set_union(west[size], east[size], std::back_inserter(both));
    EXPECT_EQ(both, whole[size]);
    EXPECT_EQ(both.size(), west[size].size() + east[size].size());
  }
}

TEST(SurfaceReference, EmptyMeshAsksForNothing) {
  const SurfaceReference reference = reference_of(TriangleMesh{});
  EXPECT_TRUE(reference.raw[0].empty());
  EXPECT_EQ(coverage_at_all_sizes(reference.counted, {}), (std::array<double, 3>{0, 0, 0}));
}

/// The voxels that are in one of the two, as a share of the first.
double unlike(const VoxelSet& a, const VoxelSet& b) {
  const auto both = static_cast<double>(common(a, b));
  return (static_cast<double>(a.size() + b.size()) - 2.0 * both) / static_cast<double>(a.size());
}

TEST(SurfaceReference, HalvingTheSpacingMovesCoverageByLessThanAFifthOfAPoint) {
  // A cloud's coverage moves by no more than the share of voxels that come or go. The large
  // structures are measured in bench/results.
  for (const std::string_view name : {"smoke", "lab_model", "lab_airplane"}) {
    const TriangleMesh mesh = make_builtin_structure(name);
    const ReferenceConfig usual;
    ReferenceConfig halved = usual;
    halved.sample_spacing_m *= 0.5;
    halved.fewest_samples *= 4;
    const SurfaceReference coarse = reference_of(mesh, 2, usual);
    const SurfaceReference fine = reference_of(mesh, 2, halved);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(coarse.raw[i], fine.raw[i]) << name;
      EXPECT_LT(unlike(coarse.counted[i], fine.counted[i]), 0.002) << name << " " << i;
    }
  }
}

TEST(SurfaceReference, CostIsForetoldAndProgressToldUntilItIsThere) {
  TriangleMesh hall;
  test::add_box(hall, {0.01, 0.02, 0.31}, {12, 9, 3});
  for (int i = 0; i < 5; ++i) test::add_box(hall, {1.0 + 2.0 * i, 4.03, 0.5}, {0.4, 0.4, 2});
  const World world{.structure = hall};
  const RayScene scene(world);
  std::vector<double> shares;
  const SurfaceReference found =
      make_surface_reference(world, scene, {}, 2, [&](double share) { shares.push_back(share); });
  const ReferenceCost cost = cost_of_reference(hall, {});
  EXPECT_NEAR(cost.area_m2, surface_area_m2(hall), 1e-9);
  const auto voxels = static_cast<double>(found.raw[0].size());
  EXPECT_GT(cost.voxels, voxels / 2.0);
  EXPECT_LT(cost.voxels, voxels * 2.0);
  EXPECT_EQ(shares.front(), 0.0);
  EXPECT_EQ(shares.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(found, reference_of(hall));
}

}  // namespace
}  // namespace gnbv
