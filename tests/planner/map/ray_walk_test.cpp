#include "planner/map/ray_walk.hpp"

#include <gtest/gtest.h>

#include "bench/reference/octomap_twin.hpp"
#include "sim/core/error.hpp"
#include "tests/planner/map/random_points.hpp"

namespace gnbv {
namespace {

const Box3 kBox_m(Vec3(-4, -3, -1), Vec3(4, 3, 3));

std::vector<Key> walked(const GridGeometry& grid, const Vec3f& origin_m, const Vec3f& end_m) {
  std::vector<Key> keys;
  walk_ray(grid, origin_m, end_m, [&](const Key& key) {
    keys.push_back(key);
    return true;
  });
  return keys;
}

OctomapTwin twin_of(double resolution_m) {
  OccupancyConfig config;
  config.resolution_m = resolution_m;
  return OctomapTwin(config);
}

/// A point of the box with some coordinates moved onto a voxel border, or onto those of `other`.
Vec3f awkward_point(Random& random, double resolution_m, const Vec3f& other) {
  Vec3f p_m = random.point_in(Box3(kBox_m.min() - Vec3::Ones(), kBox_m.max() + Vec3::Ones()));
  for (int a = 0; a < 3; ++a) {
    const double kind = random.uniform(0.0, 1.0);
    if (kind < 0.15) {
      p_m[a] = static_cast<float>(std::round(p_m[a] / resolution_m) * resolution_m);
    } else if (kind < 0.3) {
      p_m[a] = other[a];
    }
  }
  return p_m;
}

TEST(RayWalk, NamesTheVoxelsOfComputeRayKeysInOrder) {
  for (const double resolution_m : {0.2, 0.07, 0.05}) {
    const GridGeometry grid(kBox_m, resolution_m);
    const OctomapTwin twin = twin_of(resolution_m);
    Random random(17);
    for (int ray = 0; ray < 40000; ++ray) {
      const Vec3f origin_m = awkward_point(random, resolution_m, Vec3f::Zero());
      const Vec3f end_m = awkward_point(random, resolution_m, origin_m);
      ASSERT_EQ(walked(grid, origin_m, end_m), twin.ray_keys(origin_m, end_m))
          << "resolution " << resolution_m << ", ray " << ray << ", " << origin_m.transpose()
          << " to " << end_m.transpose();
    }
  }
}

TEST(RayWalk, AlongAnAxisVisitsEveryVoxelOnceWithoutTheLast) {
  const GridGeometry grid(kBox_m, 0.2);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) {
      Vec3f end_m(0.1F, 0.1F, 0.1F);
      end_m[axis] += sign * 1.0F;  // five voxels on
      const std::vector<Key> keys = walked(grid, Vec3f(0.1F, 0.1F, 0.1F), end_m);
      ASSERT_EQ(keys.size(), 5U);
      for (std::size_t i = 0; i < keys.size(); ++i) {
        Key expected = {0, 0, 0};
        expected[static_cast<std::size_t>(axis)] = static_cast<int>(sign) * static_cast<int>(i);
        EXPECT_EQ(keys[i], expected);
      }
    }
  }
}

TEST(RayWalk, StopsWhenTheVisitorSaysSo) {
  const GridGeometry grid(kBox_m, 0.2);
  int visits = 0;
  walk_ray(grid, Vec3f(-3.0F, 0.0F, 0.0F), Vec3f(3.0F, 0.0F, 0.0F),
           [&](const Key&) { return ++visits < 4; });
  EXPECT_EQ(visits, 4);
}

TEST(RayWalk, InsideOneVoxelVisitsNothing) {
  const GridGeometry grid(kBox_m, 0.2);
  EXPECT_TRUE(walked(grid, Vec3f(0.01F, 0.01F, 0.01F), Vec3f(0.19F, 0.19F, 0.19F)).empty());
}

TEST(RayWalk, EndsThatFloat32CannotTellApartTakeNoStep) {
  const GridGeometry grid(kBox_m, 0.2);
  // the squared length underflows to zero; OctoMap divides by it
  EXPECT_LE(walked(grid, Vec3f(-1e-30F, -1e-30F, 0.0F), Vec3f(1e-30F, 1e-30F, 0.0F)).size(), 1U);
}

TEST(GridGeometry, IndexAndKeyAreInverse) {
  const GridGeometry grid(Box3(Vec3(-1, 0.4, -2), Vec3(0.6, 1, -1.2)), 0.2);
  EXPECT_EQ(grid.voxel_count(), 8U * 3U * 4U);
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    ASSERT_TRUE(grid.contains(grid.key_at(v)));
    ASSERT_EQ(grid.index_of(grid.key_at(v)), v);
    ASSERT_EQ(grid.key_of(grid.center_m(grid.key_at(v))), grid.key_at(v));
  }
}

TEST(GridGeometry, ContainsNothingBeyondItsBoundsNorNan) {
  const GridGeometry grid(kBox_m, 0.2);
  EXPECT_EQ(grid.size(), (Key{40, 30, 20}));
  const Vec3 inside_m(0.1, 0.1, 0.1);
  for (int a = 0; a < 3; ++a) {
    for (const double bad : {-4.01, 4.01, 1e300, -1e300, std::nan(""), HUGE_VAL, -HUGE_VAL}) {
      Vec3 p_m = inside_m;
      p_m[a] = bad;
      EXPECT_FALSE(grid.contains(grid.key_of(p_m))) << "axis " << a << ", " << bad;
    }
  }
}

TEST(GridGeometry, RefusesWhatItCannotHold) {
  EXPECT_THROW(GridGeometry(kBox_m, 0.0), BadInput);
  EXPECT_THROW(GridGeometry(kBox_m, std::nan("")), BadInput);
  EXPECT_THROW(GridGeometry(Box3(Vec3(0, 0, 0), Vec3(1, 0, 1)), 0.1), BadInput);
  EXPECT_THROW(GridGeometry(Box3(Vec3(0, 0, 0), Vec3(4000, 1, 1)), 0.1), BadInput);
  EXPECT_THROW(GridGeometry(Box3(Vec3(0, 0, 0), Vec3(2000, 2000, 200)), 0.1), BadInput);
}

}  // namespace
}  // namespace gnbv
