// The planner that thinks further than one view: a tour of all that still lacks points, flown a few
// views at a time and made anew (ours; the paper decides view by view).
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "planner/core/planner.hpp"
#include "planner/tour/look_ledger.hpp"
#include "planner/tour/tour_notes.hpp"
#include "planner/tour/tour_task.hpp"

namespace gnbv {

struct PlannerModel;

class TourPlanner final : public Planner {
 public:
  /// Keeps a reference to the model. `has_profile`: without one, it also looks for space unseen.
  TourPlanner(const TourConfig& config, const PlannerModel& model, bool has_profile);

  /// A plan of one view: the next of the tour, made anew where that is due. No view when none that
  /// can be flown to pays any more: then the end says whether some pay, but cannot be flown to.
  Plan next(const Belief& belief, const History& history, const ViewPose& current,
            Scratch& scratch) override;
  /// Plans anew: it learns from what the views brought.
  Plan replay(std::span<const Decision> recorded, const Belief& belief, const History& history,
              const ViewPose& current, Scratch& scratch) override;
  /// A tour knows itself when the map has nothing more to tell.
  EndRules end_rules() const override { return {.entropy = false, .repetition = false}; }

 private:
  TourScene scene(const Belief& belief) const;
  TourKnowledge knowledge() const;
  /// What a metre has to bring, in small voxels.
  double voxels_a_metre() const;
  void learn(const Belief& belief, int threads);
  void find_patches_now(const Belief& belief, int threads);
  void replan(const Belief& belief, const ViewPose& current, Scratch& scratch);
  void look_around(const Belief& belief, const ViewPose& current, int threads);
  bool search_tour();
  void search_at_lower_prices();
  bool explore(const Belief& belief, Scratch& scratch);
  bool take_view(const Belief& belief, const ViewPose& current, const ViewChecker& checker,
                 int threads, Plan& plan);
  std::optional<std::vector<Vec3>> way(const Belief& belief, const ViewPose& current,
                                       TourPlaces::Place to);

  const PlannerModel& model_;
  const TourConfig config_;
  const bool has_profile_;
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
  double price_factor_ = 1.0;  // halved while there is something left that does not pay
  std::uint64_t searches_ = 0;
  TourNotes notes_;  // of the call at hand
};

}  // namespace gnbv
