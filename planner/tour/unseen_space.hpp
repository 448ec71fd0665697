// Where to look when nothing is known to be missing: at space that nobody has seen.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "sim/core/pose.hpp"

namespace gnbv {

struct Belief;
struct PlannerModel;
struct Scratch;

/// Of the views that which sees the most unknown voxels per metre of its way, the first of equals;
/// `way_m`: to each. Nothing when none sees a fiftieth of what the cameras' frusta hold. The same
/// at any number of threads.
std::optional<std::size_t> most_unseen(const PlannerModel& model, const Belief& belief,
                                       std::span<const ViewPose> views,
                                       std::span<const double> way_m, Scratch& scratch);

}  // namespace gnbv
