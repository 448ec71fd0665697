// What a tour means to do and what for, so that people can see why.
#pragma once

#include <span>
#include <vector>

#include "planner/tour/gain_calibration.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// Patches of one source whose targets lie in one cube of the world's lattice.
struct PatchCube {
  PatchSource source = PatchSource::sampled;
  Vec3 p_world_m = Vec3::Zero();  // centre of mass of what they can be expected to bring
  double expected = 0.0;  // of the small voxels they lack, those that observations can bring
};

struct TourPlan {
  std::vector<ViewPose> views;  // in the order of the tour
  double cube_m = 0.0;          // edge of the cubes
  std::vector<PatchCube> cubes;
};

/// All patches that can be expected to bring something when seen face on, by source and place, in
/// cubes of kLeastCube_m, or twice, four times ... that, so that there are at most kMostCubes.
TourPlan make_tour_plan(std::vector<ViewPose> views, std::span<const Patch> patches,
                        const ObservationYield& yield);
constexpr double kLeastCube_m = 0.25;
constexpr std::size_t kMostCubes = 3000;

}  // namespace gnbv
