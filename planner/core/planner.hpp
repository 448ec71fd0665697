// The interface of every planner: from what is believed to the next views, or to the end.
#pragma once

#include <span>

#include "planner/core/belief.hpp"
#include "planner/core/history.hpp"
#include "planner/core/plan.hpp"
#include "planner/core/scratch.hpp"

namespace gnbv {

class Planner {
 public:
  virtual ~Planner() = default;

  /// Told once, before the first view: what the profile left, and where the views begin.
  virtual void begin(const Belief& /*profile*/, const ViewPose& /*start*/) {}

  /// The views to fly from `current`, in order, or why there is none. Asked again when all of them
  /// are taken. What a planner learns from the views since the last call is its own business. The
  /// same answer at any number of threads. Throws StopRequested when Scratch::should_stop asks it
  /// to.
  virtual Plan next(const Belief& belief, const History& history, const ViewPose& current,
                    Scratch& scratch) = 0;

  /// The same for a mission that is flown again: `recorded` are the decisions that follow, at least
  /// one. The first of them are the views of the plan. By default a plan of the first one, and
  /// nothing is planned; a planner that learns plans anew. Throws BadInput where that comes to
  /// another view than was recorded.
  virtual Plan replay(std::span<const Decision> recorded, const Belief& belief,
                      const History& history, const ViewPose& current, Scratch& scratch);

  /// Which rules end its missions; all by default.
  virtual EndRules end_rules() const { return {}; }
};

/// Throws BadInput: the view of that iteration, decided anew, is another than was recorded.
[[noreturn]] void refuse_another_view(std::size_t iteration);
/// Does so unless the plan's views begin as the recorded ones do. `iteration`: of the first.
void need_as_recorded(const Plan& plan, std::span<const Decision> recorded, std::size_t iteration);

}  // namespace gnbv
