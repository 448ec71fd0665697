#include "planner/tour/tour_planner.hpp"

#include <algorithm>
#include <cmath>

#include "planner/core/belief.hpp"
#include "planner/core/history.hpp"
#include "planner/core/model.hpp"
#include "planner/core/scratch.hpp"
#include "planner/map/clearance.hpp"
#include "planner/map/path_search.hpp"
#include "planner/tour/surface_places.hpp"
#include "planner/tour/unseen_space.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

/// A quarter of the cameras' range, but at least eight steps across the navigation box.
double lattice_step_m(const TourConfig& config, std::span<const CameraModel> cameras,
                      const Box3& navigation_m) {
  if (config.lattice_step_m > 0.0) return config.lattice_step_m;
  double range_m = 0.0;
  for (const CameraModel& camera : cameras) range_m = std::max(range_m, camera.config.range_max_m);
  return std::min(0.25 * range_m, navigation_m.sizes().head<2>().minCoeff() / 8.0);
}

std::vector<CameraModel> at_all_pitches(std::span<const CameraModel> cameras) {
  std::vector<CameraModel> all;
  for (const CameraModel& camera : cameras) {
    for (CameraModel& fixed : at_all_pitches(camera)) all.push_back(std::move(fixed));
  }
  return all;
}

}  // namespace

TourPlanner::TourPlanner(const TourConfig& config, const PlannerModel& model, bool has_profile)
    : model_(model),
      config_(config),
      has_profile_(has_profile),
      cells_(model.workspace_m, config_.detail_m),
      cameras_(at_all_pitches(std::span(model.cameras))),
      space_(model.geometry(), model.navigation_m, model.no_fly, model.validity.collision_radius_m),
      places_(model.geometry(), model.navigation_m,
              lattice_step_m(config_, model.cameras, model.navigation_m)),
      catalogue_(config_, model.cameras, model.pitches_rad, model.workspace_m),
      ledger_(config_.success, config_.detail_m) {}

TourScene TourPlanner::scene(const Belief& belief) const {
  return {config_, cells_, patches_, belief.grid};
}

TourKnowledge TourPlanner::knowledge() const {
  return {.config = config_,
          .cells = cells_,
          .patches = patches_,
          .catalogue = catalogue_,
          .places = places_,
          .success = ledger_.success(),
          .refused = refused_,
          .tour = tour_};
}

double TourPlanner::voxels_a_metre() const {
  return config_.price * expected_surface(cells_).voxels_a_metre();
}

void TourPlanner::learn(const Belief& belief, int threads) {
  const std::span<const Vec3f> points = belief.cloud.points_world_m();
  cells_.add(points.subspan(points_taken_), belief.grid, threads);
  points_taken_ = points.size();
  ledger_.settle(cells_);
  const double short_of = ledger_.promised() - ledger_.found();
  const bool is_short = ledger_.found() < config_.replan_below * ledger_.promised();
  if (is_short && short_of > voxels_a_metre()) is_due_ = true;
}

void TourPlanner::find_patches_now(const Belief& belief, int threads) {
  patches_ = find_patches(cells_, belief.grid, threads);
  ledger_.give_credit(patches_);
}

/// What each place would see, those included that the surface asks for.
void TourPlanner::look_around(const Belief& belief, const ViewPose& current, int threads) {
  std::vector<TourPlaces::Place> first;
  for (const TourView& view : tour_) first.push_back(view.place);
  catalogue_.follow(scene(belief), places_, first, config_.recasts, threads);
  if (!config_.surface_views) return;
  const std::vector<Vec3> more_m = places_for_unseen({belief.grid, space_, cameras_}, patches_,
                                                     seen_from_anywhere(knowledge()), tried_);
  if (more_m.empty()) return;
  for (const Vec3& p_m : more_m) places_.add(p_m);
  places_.follow(belief.grid, space_, current.p_world_m);
  catalogue_.follow(scene(belief), places_, {}, 0, threads);
}

/// Whether some view pays at the price of now.
bool TourPlanner::search_tour() {
  TourTask task = make_tour_task(knowledge(), price_factor_ * voxels_a_metre());
  task.prizes.row_m = [this](std::uint32_t place) { return places_.row_m(place); };
  std::vector<std::uint32_t> from;
  for (const TourView& left : tour_) {
    const auto same = std::find_if(task.views.begin(), task.views.end(), [&](const TourView& v) {
      return v.place == left.place && is_same_view(v.pose, left.pose);
    });
    if (same != task.views.end()) {
      from.push_back(static_cast<std::uint32_t>(same - task.views.begin()));
    }
  }
  const int iterations = config_.search == TourSearch::greedy ? 0 : config_.iterations;
  const PrizeTour found = search_prize_tour(task.prizes, from, iterations, searches_++);
  tour_.clear();
  for (const std::uint32_t view : found.views) tour_.push_back(task.views[view]);
  return !tour_.empty();
}

/// A tour of one view: that which sees the most unknown space for its way.
bool TourPlanner::explore(const Belief& belief, Scratch& scratch) {
  if (!config_.explore || has_profile_) return false;
  constexpr std::size_t kMostPlaces = 160;
  std::vector<TourPlaces::Place> places;
  for (TourPlaces::Place place = 1; place < places_.size(); ++place) {
    if (places_.is_reachable(place)) places.push_back(place);
  }
  const std::size_t one_in = (places.size() + kMostPlaces - 1) / kMostPlaces;
  const std::span<const float> row_m = places_.row_m(TourPlaces::here());
  std::vector<TourPlaces::Place> place_of;
  std::vector<ViewPose> views;
  std::vector<double> way_m;
  for (const TourPlaces::Place place : places) {
    if (mix_bits(place) % one_in != 0) continue;
    for (int heading = 0; heading < catalogue_.headings(); ++heading) {
      const ViewPose pose = catalogue_.pose(places_.p_world_m(place), heading);
      const auto is_pose = [&](const ViewPose& other) { return is_same_view(other, pose); };
      if (std::any_of(refused_.begin(), refused_.end(), is_pose)) continue;
      place_of.push_back(place);
      views.push_back(pose);
      way_m.push_back(static_cast<double>(row_m[place]));
    }
  }
  const std::optional<std::size_t> best = most_unseen(model_, belief, views, way_m, scratch);
  if (!best) return false;
  tour_ = {{place_of[*best], views[*best]}};
  price_factor_ = 1.0;  // of what it will find
  return true;
}

/// What no view pays for may be worth going for in the end.
void TourPlanner::search_at_lower_prices() {
  do {
    const double may_stay = config_.end_share * expected_surface(cells_).voxels;
    const bool is_lowest = 0.5 * price_factor_ < config_.end_price;
    if (is_lowest || voxels_in_reach(knowledge()) <= may_stay) return;
    price_factor_ *= 0.5;
  } while (!search_tour());
}

void TourPlanner::replan(const Belief& belief, const ViewPose& current, Scratch& scratch) {
  const int threads = scratch.threads;
  cells_.follow_map(belief.grid);
  space_.follow(belief.grid);
  places_.follow(belief.grid, space_, current.p_world_m);
  at_ = TourPlaces::here();
  find_patches_now(belief, threads);
  look_around(belief, current, threads);
  views_since_replan_ = 0;
  is_due_ = false;
  if (!search_tour() && !explore(belief, scratch)) search_at_lower_prices();
  std::vector<ViewPose> views;
  for (const TourView& view : tour_) views.push_back(view.pose);
  notes_.plan = make_tour_plan(std::move(views), patches_, ledger_.success());
}

/// Straight, or as the lattice knows it; nothing where some leg is not clear after all.
std::optional<std::vector<Vec3>> TourPlanner::way(const Belief& belief, const ViewPose& current,
                                                  TourPlaces::Place to) {
  const double radius_m = model_.validity.collision_radius_m;
  const auto is_clear = [&](const Vec3& a_m, const Vec3& b_m) {
    return is_line_free(belief.grid, a_m, b_m) && is_path_clear(belief.grid, a_m, b_m, radius_m) &&
           model_.no_fly.allows_leg(a_m, b_m);
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

/// Takes the tour's next view that can be flown to; those before it are rejected.
bool TourPlanner::take_view(const Belief& belief, const ViewPose& current,
                            const ViewChecker& checker, int threads, Plan& plan) {
  while (!tour_.empty()) {
    const TourView view = tour_.front();
    tour_.erase(tour_.begin());
    plan.candidates.push_back({.view = view.pose, .sampler = Sampler::tour});
    Candidate& candidate = plan.candidates.back();
    candidate.rejected = checker.rejection_there(view.pose);
    if (!candidate.rejected) {
      if (auto via_m = way(belief, current, view.place)) {
        candidate.via_world_m = std::move(*via_m);
        candidate.path_m =
            path_length_m(current.p_world_m, candidate.via_world_m, view.pose.p_world_m);
      } else {
        candidate.rejected = Rejection::path_blocked;
        places_.forget_ways();
      }
    }
    if (candidate.rejected) {
      refused_.push_back(view.pose);
      is_due_ = true;
      continue;
    }
    const double promised =
        ledger_.promise(catalogue_.look(scene(belief), view.pose, threads), patches_, cells_);
    candidate.score = {.value = promised, .information = promised};
    const int left = static_cast<int>(tour_.size()) + 1;
    choose(plan, plan.candidates.size() - 1, left, left);
    at_ = view.place;
    ++views_since_replan_;
    return true;
  }
  return false;
}

Plan TourPlanner::next(const Belief& belief, const History& history, const ViewPose& current,
                       Scratch& scratch) {
  const int threads = scratch.threads;
  notes_ = {};
  learn(belief, threads);
  notes_.outcomes.assign(ledger_.outcomes().begin(), ledger_.outcomes().end());
  const ValidityConfig& validity = model_.validity;
  const std::vector<ViewPose> recent = recent_views(history, validity.recent_poses);
  refused_ = recent;
  const ViewChecker checker(validity, model_.navigation_m, model_.no_fly, belief.grid, recent,
                            current);
  Plan plan;
  constexpr int kTries = 20;  // tours of which no view could be flown to; each refuses some
  for (int i = 0; i < kTries; ++i) {
    scratch.heed_stop();
    if (is_due_ || tour_.empty() || views_since_replan_ >= config_.views_per_replan) {
      replan(belief, current, scratch);
    } else {
      find_patches_now(belief, threads);
    }
    if (tour_.empty() || take_view(belief, current, checker, threads, plan)) break;
  }
  // no view paid, and none had to be refused
  if (plan.candidates.empty()) plan.end = Termination::tour_complete;
  plan.tour = std::make_shared<const TourNotes>(std::move(notes_));
  return plan;
}

Plan TourPlanner::replay(std::span<const Decision> recorded, const Belief& belief,
                         const History& history, const ViewPose& current, Scratch& scratch) {
  Plan plan = next(belief, history, current, scratch);
  need_as_recorded(plan, recorded, history.decisions.size());
  plan.views = {recorded.front()};
  return plan;
}

}  // namespace gnbv
