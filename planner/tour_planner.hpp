// The planner that thinks further than one view: a tour of all that still lacks points, flown a few
// views at a time (ours; the paper decides view by view).
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "planner/decision.hpp"
#include "planner/tour/catalogue.hpp"
#include "planner/tour/prize_tour.hpp"
#include "planner/tour/success.hpp"

namespace gnbv {

struct Belief;
struct History;
struct PlannerModel;

constexpr std::string_view kTourName = "tour";
inline bool is_tour(std::string_view utility_name) { return utility_name == kTourName; }

/// What a view promised of one kind of patch, and what it brought.
struct LookOutcome {
  PatchSource source = PatchSource::sampled;
  std::size_t looks = 0;      // before, the last bin for that many or more
  std::size_t incidence = 0;  // incidence_bin()
  int patches = 0;
  double missing = 0.0;   // small voxels expected to lack a point
  double promised = 0.0;  // of them, by what was learned so far
  double found = 0.0;
};

class TourPlanner {
 public:
  /// Keeps a reference to the model.
  explicit TourPlanner(const PlannerModel& model);

  /// The next view of the tour, made anew where that is due. Has to be asked after every view, of
  /// replayed ones, too: it learns from what they brought. `next` is empty and is_complete set when
  /// no view pays any more.
  Plan next(const Belief& belief, const History& history, const ViewPose& current, int threads);

  /// Of the view before the last call of next(): what it promised and brought, by kind.
  std::span<const LookOutcome> outcomes() const { return outcomes_; }

 private:
  struct Promise {
    PatchId patch = 0;
    PatchSource source = PatchSource::sampled;
    std::uint8_t looks = 0, incidence = 0;
    float missing = 0.0F;
    float promised = 0.0F;
    std::uint64_t before = 0;  // voxels of the cell that held a point
  };
  struct TourView {
    TourPlaces::Place place;
    ViewPose pose;
  };
  TourScene scene(const Belief& belief) const;
  void digest(const Belief& belief, int threads);
  void learn();
  void replan(const Belief& belief, const ViewPose& current, int threads);
  PrizeTask make_task(std::vector<TourView>& views) const;
  bool add_surface_places(const Belief& belief);
  std::optional<std::vector<Vec3>> way(const Belief& belief, const ViewPose& current,
                                       TourPlaces::Place to);
  void promise(const Belief& belief, const ViewPose& view);

  const PlannerModel& model_;
  const TourConfig& config_;
  SurfaceCells cells_;
  OpenSpace space_;
  TourPlaces places_;
  ViewCatalogue catalogue_;
  LookSuccess success_;
  std::vector<Patch> patches_;
  std::size_t points_taken_ = 0;
  std::vector<TourView> tour_;  // what is left of it, in order
  TourPlaces::Place at_ = TourPlaces::here();
  int views_since_replan_ = 0;
  bool is_disappointed_ = true;  // the tour has to be made anew
  double price_factor_ = 1.0;
  std::set<Key> tried_;  // cubes whose patches places were looked for
  std::uint64_t replans_ = 0;
  std::vector<Promise> promises_;  // of the view under way
  std::vector<LookOutcome> outcomes_;
};

}  // namespace gnbv
