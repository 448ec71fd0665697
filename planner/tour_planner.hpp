// The planner that thinks further than one view: a tour of all that still lacks points, flown a few
// views at a time and made anew (ours; the paper decides view by view).
#pragma once

#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "planner/decision.hpp"
#include "planner/tour/look_ledger.hpp"
#include "planner/tour/tour_plan.hpp"
#include "planner/tour/tour_task.hpp"

namespace gnbv {

struct Belief;
struct History;
struct PlannerModel;
struct Workbench;

constexpr std::string_view kTourName = "tour";
inline bool is_tour(std::string_view utility_name) { return utility_name == kTourName; }

class TourPlanner {
 public:
  /// Keeps a reference to the model.
  explicit TourPlanner(const PlannerModel& model);

  /// The next view of the tour, made anew where that is due. Has to be asked after every view, of a
  /// replayed mission, too: it learns from what they brought. `next` is empty when no view that
  /// can be flown to pays any more. The same at any number of threads.
  Plan next(const Belief& belief, const History& history, const ViewPose& current,
            Workbench& bench);

  /// Whether the last next() found no view because none pays, not because none can be flown to.
  bool is_complete() const { return is_complete_; }

  /// Of the view before the last call of next(): what it promised and brought, by kind.
  std::span<const LookOutcome> outcomes() const { return ledger_.outcomes(); }

  /// The tour as the last call of next() made it anew, its next view still among it; nothing where
  /// the one before goes on.
  const std::optional<TourPlan>& plan() const { return plan_; }

 private:
  TourScene scene(const Belief& belief) const;
  TourKnowledge knowledge() const;
  /// What a metre has to bring, in small voxels.
  double voxels_a_metre() const;
  void learn(const Belief& belief, int threads);
  void find_patches_now(const Belief& belief, int threads);
  void replan(const Belief& belief, const ViewPose& current, Workbench& bench);
  void look_around(const Belief& belief, const ViewPose& current, int threads);
  bool search_tour();
  void search_at_lower_prices();
  bool explore(const Belief& belief, Workbench& bench);
  bool take_view(const Belief& belief, const ViewPose& current, const ViewChecker& checker,
                 int threads, Plan& plan);
  std::optional<std::vector<Vec3>> way(const Belief& belief, const ViewPose& current,
                                       TourPlaces::Place to);

  const PlannerModel& model_;
  const TourConfig& config_;
  SurfaceCells cells_;
  std::vector<CameraModel> cameras_;  // at each pitch of their gimbal
  OpenSpace space_;
  TourPlaces places_;
  ViewCatalogue catalogue_;
  LookLedger ledger_;
  std::vector<Patch> patches_;
  std::size_t points_taken_ = 0;               // of the cloud
  std::set<Key> tried_;                        // cubes for which places were looked for
  std::vector<TourView> tour_;                 // what is left of it, in order
  std::vector<ViewPose> refused_;              // taken lately, or found to be out of reach now
  TourPlaces::Place at_ = TourPlaces::here();  // where the last view was taken
  int views_since_replan_ = 0;
  bool is_due_ = true;         // the tour has to be made anew
  bool is_complete_ = false;   // no view paid, and none had to be refused
  double price_factor_ = 1.0;  // halved while there is something left that does not pay
  std::uint64_t searches_ = 0;
  std::optional<TourPlan> plan_;
};

}  // namespace gnbv
