// Mirror planes: found where they are, declined where there are none, believed no further than
// measurements reach.
#include "planner/symmetry/symmetry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "tests/planner/map/drawn_map.hpp"
#include "tests/planner/map/random_points.hpp"

namespace gnbv {
namespace {

// Heaps of spheres: structures whose symmetry is known in closed form.

struct Sphere {
  Vec3 center_m;
  double radius_m;
};
using Blobs = std::vector<Sphere>;

const Box3 kBlobSpace(Vec3(-12, -12, 0), Vec3(12, 12, 6));

/// Spheres along an L in plan, all in x > 0.5, of random sizes and heights.
Blobs l_shaped_half(std::uint64_t seed) {
  Random random(seed);
  Blobs blobs;
  const auto add = [&](double x_m, double y_m) {
    const double radius_m = random.uniform(0.5, 1.1);
    blobs.push_back({{x_m + random.uniform(-0.3, 0.3), y_m + random.uniform(-0.3, 0.3),
                      radius_m + random.uniform(0.2, 2.5)},
                     radius_m});
  };
  for (int i = 0; i < 6; ++i) add(1.8, -6.0 + 1.4 * i);
  for (int i = 0; i < 4; ++i) add(3.2 + 1.4 * i, -6.0);
  return blobs;
}

/// The blobs, and behind them their images.
template <typename Map>
Blobs with_images(Blobs blobs, const Map& map) {
  const std::size_t count = blobs.size();
  for (std::size_t i = 0; i < count; ++i) {
    blobs.push_back({map(blobs[i].center_m), blobs[i].radius_m});
  }
  return blobs;
}

bool is_inside(const Blobs& blobs, const Vec3& p_m, double margin_m) {
  return std::any_of(blobs.begin(), blobs.end(), [&](const Sphere& sphere) {
    return (p_m - sphere.center_m).norm() < sphere.radius_m + margin_m;
  });
}

/// Points of the outer surface, evenly by a golden spiral, about one in a square of `spacing_m`.
std::vector<Vec3f> surface_points_m(const Blobs& blobs, double spacing_m) {
  std::vector<Vec3f> points;
  for (const Sphere& sphere : blobs) {
    const double area_m2 = 4.0 * kPi * sphere.radius_m * sphere.radius_m;
    const int count = static_cast<int>(area_m2 / (spacing_m * spacing_m));
    for (int i = 0; i < count; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / count;
      const double azimuth_rad = kPi * (3.0 - std::sqrt(5.0)) * i;
      const double r = std::sqrt(1.0 - z * z);
      const Vec3 p_m = sphere.center_m + sphere.radius_m * Vec3(r * std::cos(azimuth_rad),
                                                                r * std::sin(azimuth_rad), z);
      if (!is_inside(blobs, p_m, -1e-6)) points.push_back(p_m.cast<float>());
    }
  }
  return points;
}

/// What a perfect sensor makes of them where `is_known`: points' voxels occupied, all outside the
/// spheres free, the inside unmeasured.
template <typename IsKnown>
OccupancyGrid measured_grid(const Blobs& blobs, const std::vector<Vec3f>& points_m,
                            const IsKnown& is_known) {
  OccupancyGrid grid({}, kBlobSpace);
  std::set<VoxelIndex> occupied;
  for (const Vec3f& p_m : points_m) occupied.insert(voxel_at(grid, p_m.cast<double>()));
  std::vector<VoxelIndex> free = voxels_where(
      grid, [&](const Vec3& p_m) { return is_known(p_m) && !is_inside(blobs, p_m, 0.0); });
  std::erase_if(free, [&](VoxelIndex v) { return occupied.contains(v); });
  grid.apply({.free = free, .occupied = {occupied.begin(), occupied.end()}});
  return grid;
}

MirrorPlane plane_at(double azimuth_deg, double offset_m) {
  const double azimuth_rad = deg_to_rad(azimuth_deg);
  const Vec3 normal(std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0);
  return plane_through(offset_m * normal, normal);
}

/// Turns about z and moves, so that what was at the plane x = 0 is at `plane`.
Blobs moved_to(Blobs blobs, const MirrorPlane& plane) {
  const double azimuth_rad = std::atan2(plane.normal_world.y(), plane.normal_world.x());
  for (Sphere& sphere : blobs) {
    sphere.center_m = Eigen::AngleAxisd(azimuth_rad, Vec3::UnitZ()) * sphere.center_m +
                      plane.offset_m * plane.normal_world;
  }
  return blobs;
}

Blobs mirror_pair(std::uint64_t seed, const MirrorPlane& plane) {
  return with_images(moved_to(l_shaped_half(seed), plane),
                     [&](const Vec3& p_m) { return mirrored(plane, p_m); });
}

/// The half and itself, half a turn about z further: a body that turns into itself, but into no
/// mirror image.
Blobs turned_pair(std::uint64_t seed) {
  return with_images(l_shaped_half(seed),
                     [](const Vec3& p_m) { return Vec3(-p_m.x(), -p_m.y(), p_m.z()); });
}

Symmetry symmetry_of(const Blobs& blobs, const SymmetryConfig& config = {}) {
  const std::vector<Vec3f> points_m = surface_points_m(blobs, 0.12);
  return find_symmetry(config, points_m, measured_grid(blobs, points_m, everywhere));
}

void expect_plane(const Symmetry& symmetry, const MirrorPlane& truth) {
  ASSERT_TRUE(symmetry.plane) << "support " << symmetry.support;
  const double cosine = std::fabs(symmetry.plane->normal_world.dot(truth.normal_world));
  EXPECT_LT(rad_to_deg(std::acos(std::min(cosine, 1.0))), 1.0);
  // where the structure is: at the foot of the workspace's centre
  EXPECT_LT(std::fabs(truth.normal_world.dot(mirrored(*symmetry.plane, Vec3::Zero())) -
                      2.0 * truth.offset_m),
            0.2);
}

TEST(MirrorPlane, MirrorsTwiceIntoItselfAndHasOneNormalFromEitherSide) {
  const Vec3 through_m(1, 2, 3), p_m(0.3, -4.0, 5.0);
  for (const Vec3& normal : {Vec3(1, -2, 3), Vec3(0, 2, -1), Vec3(0, 0, 4)}) {
    const MirrorPlane plane = plane_through(through_m, normal);
    const MirrorPlane opposite = plane_through(through_m, -normal);
    EXPECT_EQ(plane.normal_world, opposite.normal_world);
    EXPECT_EQ(plane.offset_m, opposite.offset_m);
    EXPECT_LT((plane.normal_world - normal.normalized()).norm(), 1e-12);
    EXPECT_NEAR(plane.normal_world.dot(through_m), plane.offset_m, 1e-12);
    const Vec3 image_m = mirrored(plane, p_m);
    EXPECT_LT((mirrored(plane, image_m) - p_m).norm(), 1e-12);
    EXPECT_NEAR(plane.normal_world.dot(0.5 * (p_m + image_m)), plane.offset_m, 1e-12);
    EXPECT_LT((image_m - p_m).cross(plane.normal_world).norm(), 1e-12);
  }
}

TEST(ClusterPlanes, FindsTheBundlesAmongNoise) {
  Random random(5);
  // the second stands at the border of the half space that normals point into
  const std::vector<MirrorPlane> bundles = {plane_at(30.0, 2.0), plane_at(90.0, -3.0)};
  const Extent extent = {Vec3(2, -1, 3), 10.0};
  std::vector<MirrorPlane> planes;
  for (std::size_t i = 0; i < 120; ++i) {
    const MirrorPlane& bundle = bundles[i < 70 ? 0 : 1];
    const Vec3 through_m =
        extent.center_world_m +
        (bundle.offset_m - bundle.normal_world.dot(extent.center_world_m)) * bundle.normal_world;
    const double turn_rad = random.uniform(-0.02, 0.02);
    planes.push_back(
        plane_through(through_m + random.uniform(-0.2, 0.2) * bundle.normal_world,
                      Eigen::AngleAxisd(turn_rad, Vec3::UnitZ()) * bundle.normal_world));
  }
  for (int i = 0; i < 200; ++i) {
    planes.push_back(plane_at(random.uniform(-90.0, 90.0), random.uniform(-10.0, 10.0)));
  }
  const std::vector<PlaneCluster> clusters = cluster_planes(planes, extent, 0.6);
  ASSERT_GE(clusters.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(distance_m(clusters[i].plane, bundles[i], extent), 0.15);
    EXPECT_GE(clusters[i].votes, i == 0 ? 70U : 50U);
  }
  EXPECT_TRUE(cluster_planes({}, {}, 0.6).empty());
}

TEST(MirrorSupport, CountsWhatFallsOnSurfaceAmidFreeSpaceAndOutside) {
  // voxels of 0.2 m from x = -2 to 2: free, but for surface at x = -1.1 and nothing known at -1.7
  OccupancyGrid grid({}, Box3(Vec3(-2, -1, 0), Vec3(2, 1, 2)));
  const auto at = [&](double x_m) {
    return voxels_where(grid, [=](const Vec3& p_m) { return std::fabs(p_m.x() - x_m) < 0.01; });
  };
  for (double x_m = -1.9; x_m < 2.0; x_m += 0.2) {
    if (std::fabs(x_m + 1.7) > 0.01 && std::fabs(x_m + 1.1) > 0.01) clear(grid, at(x_m));
  }
  hit(grid, at(-1.1));
  const std::vector<Vec3f> points_m = {
      {1.1F, 0.1F, 1.1F},  // onto the surface
      {0.9F, 0.1F, 1.1F},  // a voxel beside it
      {0.7F, 0.1F, 1.1F},  // two voxels beside it: amid free space
      {1.7F, 0.1F, 1.1F},  // where nothing is known
      {1.5F, 0.1F, 1.1F},  // a voxel beside that
      {2.5F, 0.1F, 1.1F},  // outside
      {0.3F, 0.1F, 1.1F},  // nearly onto itself: no inlier
      {0.1F, 0.1F, 1.1F},
  };
  const MirrorSupport support = mirror_support(grid, points_m, {});
  EXPECT_DOUBLE_EQ(support.moved, 6.0 / 8.0);
  EXPECT_DOUBLE_EQ(support.support, 4.0 / 6.0);
  EXPECT_DOUBLE_EQ(support.confirmed, 2.0 / 6.0);
}

TEST(FindSymmetry, FindsTheObliquePlaneOfAMirroredPairAndMirrorsEveryPoint) {
  for (const auto& [seed, azimuth_deg, offset_m] :
       {std::tuple(1U, 0.0, 0.0), {2U, 37.0, 1.3}, {3U, -64.0, -0.9}}) {
    const MirrorPlane truth = plane_at(azimuth_deg, offset_m);
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Blobs blobs = mirror_pair(seed, truth);
    const std::vector<Vec3f> points_m = surface_points_m(blobs, 0.12);
    const Symmetry symmetry = symmetry_of(blobs);
    expect_plane(symmetry, truth);
    ASSERT_EQ(symmetry.mirrored_world_m.size(), points_m.size());
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      const Vec3 expected_m = mirrored(*symmetry.plane, points_m[i].cast<double>());
      EXPECT_EQ(symmetry.mirrored_world_m[i], Vec3f(expected_m.cast<float>()));
    }
  }
}

TEST(FindSymmetry, DeclinesWhatOnlyTurnsIntoItself) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Symmetry symmetry = symmetry_of(turned_pair(seed));
    EXPECT_FALSE(symmetry.plane) << "seed " << seed << ", support " << symmetry.support;
    EXPECT_LT(symmetry.support, 0.9);
    EXPECT_TRUE(symmetry.mirrored_world_m.empty());
  }
}

TEST(FindSymmetry, DeclinesALevelMirror) {
  const MirrorPlane level = {Vec3::UnitZ(), 2.9};
  Blobs half = l_shaped_half(4);
  for (Sphere& sphere : half)
    sphere.center_m.z() = 0.3 + 0.4 * sphere.center_m.z() + sphere.radius_m;
  std::erase_if(half, [](const Sphere& s) { return s.center_m.z() + s.radius_m > 2.8; });
  ASSERT_GE(half.size(), 5U);
  EXPECT_FALSE(
      symmetry_of(with_images(half, [&](const Vec3& p_m) { return mirrored(level, p_m); })).plane);
}

TEST(FindSymmetry, DeclinesToMirrorIntoTheUnknown) {
  const Blobs half = l_shaped_half(1);
  const std::vector<Vec3f> points_m = surface_points_m(half, 0.12);
  const OccupancyGrid grid = measured_grid(half, points_m, [](const Vec3&) { return false; });
  // nothing speaks against any plane, only too little for it
  const Symmetry gullible = find_symmetry({.min_confirmed = 0.0}, points_m, grid);
  EXPECT_TRUE(gullible.plane);
  EXPECT_LT(gullible.confirmed, 0.6);
  EXPECT_FALSE(find_symmetry({.min_confirmed = 0.6}, points_m, grid).plane);
}

/// The surface of the blobs, before its normals are estimated.
std::vector<ProfilePoint> profile_of(const Blobs& blobs) {
  std::vector<ProfilePoint> profile;
  for (const Vec3f& p_m : surface_points_m(blobs, 0.12)) profile.push_back({p_m, Vec3f::UnitZ()});
  return profile;
}

TEST(MatchKeypoints, PairsKeypointsWithTheirImages) {
  const MirrorPlane truth = plane_at(37.0, 1.3);
  std::vector<ProfilePoint> profile;
  for (const Sphere& sphere : mirror_pair(2, truth)) {
    for (ProfilePoint& point : profile_of({sphere})) {
      point.outward_world = point.p_world_m - sphere.center_m.cast<float>();
      profile.push_back(point);
    }
  }
  symmetry_module().estimate_normals(profile, 0, profile.size());
  std::vector<KeypointPair> pairs;
  symmetry_module().match_keypoints(profile, pairs);
  std::size_t images = 0;
  for (const KeypointPair& pair : pairs) {
    const Vec3 image_m = mirrored(truth, pair.a_world_m.cast<double>());
    images += (image_m - pair.b_world_m.cast<double>()).norm() < 0.3;
  }
  // by chance one pair in a hundred, as there are that many keypoints
  EXPECT_GT(pairs.size(), 400U);
  EXPECT_GT(static_cast<double>(images), 0.05 * static_cast<double>(pairs.size()));
}

TEST(EstimateNormals, AreThoseOfTheWholeInAnyPieces) {
  std::vector<ProfilePoint> whole = profile_of(mirror_pair(2, plane_at(37.0, 1.3)));
  std::vector<ProfilePoint> pieces = whole;
  symmetry_module().estimate_normals(whole, 0, whole.size());
  symmetry_module().estimate_normals(pieces, pieces.size() / 3, pieces.size());
  symmetry_module().estimate_normals(pieces, 0, pieces.size() / 3);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    ASSERT_NEAR(whole[i].normal_world.norm(), 1.0F, 1e-5F);
    ASSERT_GE(whole[i].normal_world.z(), 0.0F);  // outwards
    ASSERT_EQ(whole[i].normal_world, pieces[i].normal_world);
    ASSERT_EQ(whole[i].curvature, pieces[i].curvature);
  }
}

TEST(RefinePlanes, BringsAPlaneBack) {
  const MirrorPlane truth = plane_at(37.0, 1.3);
  std::vector<ProfilePoint> profile = profile_of(mirror_pair(2, truth));
  symmetry_module().estimate_normals(profile, 0, profile.size());
  for (MirrorPlane plane :
       {truth, plane_at(38.5, 1.5), plane_at(36.0, 1.0),
        plane_through(1.3 * truth.normal_world, truth.normal_world + 0.03 * Vec3::UnitZ())}) {
    symmetry_module().refine_plane(profile, plane);
    EXPECT_LT(distance_m(plane, truth, {Vec3::Zero(), 5.0}), 0.02);
  }
}

TEST(FindSymmetry, AsksForTheConfiguredSupport) {
  const Blobs blobs = mirror_pair(1, plane_at(0.0, 0.0));
  EXPECT_FALSE(symmetry_of(blobs, {.enabled = false}).plane);
  const Symmetry symmetry = symmetry_of(blobs);
  ASSERT_TRUE(symmetry.plane);
  EXPECT_GE(symmetry.support, SymmetryConfig{}.min_support);
  // more than there can be
  const Symmetry declined = symmetry_of(blobs, {.min_support = 1.01});
  EXPECT_FALSE(declined.plane);
  EXPECT_EQ(declined.support, symmetry.support);
}

TEST(FindSymmetry, FindsNothingInPoorProfiles) {
  const auto line = [](int count, const Vec3f& step_m) {
    std::vector<Vec3f> points_m;
    for (int i = 0; i < count; ++i) {
      points_m.push_back(Vec3f(-5, -5, 3) + static_cast<float>(i) * step_m);
    }
    return points_m;
  };
  std::vector<Vec3f> wall;
  for (int i = 0; i < 60; ++i) {
    for (const Vec3f& p_m : line(60, Vec3f(0.1F, 0, 0))) {
      wall.push_back(p_m + static_cast<float>(i) * Vec3f(0, 0, 0.04F));
    }
  }
  std::vector<Vec3f> broken = line(100, Vec3f(0.1F, 0.05F, 0.0F));
  broken.push_back(Vec3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  broken.push_back(Vec3f::Constant(std::numeric_limits<float>::infinity()));
  broken.push_back(Vec3f(1e30F, -1e30F, 0.0F));
  const std::vector<std::vector<Vec3f>> profiles = {
      {},
      line(1, Vec3f::Zero()),
      line(10, Vec3f(0.1F, 0.2F, 0.1F)),
      line(3000, Vec3f::Zero()),  // all the same point
      line(100, Vec3f(0.1F, 0, 0)),
      broken,
  };
  for (const std::vector<Vec3f>& points_m : profiles) {
    const OccupancyGrid unknown({}, kBlobSpace);
    EXPECT_FALSE(find_symmetry({}, points_m, unknown).plane);
    std::vector<Vec3f> inside_m = points_m;
    std::erase_if(inside_m, [](const Vec3f& p) { return !kBlobSpace.contains(p.cast<double>()); });
    const OccupancyGrid known = measured_grid({}, inside_m, everywhere);
    EXPECT_FALSE(find_symmetry({}, points_m, known).plane) << points_m.size() << " points";
  }
  // a wall mirrors into itself in many planes, but must not break anything
  find_symmetry({}, wall, measured_grid({}, wall, everywhere));
}

/// A mirrored pair of which one arm has not been seen: no points, nothing known around it.
struct OneArmUnseen {
  MirrorPlane truth = plane_at(0.0, 0.0);
  Blobs blobs = mirror_pair(2, truth);
  std::vector<Vec3f> seen_m = surface_points_m(blobs, 0.12);
  std::vector<Vec3f> unseen_m = seen_m;
  OccupancyGrid grid = [this] {
    std::erase_if(seen_m, [](const Vec3f& p_m) { return !is_seen(p_m.cast<double>()); });
    std::erase_if(unseen_m, [](const Vec3f& p_m) { return is_seen(p_m.cast<double>()); });
    return measured_grid(blobs, seen_m, is_seen);
  }();

  static bool is_seen(const Vec3& p_m) { return p_m.x() > 0.0 || p_m.y() < -3.4; }
};

TEST(PredictSurface, MarksTheUnseenArmAndNothingMeasured) {
  OneArmUnseen scene;
  const OccupancyGrid before = scene.grid;
  const Symmetry symmetry = find_symmetry({}, scene.seen_m, scene.grid);
  expect_plane(symmetry, scene.truth);
  EXPECT_GT(predict_surface(symmetry, scene.grid), 0U);

  const GridGeometry& geometry = scene.grid.geometry();
  for (VoxelIndex v = 0; v < geometry.voxel_count(); ++v) {
    EXPECT_EQ(scene.grid.log_odds(v), before.log_odds(v));
    EXPECT_EQ(scene.grid.is_measured(v), before.is_measured(v));
    if (!scene.grid.is_predicted(v)) continue;
    EXPECT_FALSE(before.is_measured(v));
    // a plane within its tolerance, and half of a voxel's diagonal
    const Vec3 center_m = geometry.center_m(geometry.key_at(v));
    EXPECT_TRUE(is_inside(scene.blobs, center_m, 0.25));
    EXPECT_FALSE(is_inside(scene.blobs, center_m, -0.25));
  }
  std::size_t predicted = 0;
  for (const Vec3f& p_m : scene.unseen_m) {
    predicted += scene.grid.is_predicted(geometry.index_of(geometry.key_of(p_m)));
  }
  // the images of other points: some of their voxels are the neighbours
  EXPECT_GT(static_cast<double>(predicted), 0.9 * static_cast<double>(scene.unseen_m.size()));
  // and marks hold until the first measurement
  std::vector<VoxelIndex> marked;
  for (VoxelIndex v = 0; v < geometry.voxel_count(); ++v) {
    if (scene.grid.is_predicted(v)) marked.push_back(v);
  }
  scene.grid.apply({.free = {marked[0]}, .occupied = {marked[1]}});
  EXPECT_FALSE(scene.grid.is_predicted(marked[0]));
  EXPECT_FALSE(scene.grid.is_predicted(marked[1]));
  EXPECT_TRUE(scene.grid.is_predicted(marked[2]));
  EXPECT_EQ(scene.grid.predicted_count(), marked.size() - 2);
}

TEST(PredictSurface, CountsEachVoxelOnceAndLeavesTheOutsideAlone) {
  OccupancyGrid grid({}, Box3(Vec3(0, 0, 0), Vec3(2, 2, 2)));
  clear(grid, {voxel_at(grid, Vec3(1.5, 1.5, 1.5))});
  Symmetry symmetry;
  symmetry.mirrored_world_m = {{0.5F, 0.5F, 0.5F}, {0.51F, 0.5F, 0.5F}, {1.5F, 1.5F, 1.5F},
                               {1.1F, 0.5F, 0.5F}, {-0.1F, 0.5F, 0.5F}, {2.1F, 0.5F, 0.5F}};
  EXPECT_EQ(predict_surface(symmetry, grid), 2U);
  EXPECT_EQ(predict_surface(symmetry, grid), 2U);
}

}  // namespace
}  // namespace gnbv
