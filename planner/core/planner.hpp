// The interface of every planner: from what is believed to the next views, or to the end. What it
// looks back on, and the rules that end its missions (paper section 2.6).
#pragma once

#include <functional>
#include <span>
#include <variant>

#include "planner/core/belief.hpp"
#include "planner/core/plan.hpp"

namespace gnbv {

/// What repeats when the vehicle goes back and forth: places, or the utilities of its views at lag
/// 2 (the authors' code).
enum class RepeatedBy { places, utilities };

/// Defaults: Table 1 with the released window; max_iterations is the paper's longest aircraft run.
/// What the paper does not have is off. Zero switches a rule off.
struct TerminationConfig {
  int max_iterations = 635;
  double entropy_change_percent = 0.001;  // |E_n - E_n-1| of the mean of both, in each view ...
  int entropy_window = 5;                 // ... of so many in a row
  int repeated_moves = 10;                // back and forth, in a row
  RepeatedBy repeated_by = RepeatedBy::utilities;
  bool within_plans = true;              // a plan of several views may end before its last one
  double max_distance_m = 0.0;           // planned, from the first view on
  double max_flight_time_s = 0.0;        // simulated, since the mission began
  double min_new_voxels_per_m = 0.0;     // newly occupied, a planned metre, over the ...
  int new_voxels_window = 10;            // ... last views; those that only turn end nothing
  int max_views_without_new_points = 0;  // in a row
};

/// Which of the rules that read the belief end a mission; its planner says.
struct EndRules {
  bool entropy = true;     // entropy_change_percent
  bool gain = true;        // min_new_voxels_per_m, max_views_without_new_points
  bool repetition = true;  // repeated_moves
};

/// What is believed after a view, as far as the rules read it.
struct MapProgress {
  std::size_t occupied_voxels = 0;  // of the map
  std::size_t cloud_points = 0;     // one a leaf
  double straight_m = 0.0;          // planned, from the first view on
};

/// What was decided so far, and what it brought; oldest first.
struct History {
  std::vector<Decision> decisions = {};    // flown
  std::vector<double> entropies_nat = {};  // total; first: before the first depth return
  std::vector<MapProgress> progress = {};  // after each view
  std::vector<Decision> ahead = {};        // of the plan at hand, not flown yet; the next one last
};

/// Begins the history: what is believed before the first view.
void remember_start(const Belief& belief, History& history);
/// Adds a view that was taken, with what is believed after it. `straight_m`: planned_m() to it.
void remember(const Decision& taken, const Belief& belief, double straight_m, History& history);

/// The planned way from the first view on, with the leg from here to the next one.
double planned_m(const History& history, const Vec3& from_world_m, const Decision& next);

/// The last views, so many at most.
std::vector<ViewPose> recent_views(const History& history, int count);

/// Whether the vehicle goes back and forth. `places`: each of the last `moves` moves only undoes
/// the one before, so that the position is that of two views ago (within a centimetre), and another
/// than that of the view before. `utilities`: of the last `moves` views, more than which were
/// taken, each has a utility, that of the one two before it (NBVHistory::isRepeatingMotions).
/// 0 moves: never.
bool is_back_and_forth(RepeatedBy repeated_by, std::span<const Decision> decisions, int moves);

/// The first of the rules that ends the mission after a view, in the order of Termination.
std::optional<Termination> end_after_view(const TerminationConfig& config, const EndRules& rules,
                                          const History& history);

/// The view that is flown next, taken from the plan at hand or from a new one. Or why there is
/// none: what the new plan says, or max_distance.
std::variant<Decision, Termination> next_decision(const TerminationConfig& config,
                                                  const ViewPose& current, History& history,
                                                  const std::function<Plan()>& make_plan);

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

/// Throws BadInput unless the plan's views begin as the recorded ones do. `iteration`: of the
/// first.
void need_as_recorded(const Plan& plan, std::span<const Decision> recorded, std::size_t iteration);

}  // namespace gnbv
