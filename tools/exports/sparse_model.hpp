// The cloud of a run as structure from motion would leave it: points with colours, and the frames
// that show each of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/frames/frame_sight.hpp"

namespace gnbv {

struct Observation {
  std::uint32_t point = 0;  // into SparseModel::points_world_m
  double u_px = 0.0;        // the centre of the first pixel is at (0.5, 0.5)
  double v_px = 0.0;
};

struct SparseModel {
  std::vector<Vec3f> points_world_m;
  std::vector<Rgb8> colours;                           // of the nearest frame that shows the point
  std::vector<std::vector<Observation>> observations;  // by frame, points ascending

  std::size_t observation_count() const;
};

struct SparseModelOptions {
  std::size_t max_points = 100'000;
  double blur_m = 0.0;  // how far from the surface a point may lie: half a leaf of the cloud
  int threads = 1;      // no result depends on it
  ShareDone progress = [](double) {};
};

/// Every n-th point, n the least that keeps to max_points, as far as two frames show it.
SparseModel make_sparse_model(std::span<const Vec3f> points_world_m, const FrameRecord& frames,
                              const SparseModelOptions& options);

}  // namespace gnbv
