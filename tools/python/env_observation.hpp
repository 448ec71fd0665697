// What an agent observes: the belief, as finite numbers of fixed shapes. Like belief_view.hpp it
// includes nothing but the planner.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "planner/config.hpp"
#include "planner/core/belief.hpp"

namespace gnbv {

constexpr std::array<std::size_t, 3> kCoarseCells = {8, 16, 16};  // z, y, x
constexpr std::size_t kCandidateFeatures = 8;

/// All in [-1, 1]; shares, logarithms and coordinates of the workspace.
struct EnvObservation {
  std::vector<float> map;          // 3 x kCoarseCells: shares of unknown, free and occupied voxels
  std::array<float, 5> pose{};     // x, y, z of the navigation box, sine and cosine of the yaw
  float entropy_left = 0.0F;       // share of that at first
  std::vector<double> views;       // candidates x 5, as ViewRows
  std::vector<std::uint8_t> mask;  // whether it may be flown to
  std::vector<float> candidates;   // x kCandidateFeatures; 0 where it may not
};

/// The map from above, by (y, x, 2): the height of the highest occupied voxel, as a share of the
/// map's, -1 where there is none, and the share of the column that is unknown.
std::vector<float> top_view(const OccupancyGrid& grid);

/// 2 x edge x edge x edge (z, y, x), of the map's voxels around that point: the probability of
/// occupied, 0.5 while unmeasured and outside of the map; the density of the cloud's points, as a
/// share of density_max().
std::vector<float> local_crop(const Belief& belief, const Vec3& at_world_m, int edge);

class EnvObserver {
 public:
  EnvObserver(const PlannerConfig& config, const PlannerModel& model, std::vector<double> scales)
      : config_(config), model_(model), scales_(std::move(scales)), scratch_(model_, 1) {}

  /// `first_entropy_nat` is what there was after the first view.
  EnvObservation observe(const Belief& belief, const ViewPose& current, double first_entropy_nat,
                         bool with_candidates);
  /// How many candidates there always are.
  std::size_t candidate_count() const;

 private:
  void add_candidates(const Belief& belief, const ViewPose& current, EnvObservation& out);

  const PlannerConfig config_;
  const PlannerModel model_;
  std::vector<double> scales_;
  Scratch scratch_;
};

}  // namespace gnbv
