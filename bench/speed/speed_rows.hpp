// The rows of the speed table, each ours against a reference, on the same input, in the same run;
// and what they are measured with.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

struct SpeedRow {
  std::string name = {};
  double ours = 0.0;
  double reference = 0.0;                // the paper's way
  std::optional<double> competent = {};  // the way of somebody who knows the libraries
  std::string unit = {};                 // of all
  bool identical = false;                // whether all gave the answers they owe
  double target = 0.0;                   // the ratio aimed for; 0: none
  bool is_limit = false;                 // the ratio is to stay below the target instead of above
};

/// How many times as fast ours is as the reference; with is_limit how many times as slow.
double ratio(const SpeedRow& row);
/// The same over the competent way; nothing without one.
std::optional<double> competent_ratio(const SpeedRow& row);
/// Whether the answers are right and the ratio is what was aimed for.
bool is_met(const SpeedRow& row);

/// Depth frames into the map. Medians over the frames of the thread's CPU time, ms, of the best,
/// the AVX2 and the baseline level. Ours is everything from the depths to the updated grid; the
/// reference is plain insertPointCloud with the cloud ready, and the competent way OctoMap's own
/// faster one: one ray a voxel that was hit (discretize, hence another map:
/// twins_test.cpp says which) and inner nodes left alone (lazy_eval). Identical: every
/// voxel's log-odds, bit for bit, after all frames, against OctoMap's rule ray by ray, and against
/// insertPointCloud itself on the same frames with each pixel without a return made a hit at
/// maximum range. Takes some 10 s.
std::vector<SpeedRow> map_speed();

/// Rows, in thread CPU time on one thread:
/// - candidate: one candidate (two cameras of 47 x 34 rays) at the best level this processor has,
///   against the paper's way on an octomap::OcTree, and beside it the competent one
///   (KeysetViewTwin);
/// - candidate_avx2, candidate_baseline: the same at that level, if the processor has it;
/// - all_utilities_over_one: `ours` is what the metrics of all utilities cost and scoring them all,
///   `reference` what one utility of voxel counts costs; the ratio is to stay below its target.
/// `identical`: summed over candidates, the unique counts differ from those of OctoMap's exact walk
/// by no more than 1e-5 of the voxels, and those of the key sets by none.
std::vector<SpeedRow> view_speed();

/// Row "leaf_filter_and_density": adding the frames of one view (two cameras, 640 x 480, leaf
/// 0.02 m, voxel 0.2 m) to a cloud of more than a million points of the built-in aircraft; median
/// thread CPU time. The reference: pcl::VoxelGrid of the frames' points, a kd-tree of the whole
/// cloud, and the neighbour counts of every point in the voxels that received points. Its clouds
/// are PCL's before the clock runs, and it is told which voxels those are. The competent way:
/// KdDensityTwin, from the hits on. Identical: the number of leaves; for PCL, point_count and
/// neighbour_sum of the voxels that received points; for the competent way, those of every voxel.
std::vector<SpeedRow> cloud_speed();

/// The paper's workspace and floor rule.
inline const Box3 kWorkspace_m(Vec3(-20, -20, 0), Vec3(20, 20, 20));
constexpr double kFloor_m = 0.3;

/// Processor time of the calling thread.
double thread_time_ms();

/// What the task took of it.
template <typename Task>
double time_ms(Task&& task) {
  const double start_ms = thread_time_ms();
  task();
  return thread_time_ms() - start_ms;
}

/// The upper one of two middle values. Requires a value.
double median(std::vector<double> values);

/// The paper's pair: one camera looks down by 20 degrees, the other up.
std::array<CameraModel, 2> camera_pair();

/// 640 x 480, 60 x 45 deg, 8 m, looking 20 deg down.
const CameraModel& circle_camera();
/// 16 frames on a circle around the scene of analytic_scans.hpp, looking inwards.
const std::vector<DepthFrame>& circle_frames();

}  // namespace gnbv
