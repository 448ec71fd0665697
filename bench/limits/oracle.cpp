#include "bench/limits/oracle.hpp"

#include <algorithm>
#include <cmath>

#include "bench/limits/ceiling_cache.hpp"
#include "bench/limits/cloud_of_views.hpp"
#include "bench/limits/lattice_ways.hpp"
#include "bench/limits/set_cover.hpp"
#include "bench/limits/tour.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr int kKicks = 2000;

/// The places of the tour so far, the start first, with guessed distances between them.
class GrowingTour {
 public:
  GrowingTour(LatticeWays& ways, int threads) : ways_(ways), threads_(threads) {
    append(ways.start());
  }

  const std::vector<std::size_t>& places() const { return places_; }
  const std::vector<std::size_t>& tour() const { return tour_; }

  Insertion insertion(std::size_t place) const {
    std::vector<double> to_m;
    for (const std::size_t stop : tour_) to_m.push_back(ways_.guess_m(places_[stop], place));
    return cheapest_insertion(to_m, leg_m_);
  }

  /// Metres that views at each of the places would add: nothing where the tour stops already.
  std::vector<double> extra_m(std::span<const std::size_t> places) const {
    std::vector<double> extra_m(places.size());
    parallel_for(threads_, places.size(), [&](std::size_t i) {
      extra_m[i] = is_stop(places[i]) ? 0.0 : std::max(0.0, insertion(places[i]).extra_m);
    });
    return extra_m;
  }

  void add(std::size_t place) {
    if (is_stop(place)) return;
    const std::size_t at = insertion(place).at;
    append(place);
    std::rotate(tour_.begin() + static_cast<std::ptrdiff_t>(at), tour_.end() - 1, tour_.end());
    improve_tour(guess_m_, tour_);
    leg_m_.clear();
    for (std::size_t i = 1; i < tour_.size(); ++i) {
      leg_m_.push_back(guess_m_[tour_[i - 1]][tour_[i]]);
    }
  }

 private:
  bool is_stop(std::size_t place) const {
    return std::find(places_.begin(), places_.end(), place) != places_.end();
  }
  void append(std::size_t place) {
    ways_.prepare({place}, 1);
    tour_.push_back(places_.size());
    places_.push_back(place);
    std::vector<double> row_m;
    for (const std::size_t other : places_) row_m.push_back(ways_.guess_m(place, other));
    for (std::size_t i = 0; i + 1 < places_.size(); ++i) guess_m_[i].push_back(row_m[i]);
    guess_m_.push_back(std::move(row_m));
  }

  LatticeWays& ways_;
  int threads_;
  std::vector<std::size_t> places_;
  std::vector<std::size_t> tour_;  // indices into places_
  Distances guess_m_;              // between places_
  std::vector<double> leg_m_;      // along the tour
};

/// What the oracle knows, and one run of it.
class Oracle {
 public:
  Oracle(const Scenario& scenario, const RayScene& scene, const LegalViewpoints& legal,
         const SurfaceReference& reference, const ViewSurvey& survey, const ViewPose& start,
         int threads)
      : scenario_(scenario),
        scene_(scene),
        legal_(legal),
        reference_(reference),
        survey_(survey),
        start_(start),
        threads_(threads),
        cameras_(exact_cameras(scenario)),
        ways_(scene, legal, scenario.planner.validity.collision_radius_m) {}

  std::vector<Decision> plan(OracleAim aim) {
    GrowingTour growing(ways_, threads_);
    const std::vector<std::size_t> chosen = choose(aim, growing);
    std::vector<std::size_t> places;
    for (const std::size_t stop : growing.tour()) places.push_back(growing.places()[stop]);
    return decisions(chosen, shortened(places));
  }

 private:
  std::span<const FrameRays> take(const ViewPose& view) {
    take_view(scene_, cameras_, view, scenario_.planner.floor_z_m, threads_, rays_);
    return rays_;
  }

  /// Views of the survey in the order of choice; `tour` gets their places.
  std::vector<std::size_t> choose(OracleAim aim, GrowingTour& tour) {
    std::vector<const std::vector<std::uint32_t>*> finds;
    std::vector<std::size_t> places;
    for (const SurveyedView& view : survey_.views) {
      finds.push_back(&view.finds);
      places.push_back(view.position);
    }
    const VoxelSet& voxels = reference_.outside[0];
    const double wanted =
        kOracleShare * survey_.leaf_outside[0] * static_cast<double>(voxels.size());
    LazyGreedy greedy(finds, voxels.size());
    CloudOfViews cloud(scenario_, voxels);
    cloud.add(take(start_));
    start_finds_ = finds_alone(voxels, rays_, scenario_.planner.cloud.leaf_m);
    greedy.take(start_finds_);
    std::vector<std::size_t> chosen;
    std::vector<double> costs(finds.size(), 1.0);
    while (static_cast<double>(cloud.found()) < wanted) {
      if (aim == OracleAim::metres) {
        costs = tour.extra_m(places);
        for (double& cost : costs) cost += kMetresPerView;
      }
      const auto next = greedy.best(costs);
      if (!next) break;
      greedy.take(survey_.views[*next].finds);
      cloud.add(take(pose_of(legal_, survey_.views[*next])));
      tour.add(places[*next]);
      chosen.push_back(*next);
    }
    return chosen;
  }

  /// The places, of which the first stays, in the order of a short tour.
  std::vector<std::size_t> shortened(const std::vector<std::size_t>& places) const {
    Distances distance_m(places.size(), std::vector<double>(places.size(), 0.0));
    parallel_for(threads_, places.size(), [&](std::size_t i) {
      for (std::size_t j = 0; j < i; ++j) distance_m[i][j] = ways_.distance_m(places[i], places[j]);
    });
    std::vector<std::size_t> tour;
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) distance_m[j][i] = distance_m[i][j];
      tour.push_back(i);
    }
    improve_tour_with_kicks(distance_m, tour, kKicks);
    std::vector<std::size_t> out;
    for (const std::size_t stop : tour) out.push_back(places[stop]);
    return out;
  }

  /// The chosen views of a place, turning on from `yaw_rad` to the left.
  std::vector<std::size_t> views_at(std::size_t place, std::span<const std::size_t> chosen,
                                    double yaw_rad) const {
    std::vector<std::size_t> views;
    for (const std::size_t view : chosen) {
      if (survey_.views[view].position == place) views.push_back(view);
    }
    const auto turn_rad = [&](std::size_t view) {
      constexpr double kRounding_rad = 1e-9;
      const double turn = survey_.views[view].yaw_rad - yaw_rad + kRounding_rad;
      return turn - 2.0 * kPi * std::floor(turn / (2.0 * kPi));
    };
    std::sort(views.begin(), views.end(),
              [&](std::size_t a, std::size_t b) { return turn_rad(a) < turn_rad(b); });
    return views;
  }

  std::vector<Decision> decisions(std::span<const std::size_t> chosen,
                                  std::span<const std::size_t> places) const {
    LazyGreedy found({}, reference_.outside[0].size());
    found.take(start_finds_);
    std::vector<Decision> route;
    double yaw_rad = start_.yaw_rad;
    for (std::size_t i = 1; i < places.size(); ++i) {
      std::vector<Vec3> via_m = ways_.way(places[i - 1], places[i]).via_world_m;
      for (const std::size_t view : views_at(places[i], chosen, yaw_rad)) {
        const SurveyedView& surveyed = survey_.views[view];
        const auto gain = static_cast<double>(found.take(surveyed.finds));
        const int views = static_cast<int>(survey_.views.size());
        route.push_back({.view = pose_of(legal_, surveyed),
                         .sampler = "oracle",
                         .candidates = views,
                         .valid = views,
                         .score = {.value = gain, .information = gain},
                         .via_world_m = std::move(via_m)});
        via_m = {};
        yaw_rad = surveyed.yaw_rad;
      }
    }
    return route;
  }

  const Scenario& scenario_;
  const RayScene& scene_;
  const LegalViewpoints& legal_;
  const SurfaceReference& reference_;
  const ViewSurvey& survey_;
  const ViewPose start_;
  const int threads_;
  std::vector<CameraModel> cameras_;
  LatticeWays ways_;
  std::vector<FrameRays> rays_;  // of the view that was taken last
  std::vector<std::uint32_t> start_finds_;
};

}  // namespace

OracleAim aim_of(std::string_view utility_name) {
  GNBV_CHECK(is_oracle(utility_name), "'{}' is no oracle", utility_name);
  return utility_name == "oracle_views" ? OracleAim::views : OracleAim::metres;
}

std::vector<Decision> plan_oracle(const Scenario& scenario, const World& world,
                                  const RayScene& scene, const ViewPose& start, OracleAim aim,
                                  int threads) {
  const LegalViewpoints legal = find_legal_viewpoints(scenario, scene, start, threads);
  if (legal.size() == 0) {
    throw BadInput(fmt::format(
        "start.position_m: from [{}, {}, {}] no way leads to any other place that keeps "
        "planner.validity.collision_radius_m = {} from the structure: an oracle has no views",
        start.p_world_m.x(), start.p_world_m.y(), start.p_world_m.z(),
        scenario.planner.validity.collision_radius_m));
  }
  const SurfaceReference reference =
      cached_surface_reference(world, scene, {.floor_z_m = scenario.planner.floor_z_m}, threads);
  const ViewSurvey survey = cached_survey(ceiling_key(scenario, world, legal), scenario, scene,
                                          legal, reference, threads);
  return Oracle(scenario, scene, legal, reference, survey, start, threads).plan(aim);
}

}  // namespace gnbv
