// Maps to look at, for the tests of what a view sees.
#pragma once

#include <vector>

#include "planner/map/ray_walk.hpp"
#include "planner/view/visibility.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {

inline double scene_draw(std::uint64_t frame, std::uint64_t index) {
  return uniform01({11, Stream::bench, frame, index});
}

/// A map with all a view can meet, at random: free, unknown and occupied voxels, measured and not,
/// points, predictions, and shadows behind a wall of hits. Of one half most has been looked at so
/// often that it is settled.
struct RandomScene {
  Box3 object_bounds_m;
  OccupancyGrid grid{OccupancyConfig{}, Box3(Vec3(-5, -5, 0), Vec3(5, 5, 5)), object_bounds_m};
  SurfaceCloud cloud{CloudConfig{}, grid.geometry()};
  ShadowBand shadow{ShadowConfig{}, grid.geometry()};

  explicit RandomScene(const Box3& object_m = kEverywhere_m) : object_bounds_m(object_m) {
    for (std::uint64_t scan = 0; scan < 4; ++scan) {
      ScanUpdate update;
      for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
        const double u = scene_draw(20 + scan, v);
        if (u < 0.3) update.free.push_back(v);
        if (u > 0.997) update.occupied.push_back(v);
      }
      grid.apply(update);
    }
    settle_most_of_one_half();
    std::vector<Vec3f> points;
    FrameRays hits;
    for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
      if (scene_draw(45, v) < 0.01) grid.predict(v);
      if (grid.state(v) != VoxelState::occupied) continue;
      const Vec3 center_m = grid.geometry().center_m(grid.geometry().key_at(v));
      for (std::uint64_t i = 0; i < v % 4; ++i) {
        points.push_back(
            (center_m + Vec3::Constant(0.1 * scene_draw(40 + i, v) - 0.05)).cast<float>());
      }
      for (int a = 0; a < 3; ++a) hits.end_m[a].push_back(static_cast<float>(center_m[a]));
      hits.kind.push_back(PixelRay::hits);
    }
    cloud.add(points, 0.02);
    shadow.add(hits, grid);
  }

  void settle_most_of_one_half() {
    constexpr int kMisses = 5;  // to the lower bound, from wherever
    ScanUpdate update;
    for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
      const bool is_in_half = grid.geometry().center_m(grid.geometry().key_at(v)).y() < 0.0;
      if (!is_in_half || grid.state(v) == VoxelState::occupied) continue;
      if (scene_draw(46, v) < 0.99) update.free.push_back(v);
    }
    for (int miss = 0; miss < kMisses; ++miss) grid.apply(update);
  }

  static ViewPose pose(std::uint64_t i) {
    return {
        Vec3(scene_draw(30, i) * 9 - 4.5, scene_draw(31, i) * 9 - 4.5, scene_draw(32, i) * 4 + 0.7),
        scene_draw(33, i) * 6.28};
  }
};

/// A row of voxels along +x, 0.2 m each, and a camera of one ray in the middle of the first.
struct Corridor {
  explicit Corridor(int voxels, const OccupancyConfig& config = {})
      : grid(config, Box3(Vec3::Zero(), Vec3(0.2 * voxels, 0.2, 0.2))),
        cloud(CloudConfig{}, grid.geometry()),
        marks(grid.geometry().voxel_count()) {}

  void hit(VoxelIndex v) { grid.apply({.free = {}, .occupied = {v}}); }
  void miss(VoxelIndex v) { grid.apply({.free = {v}, .occupied = {}}); }

  static ViewRays one_ray(double range_m) {
    const CameraModel camera =
        make_camera_model({.fov_x_rad = 1e-3, .fov_y_rad = 1e-3, .range_max_m = range_m});
    return make_view_rays({&camera, 1}, 0.2);
  }
  /// Looks along +x from the first voxel, or along -x from the last.
  ViewStats look(double range_m, ViewOptions options = {.detail = ViewDetail::rays},
                 bool backwards = false) {
    const double last_m = grid.geometry().center_m(grid.geometry().size()[0] - 1);
    const ViewPose pose =
        backwards ? ViewPose{Vec3(last_m, 0.1, 0.1), kPi} : ViewPose{Vec3(0.1, 0.1, 0.1), 0.0};
    return evaluate_view(grid, cloud, one_ray(range_m), pose, marks, options);
  }

  OccupancyGrid grid;
  SurfaceCloud cloud;
  VisitMarks marks;
};

}  // namespace gnbv
