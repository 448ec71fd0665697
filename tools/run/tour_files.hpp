// What a tour meant to do and what for, each time it was made anew (plan.jsonl), and what each of
// its views promised and brought (predictions.csv): how anybody can see where its metres go.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/tour/gains.hpp"

namespace gnbv {

struct RunRecord;

/// The plan whose first view is, or was to be, that of an iteration.
struct MadePlan {
  std::size_t iteration = 0;
  TourPlan plan;
};

/// One JSON object a line and plan: `iteration`, the `tour` as poses in order (m, rad; the gimbal's
/// pitch unless it is 0), `cube_m`, and by source the `cubes` as lists of x, y, z of their centre
/// of mass (m) and the small voxels of planner.tour.detail_m that they can be expected to bring.
std::string plan_jsonl(std::span<const MadePlan> plans);

/// Throws BadInput naming file and line of whatever is damaged; for a run that is no tour's, or has
/// no such file, the command that makes one.
std::vector<MadePlan> read_plans(const RunRecord& record);

/// The plan that stands when a view has been taken.
struct StandingPlan {
  const MadePlan* made = nullptr;
  std::size_t next = 0;  // of its views: the first that is still to come

  std::span<const ViewPose> views() const { return std::span(made->plan.views).subspan(next); }
};

/// The last of the plans that was made by the time the vehicle leaves that view. Nothing before the
/// first of them. It refers to the plans.
std::optional<StandingPlan> standing_plan(std::span<const MadePlan> plans, const RunRecord& record,
                                          std::size_t iteration);

/// Of one view but the last; the look's kind and sums are GainOutcome's.
struct ViewOutcome {
  std::size_t iteration = 0;
  GainOutcome gain;
};

/// Columns: iteration, source (sampled, extrapolated, opposite, frontier), looks before (4: or
/// more), incidence_deg (lower bound of its bin), patches, and in small voxels of
/// planner.tour.detail_m: missing (expected to lack a point), promised, found.
std::string predictions_csv(std::span<const ViewOutcome> outcomes);

/// Throws BadInput naming file and line of whatever is damaged.
std::vector<ViewOutcome> read_predictions_csv(const std::filesystem::path& file);

}  // namespace gnbv
