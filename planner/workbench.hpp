// Memory to work in, kept from view to view. No result depends on what it holds.
#pragma once

#include <vector>

#include "planner/map/frontiers.hpp"
#include "planner/map/scan_insertion.hpp"
#include "planner/view/visibility.hpp"

namespace gnbv {

struct PlannerModel;

struct Workbench {
  Workbench(const PlannerModel& model, int thread_count);

  int threads;
  ScanInserter inserter;
  std::vector<FrameRays> frame_rays;  // of the view at hand
  std::vector<VisitMarks> marks;      // one a thread
  FrontierMarks frontier_marks;
};

}  // namespace gnbv
