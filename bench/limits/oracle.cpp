#include "bench/limits/oracle.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/limits/ceiling.hpp"
#include "bench/limits/cloud_of_views.hpp"
#include "bench/limits/survey_task.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Of a search that begins with this tour: more gain less than a percent.
int iterations_of(const CoveringTour& tour) {
  constexpr std::size_t kPerView = 60;
  constexpr std::size_t kMost = 10000;
  return static_cast<int>(std::min(kMost, kPerView * tour.views.size()));
}

// price of a view, so that few views come first whatever the metres
constexpr double kMetresPerViewOfFew = 1000.0;

CoverAim cover_aim(OracleAim aim, std::size_t wanted) {
  return {wanted, aim == OracleAim::views ? kMetresPerViewOfFew : kMetresPerView};
}

/// What the oracle knows, and its tours.
class Oracle {
 public:
  Oracle(const Scenario& scenario, const RayScene& scene, const LegalViewpoints& legal,
         const SurfaceReference& reference, const ViewSurvey& survey, const ViewPose& start,
         int threads, const HeedStop& stop)
      : scenario_(scenario),
        scene_(scene),
        legal_(legal),
        voxels_(reference.counted[0]),
        survey_(survey),
        start_(start),
        threads_(threads),
        cameras_(exact_cameras(scenario)),
        ways_(scene, legal, scenario.planner.validity.collision_radius_m),
        start_finds_(finds_alone(voxels_, take(start), scenario.planner.cloud.leaf_m)),
        places_(survey, voxels_.size(), ways_, threads),
        task_(places_.task(start_finds_)) {
    task_.stop = stop;
  }

  std::vector<Decision> plan(OracleAim aim) {
    return decisions(best_tour(aim, kOracleShare).searched);
  }

  OracleReach reach(double share) {
    const Tours tours = best_tour(OracleAim::metres, share);
    return {.share = share,
            .views = tours.searched.views.size(),
            .length_m = flown_m(tours.searched),
            .greedy_views = tours.greedy.views.size(),
            .greedy_m = flown_m(tours.greedy)};
  }

 private:
  std::span<const FrameRays> take(const ViewPose& view) {
    take_view(scene_, cameras_, view, scenario_.planner.floor_z_m, threads_, rays_);
    return rays_;
  }

  /// Two that find as much of the survey's voxels.
  struct Tours {
    CoveringTour greedy, searched;
  };

  /// The searched one's cloud holds that share of what the cloud of all views does. How many of the
  /// voxels that single views find it takes for that depends on the tour: the more views overlap,
  /// the more of them the common leaves lose. So the tour is searched again for what the last one
  /// lacked, or had too much, until it is right within a few voxels; the cheapest is kept.
  Tours best_tour(OracleAim aim, double share) {
    constexpr int kRounds = 5;
    constexpr double kTooMuch = 8.0;  // voxels, and a share of those wanted
    constexpr double kTooMuchShare = 3e-4;
    constexpr double kUsualLoss = 0.99;  // of the cloud of all views beyond that of a tour
    constexpr double kYield = 0.65;      // of a voxel more that is found, to the share held so far
    const double wanted = share * survey_.leaf_counted[0] * static_cast<double>(voxels_.size());
    const std::size_t all = found_by_all();
    CoverAim target = cover_aim(aim, part_of(all, kUsualLoss * share));
    const CoveringTour first = greedy(target);
    const int iterations = iterations_of(first);
    CoveringTour tour = cheaper_tour(task_, target, first, iterations);
    std::optional<CoveringTour> best;
    for (int round = 1;; ++round) {
      const auto held = static_cast<double>(held_by(tour));
      const bool is_enough = held >= wanted;
      if (is_enough && (!best || cost_m(tour, target) < cost_m(*best, target))) best = tour;
      const bool is_right = is_enough && held <= wanted * (1.0 + kTooMuchShare) + kTooMuch;
      if (is_right || (best && round >= kRounds)) break;
      if (!is_enough && tour.covered >= all) break;
      target.wanted = part_of(tour.covered, 1.0 + (wanted / held - 1.0) / kYield);
      if (!is_enough) target.wanted = std::max(target.wanted, tour.covered + 1);
      target.wanted = std::min(target.wanted, all);
      tour = cheaper_tour(task_, target, tour, iterations / 2);
    }
    target.wanted = best ? best->covered : all;
    return {.greedy = greedy(target), .searched = best.value_or(std::move(tour))};
  }

  CoveringTour greedy(const CoverAim& aim) const {
    return greedy_tour(task_, {aim.wanted, std::max(aim.metres_per_view, kGreedyMetresPerView)});
  }
  std::size_t found_by_all() const {
    CoverCounts all(task_.views, task_.given);
    for (std::uint32_t view = 0; view < task_.views.size(); ++view) all.add(view);
    return all.covered();
  }
  static std::size_t part_of(std::size_t items, double share) {
    return static_cast<std::size_t>(std::ceil(share * static_cast<double>(items)));
  }

  /// How many voxels the cloud of the tour holds.
  std::size_t held_by(const CoveringTour& tour) {
    CloudOfViews cloud(scenario_, voxels_);
    cloud.add(take(start_));
    for (const std::uint32_t view : flown_order(tour)) {
      cloud.add(take(pose_of(legal_, survey_.views[view])));
    }
    return cloud.found();
  }

  /// Place after place, at each of them turning on to the left.
  std::vector<std::uint32_t> flown_order(const CoveringTour& tour) const {
    std::vector<std::uint32_t> order;
    double yaw_rad = start_.yaw_rad;
    for (const std::uint32_t place : tour.places) {
      std::vector<std::uint32_t> views;
      for (const std::uint32_t view : tour.views) {
        if (task_.place[view] == place) views.push_back(view);
      }
      const auto turn_rad = [&](std::uint32_t view) {
        constexpr double kRounding_rad = 1e-9;
        const double turn = survey_.views[view].yaw_rad - yaw_rad + kRounding_rad;
        return turn - 2.0 * kPi * std::floor(turn / (2.0 * kPi));
      };
      std::sort(views.begin(), views.end(),
                [&](std::uint32_t a, std::uint32_t b) { return turn_rad(a) < turn_rad(b); });
      order.insert(order.end(), views.begin(), views.end());
      if (!views.empty()) yaw_rad = survey_.views[views.back()].yaw_rad;
    }
    return order;
  }

  /// The tour's places as LatticeWays knows them, prepared.
  std::vector<std::size_t> lattice_places(const CoveringTour& tour) {
    std::vector<std::size_t> places;
    for (const std::uint32_t place : tour.places) places.push_back(places_.lattice_place(place));
    ways_.prepare(places, threads_);
    return places;
  }

  /// With every way cut as short as it is flown.
  double flown_m(const CoveringTour& tour) {
    const std::vector<std::size_t> places = lattice_places(tour);
    double length_m = 0.0;
    for (std::size_t i = 1; i < places.size(); ++i) {
      length_m += ways_.way(places[i - 1], places[i]).length_m;
    }
    return length_m;
  }

  std::vector<Decision> decisions(const CoveringTour& tour) {
    const std::vector<std::size_t> places = lattice_places(tour);
    std::vector<std::uint8_t> is_found(voxels_.size(), 0);
    const auto find = [&](std::span<const std::uint32_t> voxels) {
      double count = 0.0;
      for (const std::uint32_t voxel : voxels) {
        count += is_found[voxel] == 0 ? 1.0 : 0.0;
        is_found[voxel] = 1;
      }
      return count;
    };
    find(start_finds_);
    std::vector<Decision> route;
    std::size_t at = 0;  // of the tour
    for (const std::uint32_t view : flown_order(tour)) {
      const std::size_t from = at;
      while (tour.places[at] != task_.place[view]) ++at;
      const double gain = find(survey_.views[view].finds);
      const int views = static_cast<int>(survey_.views.size());
      route.push_back({.view = pose_of(legal_, survey_.views[view]),
                       .sampler = Sampler::oracle,
                       .candidates = views,
                       .valid = views,
                       .score = {.value = gain, .information = gain},
                       .via_world_m = ways_.way(places[from], places[at]).via_world_m});
    }
    return route;
  }

  const Scenario& scenario_;
  const RayScene& scene_;
  const LegalViewpoints& legal_;
  const VoxelSet& voxels_;
  const ViewSurvey& survey_;
  const ViewPose start_;
  const int threads_;
  std::vector<CameraModel> cameras_;
  std::vector<FrameRays> rays_;  // of the view that was taken last
  LatticeWays ways_;
  std::vector<std::uint32_t> start_finds_;
  SurveyTask places_;
  CoverTask task_;
};

/// Calls use(oracle) with what it has to know.
template <typename Use>
auto ask_oracle(const Scenario& scenario, const World& world, const RayScene& scene,
                const SurfaceReference& reference, const ViewPose& start, int threads,
                const HeedStop& stop, const Use& use) {
  const LegalViewpoints legal = find_legal_viewpoints(scenario, scene, start, threads, stop);
  if (legal.size() == 0) {
    throw BadInput(fmt::format(
        "start.position_m: from [{}, {}, {}] no way leads to any other place that keeps "
        "planner.validity.collision_radius_m = {} from the structure: an oracle has no views",
        start.p_world_m.x(), start.p_world_m.y(), start.p_world_m.z(),
        scenario.planner.validity.collision_radius_m));
  }
  const ViewSurvey survey = cached_survey(ceiling_key(scenario, world, legal), scenario, scene,
                                          legal, reference, threads, stop);
  Oracle oracle(scenario, scene, legal, reference, survey, start, threads, stop);
  return use(oracle);
}

}  // namespace

std::vector<Decision> plan_oracle(const Scenario& scenario, const World& world,
                                  const RayScene& scene, const SurfaceReference& reference,
                                  const ViewPose& start, OracleAim aim, int threads,
                                  const HeedStop& stop) {
  return ask_oracle(scenario, world, scene, reference, start, threads, stop,
                    [&](Oracle& oracle) { return oracle.plan(aim); });
}

std::vector<OracleReach> oracle_reaches(const Scenario& scenario, const World& world,
                                        const RayScene& scene, const SurfaceReference& reference,
                                        const ViewPose& start, int threads) {
  const auto reach_all = [](Oracle& oracle) {
    std::vector<OracleReach> reaches;
    for (const double share : kOracleReachShares) reaches.push_back(oracle.reach(share));
    // a tour that finds more finds less, too
    for (std::size_t i = reaches.size() - 1; i-- > 0;) {
      const OracleReach& more = reaches[i + 1];
      if (more.length_m >= reaches[i].length_m) continue;
      reaches[i].length_m = more.length_m;
      reaches[i].views = more.views;
    }
    return reaches;
  };
  return ask_oracle(scenario, world, scene, reference, start, threads, {}, reach_all);
}

}  // namespace gnbv
