// Memory to work in, kept from view to view, and whether somebody wants the work to stop. No result
// depends on what it holds.
#pragma once

#include <exception>
#include <functional>
#include <vector>

#include "planner/map/frontiers.hpp"
#include "planner/map/scan_insertion.hpp"
#include "planner/view/visibility.hpp"

namespace gnbv {

struct PlannerModel;

/// Thrown out of a planner that was asked to stop in the middle of its work.
class StopRequested : public std::exception {
 public:
  const char* what() const noexcept override { return "asked to stop"; }
};

struct Scratch {
  Scratch(const PlannerModel& model, int thread_count);

  int threads;
  std::function<bool()> should_stop;  // none: nobody asks; any thread may call it
  ScanInserter inserter;
  std::vector<FrameRays> frame_rays;  // of the view at hand
  std::vector<VisitMarks> marks;      // one a thread
  FrontierMarks frontier_marks;

  /// For loops that may take long, several times a second. Throws StopRequested.
  void heed_stop() const {
    if (should_stop && should_stop()) throw StopRequested();
  }
};

}  // namespace gnbv
