// What a tour's planner did to come to its next view, for files and pictures.
#pragma once

#include <optional>
#include <vector>

#include "planner/tour/gain_calibration.hpp"
#include "planner/tour/tour_plan.hpp"

namespace gnbv {

struct TourNotes {
  std::vector<GainOutcome> outcomes = {};  // of the view before: what was predicted and found
  std::optional<TourPlan> plan = {};       // made anew, its next view among it; nothing: it goes on
};

}  // namespace gnbv
