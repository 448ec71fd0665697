#include "bench/limits/oracle.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "bench/limits/ceiling.hpp"
#include "bench/limits/cloud_of_views.hpp"
#include "bench/limits/survey_task.hpp"
#include "planner/planners.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Of a search that begins with this tour: more gain less than a percent.
int iterations_of(const CoveringTour& tour) {
  constexpr std::size_t kPerView = 60;
  constexpr std::size_t kFewest = 1500;
  constexpr std::size_t kMost = 10000;
  return static_cast<int>(std::clamp(kPerView * tour.views.size(), kFewest, kMost));
}

/// Of the greedy choice that a search begins with: a lower one wastes views.
constexpr double kGreedyPrice = 1.0;

/// How often it begins anew. Few views leave much to chance, and little to do.
std::uint64_t searches_of(const CoveringTour& tour) { return tour.views.size() < 25 ? 3 : 1; }

/// What the oracle knows, and its tours.
class Oracle {
 public:
  Oracle(const Scenario& scenario, const World& world, const RayScene& scene,
         const SurfaceReference& reference, const ViewPose& start, LegalViewpoints legal,
         int threads, const HeedStop& stop)
      : scenario_(scenario),
        scene_(scene),
        legal_(std::move(legal)),
        voxels_(reference.counted[0]),
        survey_(cached_survey(ceiling_key(scenario, world, legal_), scenario, scene, legal_,
                              reference, threads, stop)),
        threads_(threads),
        cameras_(exact_cameras(scenario)),
        ways_(scene, legal_, scenario.planner.validity.collision_radius_m),
        places_(survey_, voxels_.size(), ways_, way_cost(scenario), threads),
        task_(places_.task(scenario.planner.oracle.search_seed)),
        yaw_rad_(start.yaw_rad),
        is_given_up_(voxels_.size(), 0) {}

  std::vector<Decision> route(const SurfaceCloud& flown, const HeedStop& stop) {
    constexpr int kTries = 5;  // at what one flight after the other did not find
    const CloudOfViews cloud(scenario_, voxels_, flown.points_world_m());
    if (static_cast<double>(cloud.found()) >= wanted()) return {};
    if (found_ && cloud.found() <= *found_) {
      if (++tries_ > kTries) return {};
      for (const std::uint32_t voxel : promised_) is_given_up_[voxel] = 1;
    }
    found_ = cloud.found();
    std::vector<std::uint8_t> is_given = is_given_up_;
    for (const std::uint32_t voxel : found_voxels(voxels_, flown.points_world_m())) {
      is_given[voxel] = 1;
    }
    std::vector<std::uint32_t> given;
    for (std::uint32_t voxel = 0; voxel < is_given.size(); ++voxel) {
      if (is_given[voxel] != 0) given.push_back(voxel);
    }
    task_.given = places_.sampled(given);
    task_.stop = stop;
    return decisions(best_tour(flown), std::move(is_given));
  }

 private:
  /// Voxels that the cloud is to hold. A tour's, of fewer views, may hold a little more than that
  /// of all: their leaves take less from each other.
  double wanted() const {
    constexpr double kMore = 0.005;
    const double most = survey_.leaf_counted[0];
    const double coverage = scenario_.planner.oracle.coverage;
    const bool is_possible = 0.0 < coverage && coverage <= most + kMore;
    return (is_possible ? coverage : kOracleShare * most) * static_cast<double>(voxels_.size());
  }

  struct Costed {
    CoveringTour tour;
    double cost;
  };

  /// After whose views the cloud, `flown` now, holds what is wanted, or most of it.
  CoveringTour best_tour(const SurfaceCloud& flown) {
    const std::size_t all = found_by_all();
    const double price = price_of_view(scenario_);
    const double share = wanted() / (survey_.leaf_counted[0] * static_cast<double>(voxels_.size()));
    constexpr double kUsualLoss = 0.99;  // of the cloud of all views beyond that of a tour
    CoverAim target = {part_of(all, kUsualLoss * share), price};
    const CoveringTour greedy = greedy_tour(task_, {target.wanted, std::max(price, kGreedyPrice)});
    std::optional<Costed> best;
    CoveringTour last = greedy;
    const std::uint64_t searches = searches_of(greedy);
    for (std::uint64_t k = 0; k < searches; ++k) {
      task_.seed = searches * scenario_.planner.oracle.search_seed + k;
      last = search(flown, target, greedy, all, best);
    }
    return best ? std::move(best->tour) : last;
  }

  /// How many of the voxels that single views find it takes depends on the tour: the more views
  /// overlap, the more of them the common leaves lose. So the tour is searched again for what the
  /// last one lacked, or had too much, until it is right within a few voxels; the cheapest is kept.
  /// `target` is left as the last search had it, for the next to begin with.
  CoveringTour search(const SurfaceCloud& flown, CoverAim& target, const CoveringTour& greedy,
                      std::size_t all, std::optional<Costed>& best) {
    constexpr int kRounds = 5;
    constexpr double kTooMuch = 8.0;  // voxels, and a share of those wanted
    constexpr double kTooMuchShare = 3e-4;
    constexpr double kYield = 0.65;  // of a voxel more that is found, to the share held so far
    const int iterations = iterations_of(greedy);
    CoveringTour tour = cheaper_tour(task_, target, greedy, iterations);
    for (int round = 1;; ++round) {
      const auto held = static_cast<double>(held_by(tour, flown));
      const bool is_enough = held >= wanted();
      if (const double cost = is_enough ? flown_cost(tour) : 0.0;
          is_enough && (!best || cost < best->cost)) {
        best = {tour, cost};
      }
      const bool is_right = is_enough && held <= wanted() * (1.0 + kTooMuchShare) + kTooMuch;
      if (is_right || round >= (best ? kRounds : 2 * kRounds)) return tour;
      if (!is_enough && tour.covered >= all) return tour;
      target.wanted = part_of(tour.covered, 1.0 + (wanted() / held - 1.0) / kYield);
      if (!is_enough) target.wanted = std::max(target.wanted, tour.covered + 1);
      target.wanted = std::min(target.wanted, all);
      tour = cheaper_tour(task_, target, tour, iterations / 2);
    }
  }

  /// cost_m(), but seconds as they are flown, with every turn.
  double flown_cost(const CoveringTour& tour) {
    if (!traits_of(scenario_.planner).counts_seconds) {
      return cost_m(tour, {.metres_per_view = price_of_view(scenario_)});
    }
    double total_s = 0.0;
    ViewPose at{ways_.p_world_m(places_.lattice_place(task_.start)), yaw_rad_};
    for (const Decision& next : route_along(tour)) {
      for (const Vec3& via_m : next.via_world_m) {
        const ViewPose via{via_m, next.view.yaw_rad};
        total_s += duration_s(scenario_, std::exchange(at, via), via);
      }
      total_s += duration_s(scenario_, std::exchange(at, next.view), next.view);
    }
    return total_s;
  }

  std::size_t found_by_all() const {
    CoverCounts all(task_.views, task_.given);
    for (std::uint32_t view = 0; view < task_.views.size(); ++view) all.add(view);
    return all.covered();
  }
  static std::size_t part_of(std::size_t items, double share) {
    return static_cast<std::size_t>(std::ceil(share * static_cast<double>(items)));
  }

  /// How many voxels the cloud holds after the tour.
  std::size_t held_by(const CoveringTour& tour, const SurfaceCloud& flown) const {
    CloudOfViews cloud(scenario_, voxels_, flown.points_world_m());
    std::vector<FrameRays> rays;
    for (const std::uint32_t view : flown_order(tour)) {
      take_view(scene_, cameras_, pose_of(legal_, survey_.views[view]), scenario_.planner.floor_z_m,
                threads_, rays);
      cloud.add(rays);
    }
    return cloud.found();
  }

  /// Place after place, at each of them the nearest turn first, of two the left one.
  std::vector<std::uint32_t> flown_order(const CoveringTour& tour) const {
    std::vector<std::uint32_t> order;
    double yaw_rad = yaw_rad_;
    for (const std::uint32_t place : tour.places) {
      std::vector<std::uint32_t> views;
      for (const std::uint32_t view : tour.views) {
        if (task_.place[view] == place) views.push_back(view);
      }
      const auto turn_rad = [&](std::uint32_t view) {
        constexpr double kRounding_rad = 1e-9;
        const double turn = wrap_angle_rad(survey_.views[view].yaw_rad - yaw_rad);
        return turn < 0.0 ? kRounding_rad - turn : turn;
      };
      for (auto next = views.begin(); next != views.end(); ++next) {
        std::iter_swap(next, std::min_element(next, views.end(), [&](auto a, auto b) {
                         return turn_rad(a) < turn_rad(b);
                       }));
        yaw_rad = survey_.views[*next].yaw_rad;
      }
      order.insert(order.end(), views.begin(), views.end());
    }
    return order;
  }

  /// Its views, in order, with the ways there.
  std::vector<Decision> route_along(const CoveringTour& tour) {
    std::vector<std::size_t> places;  // as LatticeWays knows them
    for (const std::uint32_t place : tour.places) places.push_back(places_.lattice_place(place));
    ways_.prepare(places, threads_);
    std::vector<Decision> route;
    std::size_t at = 0;  // of the tour
    for (const std::uint32_t view : flown_order(tour)) {
      const std::size_t from = at;
      while (tour.places[at] != task_.place[view]) ++at;
      const int views = static_cast<int>(survey_.views.size());
      route.push_back({.view = pose_of(legal_, survey_.views[view]),
                       .sampler = Sampler::oracle,
                       .candidates = views,
                       .valid = views,
                       .via_world_m = ways_.way(places[from], places[at]).via_world_m});
    }
    return route;
  }

  /// With what each view gains of the voxels that are not found yet. The next route begins where
  /// this one ends.
  std::vector<Decision> decisions(const CoveringTour& tour, std::vector<std::uint8_t> is_found) {
    std::vector<Decision> route = route_along(tour);
    const std::vector<std::uint32_t> order = flown_order(tour);
    promised_.clear();
    for (std::size_t i = 0; i < route.size(); ++i) {
      const std::size_t before = promised_.size();
      for (const std::uint32_t voxel : survey_.views[order[i]].finds) {
        if (is_found[voxel] == 0) promised_.push_back(voxel);
        is_found[voxel] = 1;
      }
      const auto gain = static_cast<double>(promised_.size() - before);
      route[i].score = {.value = gain, .information = gain};
    }
    if (route.empty()) return route;
    task_.start = task_.place[order.back()];
    yaw_rad_ = route.back().view.yaw_rad;
    return route;
  }

  const Scenario& scenario_;
  const RayScene& scene_;
  const LegalViewpoints legal_;
  const VoxelSet& voxels_;
  const ViewSurvey survey_;
  const int threads_;
  std::vector<CameraModel> cameras_;
  LatticeWays ways_;
  SurveyTask places_;
  CoverTask task_;
  double yaw_rad_;                         // where the next route begins
  std::vector<std::uint8_t> is_given_up_;  // of the voxels
  std::vector<std::uint32_t> promised_;    // by the last route
  std::optional<std::size_t> found_;       // voxels that the cloud held before it
  int tries_ = 0;                          // that found nothing
};

}  // namespace

KnownRoute plan_oracle(const Scenario& scenario, const World& world, const RayScene& scene,
                       const SurfaceReference& reference, const ViewPose& start, int threads,
                       const HeedStop& stop) {
  LegalViewpoints legal = find_legal_viewpoints(scenario, scene, start, threads, stop);
  if (legal.size() == 0) {
    throw BadInput(
        "start.position_m: from [{}, {}, {}] no way leads to any other place that keeps "
        "planner.validity.collision_radius_m = {} from the structure: an oracle has no views",
        start.p_world_m.x(), start.p_world_m.y(), start.p_world_m.z(),
        scenario.planner.validity.collision_radius_m);
  }
  const auto oracle = std::make_shared<Oracle>(scenario, world, scene, reference, start,
                                               std::move(legal), threads, stop);
  return [oracle](const SurfaceCloud& flown, const HeedStop& heed) {
    return oracle->route(flown, heed);
  };
}

}  // namespace gnbv
