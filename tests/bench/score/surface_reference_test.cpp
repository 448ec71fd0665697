#include "bench/score/surface_reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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
  // from 1.025 to 2.025: 21 voxels of 0.05, 11 of 0.10, 3 of 0.50 m along each axis, without the
  // inner ones
  const std::array<int, 3> n = {21, 11, 3};
  for (std::size_t i = 0; i < 3; ++i) {
    const int inner = n[i] - 2;
    const auto shell = static_cast<std::size_t>(n[i] * n[i] * n[i] - inner * inner * inner);
    EXPECT_EQ(reference.raw[i].size(), shell);
    EXPECT_EQ(reference.outside[i], reference.raw[i]);
  }
}

TEST(SurfaceReference, BoxInsideAClosedBoxIsNeverOutside) {
  TriangleMesh inner;
  test::add_box(inner, kMin + Vec3(0.5, 0.5, 0.5), Vec3(1, 1, 1));
  TriangleMesh both = inner;
  test::add_box(both, kMin, Vec3(2, 2, 2));
  const SurfaceReference reference = reference_of(both);
  const VoxelSet hidden = voxels_of_mesh(inner, 0.05);
  EXPECT_EQ(common(reference.raw[0], hidden), hidden.size());
  EXPECT_EQ(common(reference.outside[0], hidden), 0U);
  EXPECT_EQ(reference.outside[0].size(), reference.raw[0].size() - hidden.size());
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
  const std::size_t shown = common(reference.outside[0], boxed);
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
    EXPECT_EQ(alone.outside[0], alone.raw[0]);
    test::add_sheet(mesh, kMin + Vec3(0, 0, 0.2), Vec3(1, 0, 0), Vec3(0, 1, 0));
    const SurfaceReference covered = reference_of(mesh);
    EXPECT_EQ(covered.outside[0], covered.raw[0]);
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
  EXPECT_EQ(reference.outside[0], reference.raw[0]);
}

TEST(SurfaceReference, BottomOfAShaftIsSeenAlongItsNormal) {
  // A plate in a shaft 0.2 m wide, 1 m below its mouth: less than 6 degrees of sky, narrower than
  // the steepest of 128 directions (7 degrees). The shaft is closed 0.2 m below the plate.
  for (const bool flipped : {false, true}) {
    TriangleMesh mesh;
    test::add_box(mesh, kMin, Vec3(0.2, 0.2, 1.2), false);
    const Vec3 a = flipped ? Vec3(0, 0.2, 0) : Vec3(0.2, 0, 0);
    const Vec3 b = flipped ? Vec3(0.2, 0, 0) : Vec3(0, 0.2, 0);
    test::add_sheet(mesh, kMin + Vec3(0, 0, 0.2), a, b);
    const std::uint64_t middle = voxel_code((kMin + Vec3(0.1, 0.1, 0.2)).cast<float>(), 0.05);
    const VoxelSet outside = reference_of(mesh).outside[0];
    EXPECT_TRUE(std::binary_search(outside.begin(), outside.end(), middle));
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

TEST(SurfaceReference, EmptyMeshAsksForNothing) {
  const SurfaceReference reference = reference_of(TriangleMesh{});
  EXPECT_TRUE(reference.raw[0].empty());
  EXPECT_EQ(coverage_at_all_sizes(reference.outside, {}), (std::array<double, 3>{0, 0, 0}));
}

// A box with a slit, a box in it, and a sheet that crosses slabs of work.
TriangleMesh cluttered() {
  TriangleMesh mesh;
  test::add_box(mesh, Vec3(-1.3, -1.1, 0.1), Vec3(2, 1.7, 1.4), false);
  test::add_sheet(mesh, Vec3(-1.3, -1.1, 1.5), Vec3(1.8, 0, 0), Vec3(0, 1.7, 0));
  test::add_box(mesh, Vec3(-0.9, -0.7, 0.4), Vec3(0.6, 0.7, 0.5));
  test::add_sheet(mesh, Vec3(-2.2, 1.0, 0.2), Vec3(4, 0.3, 0.4), Vec3(0.1, 0.7, 1));
  return mesh;
}

TEST(SurfaceReference, SizesNest) {
  const SurfaceReference reference = reference_of(cluttered());
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_EQ(reference.raw[i], coarser(reference.raw[0], kCoverageFactors[i]));
    EXPECT_EQ(reference.outside[i], coarser(reference.outside[0], kCoverageFactors[i]));
  }
  EXPECT_EQ(coarser(reference.raw[1], 5), reference.raw[2]);
}

TEST(SurfaceReference, IsMadeOfTheSamplesThatSeeOut) {
  // the slow way: every sample asked for itself
  const World world{cluttered(), true};
  const RayScene scene(world);
  const ReferenceConfig config;
  const std::vector<SurfaceSample> samples =
      sample_surface(world.structure, config.sample_spacing_m);
  const std::vector<std::uint8_t> out = samples_seeing_out(world, scene, samples, config, 1);
  std::vector<Vec3f> all, seen;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (static_cast<double>(samples[i].p_world_m.z()) < config.floor_z_m) continue;
    all.push_back(samples[i].p_world_m);
    if (out[i] != 0) seen.push_back(samples[i].p_world_m);
  }
  const SurfaceReference reference = make_surface_reference(world, scene, config, 2);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(reference.raw[i], voxels_of(all, kCoverageSizes_m[i]));
    EXPECT_EQ(reference.outside[i], voxels_of(seen, kCoverageSizes_m[i]));
  }
  EXPECT_LT(reference.outside[0].size(), reference.raw[0].size());
  EXPECT_EQ(coverage_at_all_sizes(reference.raw, all), (std::array<double, 3>{1, 1, 1}));
  EXPECT_EQ(coverage_at_all_sizes(reference.outside, seen), (std::array<double, 3>{1, 1, 1}));
}

TEST(SurfaceReference, IsTheSameOnAnyNumberOfThreads) {
  const SurfaceReference one = reference_of(cluttered(), 1);
  for (const int threads : {2, 5}) {
    const SurfaceReference many = reference_of(cluttered(), threads);
    EXPECT_EQ(one.raw, many.raw);
    EXPECT_EQ(one.outside, many.outside);
  }
}

}  // namespace
}  // namespace gnbv
