#include "planner/tour/tour_planner.hpp"

#include <algorithm>
#include <cmath>

#include "planner/core/belief.hpp"
#include "planner/core/planner.hpp"
#include "planner/motion/view_checker.hpp"
#include "planner/tour/tour_notes.hpp"
#include "planner/tour/tour_problem.hpp"
#include "planner/tour/unseen_space.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

// nodes observed again, a replan: those around which the surface changed most. Casting all costs
// ten times as much and changes no tour by more than its seed does
constexpr std::size_t kObservedAgain = 80;
// of all expected voxels: when no more is left, the end pays at no lower cost of a metre. Less than
// this is what cameras miss of surface that they have seen three times
constexpr double kEndShare = 0.003;

/// What the steps work on.
struct Step {
  const TourConfig& config;
  const PlannerModel& model;
  const Belief& belief;
  const ViewPose& current;
  Scratch& scratch;
  TourState& state;

  TourScene scene() const { return {config, state.cells, state.patches}; }
  /// What a metre has to bring, in small voxels.
  double cost_per_m() const {
    return config.price * expected_surface(state.cells).voxels_a_metre();
  }
  std::function<void()> heed_stop() const {
    return [this] { scratch.heed_stop(); };
  }
};

/// Adds what the last view brought to the surface, and learns from it.
void update_surface(const Step& step) {
  TourState& state = step.state;
  const std::span<const Vec3f> points = step.belief.cloud.points_world_m();
  state.cells.add(points.subspan(state.points_taken), step.belief.grid, step.scratch.threads);
  state.points_taken = points.size();
  state.calibration.settle(state.cells);
  const double found = state.calibration.found();
  const double predicted = state.calibration.predicted();
  const bool is_short = found < step.config.replan_below * predicted;
  if (is_short && predicted - found > step.cost_per_m()) state.is_due = true;
}

/// Finds what the surface lacks, and how much of it observations can be expected to bring.
void predict_gains(const Step& step) {
  step.state.patches = find_patches(step.state.cells, step.belief.grid, step.scratch.threads);
  step.state.calibration.set_reliability(step.state.patches);
}

/// Finds what each node would see, those included that the surface asks for.
void observe_nodes(const Step& step) {
  TourState& state = step.state;
  const int threads = step.scratch.threads;
  std::vector<Roadmap::Node> first;
  for (const TourView& view : state.tour) first.push_back(view.node);
  state.visibility.follow(step.scene(), state.roadmap, first, kObservedAgain, threads,
                          step.heed_stop());
  if (!step.config.surface_views) return;
  const std::vector<Vec3> more_m =
      points_for_unseen({step.belief.grid, state.space, state.cameras}, state.patches,
                        seen_from_anywhere(state), state.searched);
  if (more_m.empty()) return;
  for (const Vec3& p_m : more_m) state.roadmap.add(p_m);
  state.roadmap.follow(step.belief.grid, state.space, step.current.p_world_m);
  state.visibility.follow(step.scene(), state.roadmap, {}, 0, threads, step.heed_stop());
}

/// Whether some view pays at what a metre costs now: then the tour is that of the best views.
bool solve_tour(const Step& step) {
  TourState& state = step.state;
  TourProblem task = make_tour_problem(step.config, state, state.cost_factor * step.cost_per_m());
  task.problem.row_m = [&state](std::uint32_t node) { return state.roadmap.row_m(node); };
  std::vector<std::uint32_t> from;
  for (const TourView& left : state.tour) {
    const auto same = std::find_if(task.views.begin(), task.views.end(), [&](const TourView& v) {
      return v.node == left.node && is_same_view(v.pose, left.pose);
    });
    if (same != task.views.end()) {
      from.push_back(static_cast<std::uint32_t>(same - task.views.begin()));
    }
  }
  const TourSearch search = {
      .iterations = step.config.iterations,
      .seed = random_bits({step.model.seed, Stream::tour_search, state.searches++, 0}),
      .heed_stop = step.heed_stop()};
  const OrienteeringTour found = solve(task.problem, from, search);
  state.tour.clear();
  for (const std::uint32_t view : found.views) state.tour.push_back(task.views[view]);
  return !state.tour.empty();
}

/// Whether a view sees enough unknown space: then the tour is that which sees the most for its way.
bool explore(const Step& step) {
  TourState& state = step.state;
  constexpr std::size_t kMostNodes = 160;
  std::vector<Roadmap::Node> nodes;
  for (Roadmap::Node node = 1; node < state.roadmap.size(); ++node) {
    if (state.roadmap.is_reachable(node)) nodes.push_back(node);
  }
  const std::size_t one_in = (nodes.size() + kMostNodes - 1) / kMostNodes;
  const std::span<const float> row_m = state.roadmap.row_m(Roadmap::here());
  std::vector<Roadmap::Node> node_of;
  std::vector<ViewPose> views;
  std::vector<double> way_m;
  for (const Roadmap::Node node : nodes) {
    if (mix_bits(node) % one_in != 0) continue;
    for (int heading = 0; heading < state.visibility.headings(); ++heading) {
      const ViewPose pose = state.visibility.pose(state.roadmap.p_world_m(node), heading);
      const auto is_pose = [&](const ViewPose& other) { return is_same_view(other, pose); };
      if (std::any_of(state.refused.begin(), state.refused.end(), is_pose)) continue;
      node_of.push_back(node);
      views.push_back(pose);
      way_m.push_back(static_cast<double>(row_m[node]));
    }
  }
  const std::optional<std::size_t> best =
      most_unseen(step.model, step.belief, views, way_m, step.scratch);
  if (!best) return false;
  state.tour = {{node_of[*best], views[*best]}};
  state.cost_factor = 1.0;  // of what it will find
  return true;
}

/// What no view pays for may be worth going for in the end.
void solve_at_lower_costs(const Step& step) {
  do {
    const double may_stay = kEndShare * expected_surface(step.state.cells).voxels;
    const bool is_lowest = 0.5 * step.state.cost_factor < step.config.end_price;
    if (is_lowest || voxels_in_reach(step.state) <= may_stay) return;
    step.state.cost_factor *= 0.5;
  } while (!solve_tour(step));
}

TourPlan replan(const Step& step, bool may_explore) {
  TourState& state = step.state;
  state.cells.follow_map(step.belief.grid);
  state.space.follow(step.belief.grid);
  state.roadmap.follow(step.belief.grid, state.space, step.current.p_world_m);
  state.at = Roadmap::here();
  predict_gains(step);
  observe_nodes(step);
  state.views_since_replan = 0;
  state.is_due = false;
  if (!solve_tour(step) && !(may_explore && explore(step))) solve_at_lower_costs(step);
  std::vector<ViewPose> views;
  for (const TourView& view : state.tour) views.push_back(view.pose);
  return make_tour_plan(std::move(views), state.patches, state.calibration.yield());
}

/// Straight, or as the roadmap knows it; blocked where some leg is not free after all.
FoundPath path_to(const Step& step, Roadmap::Node to) {
  const PlannerModel& model = step.model;
  const FreeSpace space{step.belief.grid, model.navigation_m, model.no_fly,
                        model.validity.collision_radius_m};
  Roadmap& roadmap = step.state.roadmap;
  const Vec3& to_m = roadmap.p_world_m(to);
  Vec3 from_m = step.current.p_world_m;
  if (space.is_leg_free(from_m, to_m)) return {};
  if (!std::isfinite(roadmap.row_m(step.state.at)[to])) return {Rejection::path_blocked, {}};
  std::vector<Vec3> points_m = roadmap.via_world_m(step.state.at, to);
  points_m.push_back(to_m);
  for (const Vec3& next_m : points_m) {
    if (!space.is_leg_free(from_m, next_m)) return {Rejection::path_blocked, {}};
    from_m = next_m;
  }
  points_m.pop_back();
  return {{}, std::move(points_m)};
}

Candidate checked(const Step& step, const ViewChecker& checker, const TourView& view) {
  Candidate candidate{.view = view.pose, .sampler = Sampler::tour};
  candidate.rejected = checker.rejection_there(view.pose);
  if (candidate.rejected) return candidate;
  FoundPath path = path_to(step, view.node);
  candidate.rejected = path.rejected;
  if (path.rejected) {
    step.state.roadmap.forget_ways();
  } else {
    candidate.path_m = checker.length_m(path, view.pose);
    candidate.via_world_m = std::move(path.via_world_m);
  }
  return candidate;
}

/// Hands out the tour's next view that can be flown to; those before it are rejected.
bool hand_out_view(const Step& step, const ViewChecker& checker, Plan& plan) {
  TourState& state = step.state;
  while (!state.tour.empty()) {
    const TourView view = state.tour.front();
    state.tour.erase(state.tour.begin());
    Candidate& candidate = plan.candidates.emplace_back(checked(step, checker, view));
    if (candidate.rejected) {
      state.refused.push_back(view.pose);
      state.is_due = true;
      continue;
    }
    const double gain = state.calibration.predict(
        state.visibility.observe(step.scene(), view.pose, step.scratch.threads), state.patches,
        state.cells);
    candidate.score = {.value = gain, .information = gain};
    const int left = static_cast<int>(state.tour.size()) + 1;
    choose(plan, plan.candidates.size() - 1, left, left);
    state.at = view.node;
    ++state.views_since_replan;
    return true;
  }
  return false;
}

}  // namespace

Plan TourPlanner::next(const Belief& belief, const History& history, const ViewPose& current,
                       Scratch& scratch) {
  const Step step{config_, model_, belief, current, scratch, state_};
  const std::vector<ViewPose> recent = recent_views(history, model_.validity.recent_poses);
  const ViewChecker checker(model_.validity, model_.navigation_m, model_.no_fly, belief.grid,
                            recent, current);
  TourNotes notes;
  state_.refused = recent;
  update_surface(step);
  notes.outcomes.assign(state_.calibration.outcomes().begin(), state_.calibration.outcomes().end());
  Plan plan;
  constexpr int kTries = 20;  // tours of which no view could be flown to; each refuses some
  for (int i = 0; i < kTries; ++i) {
    scratch.heed_stop();
    const bool is_flown = state_.views_since_replan >= config_.views_per_replan;
    if (state_.is_due || state_.tour.empty() || is_flown) {
      notes.plan = replan(step, config_.explore && !has_profile_);
    } else {
      predict_gains(step);
    }
    if (state_.tour.empty() || hand_out_view(step, checker, plan)) break;
  }
  // no view paid, and none had to be refused
  if (plan.candidates.empty()) plan.end = Termination::tour_complete;
  plan.tour = std::make_shared<const TourNotes>(std::move(notes));
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
