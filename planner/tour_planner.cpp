#include "planner/tour_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>

#include "planner/belief.hpp"
#include "planner/history.hpp"
#include "planner/map/clearance.hpp"
#include "planner/model.hpp"
#include "planner/tour/prize_tour.hpp"
#include "planner/tour/surface_places.hpp"
#include "sim/core/rng.hpp"
#include "sim/core/stopwatch.hpp"

namespace gnbv {
namespace {

double lattice_step_m(const TourConfig& config, std::span<const CameraModel> cameras,
                      const Box3& navigation_m) {
  if (config.lattice_step_m > 0.0) return config.lattice_step_m;
  double range_m = 0.0;
  for (const CameraModel& camera : cameras) {
    range_m = std::max(range_m, camera.config.range_max_m);
  }
  return std::min(0.25 * range_m, navigation_m.sizes().head<2>().minCoeff() / 8.0);
}

constexpr float kSuccessMax = 0.98F;

}  // namespace

TourPlanner::TourPlanner(const PlannerModel& model)
    : model_(model),
      config_(model.config.tour),
      cells_(model.workspace_m, config_.detail_m),
      space_(GridGeometry(model.workspace_m, model.config.map.resolution_m), model.navigation_m,
             model.config.validity.collision_radius_m),
      places_(GridGeometry(model.workspace_m, model.config.map.resolution_m), model.navigation_m,
              lattice_step_m(config_, model.cameras, model.navigation_m)),
      catalogue_(config_, model.cameras, model.workspace_m),
      success_(config_.success) {}

TourScene TourPlanner::scene(const Belief& belief) const {
  return {config_, cells_, patches_, belief.grid};
}

void TourPlanner::digest(const Belief& belief, int threads) {
  const std::span<const Vec3f> points = belief.cloud.points_world_m();
  cells_.add(points.subspan(points_taken_), belief.grid, threads);
  points_taken_ = points.size();
  learn();
}

/// Compares what the last view promised with what the cloud has gained.
void TourPlanner::learn() {
  outcomes_.clear();
  double promised = 0.0;
  double found_in_all = 0.0;
  for (const Promise& look : promises_) {
    const SurfaceCell& cell = cells_.cells()[cell_of(look.patch)];
    const std::uint64_t fresh = cell.covered & ~look.before;
    const double found =
        std::min(static_cast<double>(look.missing), static_cast<double>(std::popcount(fresh)));
    success_.learn(look.source, look.looks, look.incidence, static_cast<double>(look.missing),
                   found);
    cells_.count_look(cell_of(look.patch), side_of(look.patch));
    promised += static_cast<double>(look.promised);
    found_in_all += found;
    const std::size_t looks = std::min<std::size_t>(look.looks, kLookBins - 1);
    auto same = std::find_if(outcomes_.begin(), outcomes_.end(), [&](const LookOutcome& o) {
      return o.source == look.source && o.looks == looks && o.incidence == look.incidence;
    });
    if (same == outcomes_.end()) {
      outcomes_.push_back({look.source, looks, look.incidence});
      same = outcomes_.end() - 1;
    }
    ++same->patches;
    same->missing += static_cast<double>(look.missing);
    same->promised += static_cast<double>(look.promised);
    same->found += found;
  }
  if (std::getenv("TOUR_DEBUG")) {
    fmt::print(stderr, "  promised {:.0f} found {:.0f}\n", promised, found_in_all);
    for (const auto& o : outcomes_)
      fmt::print(
          stderr,
          "    source {} looks {} inc {}: n {} missing {:.0f} promised {:.0f} found {:.0f}\n",
          int(o.source), o.looks, o.incidence, o.patches, o.missing, o.promised, o.found);
  }
  promises_.clear();
  if (found_in_all < config_.replan_below * promised) is_disappointed_ = true;
}

PrizeTask TourPlanner::make_task(std::vector<TourView>& views) const {
  PrizeTask task;
  constexpr std::uint32_t kNoItem = 0xffffffffU;
  std::vector<std::uint32_t> item_of(patches_.size(), kNoItem);
  constexpr float kLeast = 0.25F;  // voxels
  std::vector<PatchId> active;
  double expected = 0.0;
  for (PatchId id = 0; id < patches_.size(); ++id) {
    const Patch& patch = patches_[id];
    if (patch.missing > 0.0F && patch.missing * success_.share(patch, 0) >= kLeast) {
      active.push_back(id);
    }
  }
  for (const SurfaceCell& cell : cells_.cells()) expected += std::popcount(cell.expected);
  const std::size_t one_in = (active.size() + static_cast<std::size_t>(config_.items_max) - 1) /
                             static_cast<std::size_t>(config_.items_max);
  for (const PatchId id : active) {
    if (one_in > 1 && mix_bits(id) % one_in != 0) continue;
    item_of[id] = static_cast<std::uint32_t>(task.weight.size());
    task.weight.push_back(patches_[id].missing *
                          static_cast<float>(std::max<std::size_t>(1, one_in)));
  }
  task.price_per_m = config_.price_per_m * expected * price_factor_;
  task.metres_per_view = config_.metres_per_view;
  const double least = 0.5 * task.price_per_m * config_.metres_per_view;
  for (TourPlaces::Place place = 1; place < places_.size(); ++place) {
    if (!places_.is_reachable(place)) continue;
    for (int yaw = 0; yaw < catalogue_.yaws(); ++yaw) {
      std::vector<ItemLook> looks;
      double gain = 0.0;
      for (const SeenPatch& seen : catalogue_.seen(place, yaw)) {
        const std::uint32_t item = item_of[seen.patch];
        if (item == kNoItem) continue;
        const float share =
            std::min(kSuccessMax, success_.share(patches_[seen.patch], seen.incidence));
        looks.push_back({item, share});
        gain += static_cast<double>(task.weight[item] * share);
      }
      if (gain < least) continue;
      std::sort(looks.begin(), looks.end(),
                [](const ItemLook& a, const ItemLook& b) { return a.item < b.item; });
      task.looks.push_back(std::move(looks));
      task.place.push_back(place);
      views.push_back({place, {places_.p_world_m(place), catalogue_.yaw_rad(yaw)}});
    }
  }
  task.start = TourPlaces::here();
  return task;
}

/// For what no place sees: a few more, from the cubes of a metre that lack the most. Whether there
/// are any.
bool TourPlanner::add_surface_places(const Belief& belief) {
  constexpr std::size_t kCubes = 24;  // a replan
  constexpr std::size_t kPlaces = 2;  // for each
  constexpr float kLeast = 8.0F;      // voxels, of a cube
  std::vector<std::uint8_t> is_seen(patches_.size(), 0);
  for (TourPlaces::Place place = 1; place < places_.size(); ++place) {
    if (!places_.is_reachable(place)) continue;
    for (int yaw = 0; yaw < catalogue_.yaws(); ++yaw) {
      for (const SeenPatch& seen : catalogue_.seen(place, yaw)) is_seen[seen.patch] = 1;
    }
  }
  struct Cube {
    float missing = 0.0F;
    PatchId heaviest = 0;
  };
  std::map<Key, Cube> cubes;
  for (PatchId id = 0; id < patches_.size(); ++id) {
    const Patch& patch = patches_[id];
    if (patch.missing <= 0.0F || is_seen[id] != 0) continue;
    const Vec3f at = patch.target_m.array().floor();
    Cube& cube = cubes[{static_cast<std::int32_t>(at.x()), static_cast<std::int32_t>(at.y()),
                        static_cast<std::int32_t>(at.z())}];
    if (cube.missing == 0.0F || patch.missing > patches_[cube.heaviest].missing) {
      cube.heaviest = id;
    }
    cube.missing += patch.missing;
  }
  std::vector<std::pair<float, Key>> order;
  for (const auto& [key, cube] : cubes) {
    if (cube.missing >= kLeast && !tried_.contains(key)) order.emplace_back(-cube.missing, key);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), kCubes));
  bool is_any = false;
  for (const auto& [missing, key] : order) {
    tried_.insert(key);
    const Patch& patch = patches_[cubes[key].heaviest];
    for (const Vec3& p_m : places_to_see({belief.grid, space_, model_.cameras}, patch, kPlaces)) {
      places_.add(p_m);
      is_any = true;
    }
  }
  if (std::getenv("TOUR_DEBUG")) {
    double unseen = 0;
    for (const auto& [k, c] : cubes) unseen += c.missing;
    fmt::print(stderr, "  unseen {:.0f} in {} cubes, {} tried now, places {}\n", unseen,
               cubes.size(), order.size(), places_.size());
  }
  return is_any;
}

void TourPlanner::replan(const Belief& belief, const ViewPose& current, int threads) {
  const Stopwatch watch;
  auto lap = [&](const char* w) {
    if (std::getenv("TOUR_DEBUG")) fmt::print(stderr, "   {} {:.2f}", w, watch.elapsed_s());
  };
  cells_.follow_map(belief.grid);
  space_.follow(belief.grid);
  lap("space_.follow");
  places_.follow(belief.grid, space_, current.p_world_m);
  lap("places_.follow");
  at_ = TourPlaces::here();
  patches_ = find_patches(cells_, belief.grid, threads);
  lap("patches");
  std::vector<TourPlaces::Place> first;
  for (const TourView& view : tour_) first.push_back(view.place);
  catalogue_.follow(scene(belief), places_, first, config_.recasts, threads);
  if (config_.surface_views && add_surface_places(belief)) {
    places_.follow(belief.grid, space_, current.p_world_m);
    catalogue_.follow(scene(belief), places_, {}, 0, threads);
  }
  lap("catalogue_.follow");
  while (true) {
    std::vector<TourView> views;
    PrizeTask task = make_task(views);
    lap("task");
    task.row_m = [&](std::uint32_t place) { return places_.row_m(place); };
    std::vector<std::uint32_t> from;
    for (const TourView& left : tour_) {
      for (std::uint32_t i = 0; i < views.size(); ++i) {
        if (views[i].place == left.place && views[i].pose.yaw_rad == left.pose.yaw_rad) {
          from.push_back(i);
        }
      }
    }
    const PrizeTour found = search_prize_tour(
        task, from, config_.search == TourSearch::greedy ? 0 : config_.iterations, replans_++);
    if (std::getenv("TOUR_DEBUG")) {
      double miss = 0;
      int n = 0;
      std::array<double, 4> by{};
      for (const auto& q : patches_) {
        miss += q.missing;
        n += q.missing > 0;
        by[size_t(q.source)] += q.missing;
      }
      double exp = 0, cov = 0;
      for (const auto& c : cells_.cells()) {
        exp += std::popcount(c.expected);
        cov += std::popcount(c.expected & c.covered);
      }
      fmt::print(
          stderr,
          "REPLAN price {:.1f}/m views {} items {} patches {} missing {:.0f} ({:.0f} {:.0f} {:.0f} "
          "{:.0f}) expected {:.0f} covered {:.0f} -> tour {} views {} places {:.1f} m found "
          "{:.0f} t {:.2f}\n",
          task.price_per_m, task.looks.size(), task.weight.size(), n, miss, by[0], by[1], by[2],
          by[3], exp, cov, found.views.size(), found.places.size(), found.length_m, found.found,
          watch.elapsed_s());
    }
    tour_.clear();
    for (const std::uint32_t view : found.views) tour_.push_back(views[view]);
    if (!tour_.empty()) break;
    const double remaining =
        std::accumulate(patches_.begin(), patches_.end(), 0.0, [&](double sum, const Patch& patch) {
          return sum + static_cast<double>(patch.missing * success_.share(patch, 0));
        });
    double expected = 0.0;
    for (const SurfaceCell& cell : cells_.cells()) expected += std::popcount(cell.expected);
    if (task.looks.empty() && price_factor_ < 1e-3) break;
    if (remaining <= config_.end_share * expected) break;
    price_factor_ *= 0.5;
    if (price_factor_ < 1e-4) break;
  }
  views_since_replan_ = 0;
  is_disappointed_ = false;
}

std::optional<std::vector<Vec3>> TourPlanner::way(const Belief& belief, const ViewPose& current,
                                                  TourPlaces::Place to) {
  const double radius_m = model_.config.validity.collision_radius_m;
  const auto is_clear = [&](const Vec3& a_m, const Vec3& b_m) {
    return is_line_free(belief.grid, a_m, b_m) && is_path_clear(belief.grid, a_m, b_m, radius_m);
  };
  const Vec3& to_m = places_.p_world_m(to);
  if (is_clear(current.p_world_m, to_m)) return std::vector<Vec3>{};
  if (!std::isfinite(places_.row_m(at_)[to])) return std::nullopt;
  std::vector<Vec3> via_m = places_.via_world_m(at_, to);
  Vec3 from_m = current.p_world_m;
  for (const Vec3& next_m : via_m) {
    if (!is_clear(from_m, next_m)) return std::nullopt;
    from_m = next_m;
  }
  if (!is_clear(from_m, to_m)) return std::nullopt;
  return via_m;
}

void TourPlanner::promise(const Belief& belief, const ViewPose& view) {
  for (const SeenPatch& seen : catalogue_.look(scene(belief), view)) {
    const Patch& patch = patches_[seen.patch];
    promises_.push_back({.patch = seen.patch,
                         .source = patch.source,
                         .looks = patch.looks,
                         .incidence = seen.incidence,
                         .missing = patch.missing,
                         .promised = patch.missing * success_.share(patch, seen.incidence),
                         .before = cells_.cells()[cell_of(seen.patch)].covered});
  }
}

Plan TourPlanner::next(const Belief& belief, const History& history, const ViewPose& current,
                       int threads) {
  digest(belief, threads);
  ValidityConfig validity = model_.config.validity;
  validity.path = PathCheck::unchecked;
  const std::vector<ViewPose> recent = recent_views(history, validity.recent_poses);
  ViewChecker checker(validity, model_.navigation_m, model_.no_fly, belief.grid, recent, current);
  Plan plan;
  for (int round = 0; round < 2; ++round) {
    if (is_disappointed_ || tour_.empty() || views_since_replan_ >= config_.views_per_replan) {
      replan(belief, current, threads);
    } else {
      patches_ = find_patches(cells_, belief.grid, threads);
    }
    while (!tour_.empty()) {
      const TourView view = tour_.front();
      tour_.erase(tour_.begin());
      plan.candidates.push_back({.view = view.pose, .sampler = kTourName});
      Candidate& candidate = plan.candidates.back();
      checker.check(candidate);
      if (!candidate.rejected) {
        if (auto via = way(belief, current, view.place)) {
          candidate.via_world_m = std::move(*via);
        } else {
          candidate.rejected = Rejection::path_blocked;
          places_.forget_ways();
        }
      }
      if (candidate.rejected) {
        is_disappointed_ = true;
        continue;
      }
      promise(belief, view.pose);
      double promised = 0.0;
      for (const Promise& look : promises_) promised += static_cast<double>(look.promised);
      candidate.score = {.value = promised, .information = promised};
      plan.chosen = plan.candidates.size() - 1;
      plan.next = Decision{.view = view.pose,
                           .sampler = kTourName,
                           .candidates = static_cast<int>(tour_.size()) + 1,
                           .valid = static_cast<int>(tour_.size()) + 1,
                           .score = candidate.score,
                           .via_world_m = candidate.via_world_m};
      at_ = view.place;
      ++views_since_replan_;
      return plan;
    }
    is_disappointed_ = true;
  }
  plan.is_complete = true;
  return plan;
}

}  // namespace gnbv
