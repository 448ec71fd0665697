// Planners whose views are laid out beforehand or come from outside: which of them comes next.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "planner/core/planner.hpp"

namespace gnbv {

constexpr std::size_t kMostUserViews = 100000;
constexpr int kMostLaidViews = 10'000;  // ordering them takes the square of it

struct RouteConfig {
  double standoff_m = 4.0;  // from the occupied voxels of the profile: half of the cameras' range
  double overlap = 0.3;     // lawnmower: of neighbouring images
  std::vector<ViewPose> views = {};  // route: body poses, in the order in which they are flown
};

struct OracleConfig {
  double coverage = 0.0;  // that its views are to reach, of the finest voxels; 0: nearly all
  std::uint64_t search_seed = 0;  // of what its search leaves to chance
};

// Baselines that lay all their views at once around what the map of the profile holds, and ask no
// utility: what a planner that decides view by view has to beat. Views in the order in which they
// are flown from `start`; none where nothing is occupied. A gimbal looks at what the view does.

/// At most `count` views, kMostLaidViews at most, in directions spread evenly over the upper half
/// space, each where a line from the structure's centre comes out of its surroundings. It looks at
/// the centre.
std::vector<ViewPose> lay_hemisphere(const RouteConfig& config, const PlannerModel& model,
                                     const OccupancyGrid& map, const ViewPose& start, int count);

/// Rows back and forth on four sides, looking level, and above, looking down, as far apart as the
/// first camera's footprint allows. Throws BadInput when it would need more than kMostLaidViews.
std::vector<ViewPose> lay_lawnmower(const RouteConfig& config, const PlannerModel& model,
                                    const OccupancyGrid& map, const ViewPose& start, int count);

/// One more view from outside; nothing: there are no more.
using NextView = std::function<std::optional<ViewPose>()>;
/// Told of a view that cannot be flown to, by its index.
using OnRefused = std::function<void(std::size_t index, Rejection)>;

/// Where the views of a route come from.
struct Route {
  std::vector<ViewPose> views = {};
  /// Lays them when it gets the profile's map.
  std::function<std::vector<ViewPose>(const OccupancyGrid& map, const ViewPose& start)> lay = {};
  NextView next_view = {};  // after the views
  OnRefused on_refused = {};
  bool trusts_record = false;  // flown again without `next_view`, its views are the recorded ones
};

constexpr EndRules kToTheEnd = {.entropy = false, .gain = false, .repetition = false};

/// Flies the views in their order. What blocks the straight way is flown around, and what cannot be
/// flown to is passed over; of a route that was laid, also what was flown to lately: a user who
/// gives a view twice wants it twice. A mission that is flown again decides anew, and what it
/// decides has to be what it did.
class RoutePlanner final : public Planner {
 public:
  /// Keeps a reference to the model.
  RoutePlanner(Route route, const PlannerModel& model) : route_(std::move(route)), model_(model) {}

  void begin(const Belief& profile, const ViewPose& start) override;
  Plan next(const Belief& belief, const History& history, const ViewPose& current,
            Scratch& scratch) override;
  Plan replay(std::span<const Decision> recorded, const Belief& belief, const History& history,
              const ViewPose& current, Scratch& scratch) override;
  EndRules end_rules() const override { return route_.lay ? EndRules{} : kToTheEnd; }

 private:
  Plan first_valid(const Belief& belief, const History& history, const ViewPose& current,
                   Scratch& scratch);
  void try_known(const Belief& belief, const History& history, const ViewPose& current,
                 const Scratch& scratch, Plan& plan);

  Route route_;
  std::size_t tried_ = 0;  // of its views
  const PlannerModel& model_;
};

/// The next views of who knows the structure, from where the last of them was taken; none: the
/// cloud holds enough.
using KnownRoute =
    std::function<std::vector<Decision>(const SurfaceCloud& cloud, const HeedStop& stop)>;

/// Flies decisions that somebody makes who knows the structure, and checks none of them. Asks for
/// more when all are flown. A mission that is flown again decides anew.
class KnownRoutePlanner final : public Planner {
 public:
  explicit KnownRoutePlanner(KnownRoute route) : route_(std::move(route)) {}

  Plan next(const Belief& belief, const History& history, const ViewPose& current,
            Scratch& scratch) override;
  Plan replay(std::span<const Decision> recorded, const Belief& belief, const History& history,
              const ViewPose& current, Scratch& scratch) override;
  EndRules end_rules() const override { return kToTheEnd; }

 private:
  KnownRoute route_;
  std::vector<Decision> ahead_;  // the next one last
};

}  // namespace gnbv
