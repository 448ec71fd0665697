#include "planner/tour/tour_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/motion/paths.hpp"
#include "planner/tour/gains.hpp"
#include "planner/tour/timed_tour.hpp"
#include "planner/tour/unseen_space.hpp"

namespace gnbv {
namespace {

// Nodes that are observed again at each replan: those around which the surface changed most. All of
// them cost ten times as much and change no tour by more than its seed does.
constexpr std::size_t kObservedAgain = 80;
// So many views of the tour after the next are told with it: what a vehicle that passes views needs
// to know in time.
constexpr std::size_t kViewsAhead = 3;
// Of all expected voxels: once no more than this is left, the cost of a metre falls no further.
// Cameras miss more than this of surface that they have seen three times.
constexpr double kEndShare = 0.003;

/// What the steps work on.
struct Step {
  const TourConfig& config;
  const PlannerModel& model;
  const Belief& belief;
  const ViewPose& current;
  Scratch& scratch;
  TourState& state;
  const HeedStop stop = [this] { scratch.heed_stop(); };

  TourScene scene() const { return {config, state.cells, state.patches}; }
  /// What a unit of way has to bring, in small voxels.
  double price() const { return config.price * expected_surface(state.cells).voxels_a_metre(); }
  FreeSpace free_space() const {
    return {.grid = belief.grid,
            .navigation_m = model.navigation_m,
            .no_fly = model.no_fly,
            .radius_m = model.validity.collision_radius_m,
            .allow_unknown = model.validity.allow_unknown,
            .leg_radius_m = leg_radius_m(model.validity),
            .leg_keeps_start_room = true};
  }
  void follow_roadmap() const {
    state.roadmap.follow(free_space(), state.space, current.p_world_m, stop);
  }
};

/// Frames within this of the last one see what that saw.
constexpr double kLook_m = 0.5;
constexpr double kLook_rad = deg_to_rad(15.0);

bool has_frames_between(const PlannerModel& model) {
  return std::any_of(model.sights.begin(), model.sights.end(),
                     [](const CameraModel& camera) { return camera.config.rate_hz > 0.0; });
}

/// What the frames since the last plan saw of the patches of that plan, each patch once.
std::vector<SeenPatch> seen_since(const Step& step) {
  const TourState& state = step.state;
  std::vector<FramePose> kept(step.model.sights.size(), {.camera = -1});
  std::vector<FramePose> looks;
  for (const FramePose& look : std::span(step.belief.frame_poses).subspan(state.frames_taken)) {
    FramePose& last = kept[static_cast<std::size_t>(look.camera)];
    const Isometry T_last_look = last.T_world_camera.inverse() * look.T_world_camera;
    const bool is_new = last.camera < 0 || T_last_look.translation().norm() > kLook_m ||
                        Eigen::AngleAxisd(T_last_look.linear()).angle() > kLook_rad;
    if (is_new) looks.push_back(last = look);
  }
  return step.state.visibility.observe(step.scene(), looks, step.scratch.threads);
}

/// Adds what the last view brought to the surface, and learns from it.
void update_surface(const Step& step) {
  TourState& state = step.state;
  const std::span<const FramePose> looks =
      std::span(step.belief.frame_poses).subspan(state.frames_taken);
  if (has_frames_between(step.model)) {
    state.calibration.note(seen_since(step), state.patches, state.cells);
  }
  const std::span<const Vec3f> fresh =
      step.belief.cloud.points_world_m().subspan(state.points_taken);
  state.points_taken += fresh.size();
  const std::span<const Vec3f> ranged =
      step.belief.ranged.points_world_m().subspan(state.ranged_taken);
  state.ranged_taken += ranged.size();
  state.cells.add(ranged, step.belief.grid, step.scratch.threads, step.stop, false);
  state.cells.add(
      fresh, step.belief.grid, step.scratch.threads, step.stop, true,
      certainties(fresh, looks, step.model.sights, SurfaceCells::kNear * state.cells.detail_m()));
  state.frames_taken = step.belief.frame_poses.size();
  const Gain gain = state.calibration.settle(state.cells);
  const bool is_short = gain.found < step.config.replan_below * gain.predicted;
  if (is_short && gain.predicted - gain.found > step.price()) state.is_due = true;
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
  state.visibility.follow(step.scene(), state.roadmap, first, kObservedAgain, threads, step.stop);
  if (!step.config.surface_views) return;
  const std::vector<Vec3> more_m =
      points_for_unseen({step.belief.grid, state.space, step.model.sights}, state.patches,
                        state.seen_from_anywhere(), state.searched);
  if (more_m.empty()) return;
  for (const Vec3& p_m : more_m) state.roadmap.add(p_m);
  step.follow_roadmap();
  state.visibility.follow(step.scene(), state.roadmap, {}, 0, threads, step.stop);
}

/// The tour in seconds, with what frames on the way see.
std::vector<std::uint32_t> solve_in_seconds(const Step& step, TourProblem& task,
                                            std::span<const std::uint32_t> from,
                                            std::uint64_t seed) {
  const TourState& state = step.state;
  const auto headings = static_cast<std::size_t>(state.visibility.headings());
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> view_of(state.roadmap.size() * headings, kNone);
  std::vector<ViewPose> poses;
  for (std::uint32_t view = 0; view < task.views.size(); ++view) {
    const auto& [node, pose] = task.views[view];
    poses.push_back(pose);
    view_of[node * headings + static_cast<std::size_t>(state.visibility.heading_near(pose))] = view;
  }
  TimedProblem problem{
      .views = &task.problem, .poses = poses, .start = step.current, .travel = &step.model.travel};
  if (has_frames_between(step.model)) {
    problem.view_at = [&](const ViewPose& pose) -> std::optional<std::uint32_t> {
      const Roadmap::Node node = state.roadmap.nearest(pose.p_world_m);
      const std::uint32_t view =
          view_of[node * headings + static_cast<std::size_t>(state.visibility.heading_near(pose))];
      return view == kNone ? std::nullopt : std::optional(view);
    };
  }
  return solve(problem, from, step.config.iterations, seed);
}

/// Whether some view pays at what a metre costs now: then the tour is that of the best views.
bool solve_tour(const Step& step) {
  TourState& state = step.state;
  TourProblem task =
      make_tour_problem(step.config, state, state.cost_factor * step.price(), step.stop);
  task.problem.row_m = [&](std::uint32_t node) {
    step.stop();
    return state.roadmap.row_m(node, step.stop);
  };
  std::vector<std::uint32_t> from;
  for (const TourView& left : state.tour) {
    const auto same = std::find(task.views.begin(), task.views.end(), left);
    if (same == task.views.end()) continue;
    from.push_back(static_cast<std::uint32_t>(same - task.views.begin()));
  }
  const std::uint64_t seed =
      random_bits({step.model.seed, Stream::tour_search, state.searches++, 0});
  const std::vector<std::uint32_t> found =
      step.config.cost == TourCost::seconds
          ? solve_in_seconds(step, task, from, seed)
          : solve(task.problem, from, step.config.iterations, seed).views;
  state.tour.clear();
  for (const std::uint32_t view : found) state.tour.push_back(task.views[view]);
  return !state.tour.empty();
}

/// Whether a view sees enough unknown space, of all or of a hull: then the tour is that which sees
/// the most for its way.
bool explore(const Step& step, const SurfaceHull* within = nullptr) {
  TourState& state = step.state;
  constexpr std::size_t kMostNodes = 160;
  std::vector<Roadmap::Node> nodes;
  for (const Roadmap::Node node : state.roadmap.reachable()) {
    const bool is_far = within != nullptr &&
                        within->off_m(state.roadmap.p_world_m(node)) > state.visibility.reach_m();
    if (!is_far) nodes.push_back(node);
  }
  const std::size_t one_in = (nodes.size() + kMostNodes - 1) / kMostNodes;
  const std::span<const float> row_m = state.roadmap.row_m(Roadmap::here(), step.stop);
  std::vector<TourView> views;
  std::vector<double> way_m;
  for (const Roadmap::Node node : nodes) {
    if (mix_bits(node) % one_in != 0) continue;
    for (int heading = 0; heading < state.visibility.headings(); ++heading) {
      const ViewPose pose = state.visibility.pose(state.roadmap.p_world_m(node), heading);
      if (state.is_refused(pose)) continue;
      views.push_back({node, pose});
      way_m.push_back(row_m[node]);
    }
  }
  const std::optional<std::size_t> best =
      most_unseen(step.model, step.belief, views, way_m, step.scratch, within);
  if (!best) return false;
  state.tour = {views[*best]};
  state.cost_factor = 1.0;  // of what it will find
  return true;
}

/// What no view pays for may be worth going for in the end.
void solve_at_lower_costs(const Step& step) {
  do {
    const double may_stay = kEndShare * expected_surface(step.state.cells).voxels;
    const bool is_lowest = 0.5 * step.state.cost_factor < step.config.end_price;
    if (is_lowest || step.state.voxels_in_reach() <= may_stay) return;
    step.state.cost_factor *= 0.5;
  } while (!solve_tour(step));
}

/// Whether unknown space in the hull of the surface is worth a look, at the end: that of a building
/// whose open side nobody passed. It is not after some such looks that brought no surface.
bool look_inside(const Step& step) {
  constexpr int kTries = 3;
  TourState& state = step.state;
  const double voxels = expected_surface(state.cells).voxels;
  const bool has_grown = voxels > (1.0 + kEndShare) * state.voxels_at_look;
  state.looks_in_vain = has_grown ? 0 : state.looks_in_vain + 1;
  state.voxels_at_look = voxels;
  if (state.looks_in_vain >= kTries) return false;
  const SurfaceHull hull(state.cells);
  return explore(step, &hull);
}

/// Where no node can be reached: the open voxels about the vehicle become nodes.
void add_nodes_at_hand(const Step& step) {
  TourState& state = step.state;
  const OccupancyGrid& grid = step.belief.grid;
  const GridGeometry& voxels = grid.geometry();
  constexpr std::int32_t kSteps = 4;  // to each side, twice the radius
  const double step_m = 2.0 * step.model.validity.collision_radius_m / kSteps;
  const auto stride = std::max(1, static_cast<std::int32_t>(step_m / voxels.resolution_m()));
  const Key here = voxels.key_of(step.current.p_world_m);
  for_each_key(keys_about({0, 0, 0}, kSteps), [&](const Key& offset) {
    const Key key = {here[0] + stride * offset[0], here[1] + stride * offset[1],
                     here[2] + stride * offset[2]};
    if (voxels.contains(key) && state.space.is_open(grid, key))
      state.roadmap.add(voxels.center_m(key));
  });
  step.follow_roadmap();
}

TourPlan replan(const Step& step, bool may_explore) {
  TourState& state = step.state;
  state.cells.follow_map(step.belief.grid);
  state.space.follow(step.belief.grid, step.stop);
  step.follow_roadmap();
  state.at = Roadmap::here();
  predict_gains(step);
  observe_nodes(step);
  if (state.roadmap.reachable().empty()) {
    add_nodes_at_hand(step);
    observe_nodes(step);
  }
  state.views_since_replan = 0;
  state.is_due = false;
  if (!solve_tour(step) && !(may_explore && explore(step))) solve_at_lower_costs(step);
  if (state.tour.empty()) look_inside(step);
  std::vector<ViewPose> views;
  for (const TourView& view : state.tour) views.push_back(view.pose);
  return make_tour_plan(std::move(views), state.patches, state.calibration.yield());
}

/// Straight, or as the roadmap knows it; blocked where some leg is not free after all.
FoundPath path_to(const Step& step, const ViewChecker& checker, const TourView& view) {
  if (const auto rejected = checker.rejection_there(view.pose)) return {rejected};
  const FreeSpace space = step.free_space();
  Roadmap& roadmap = step.state.roadmap;
  const Vec3& to_m = roadmap.p_world_m(view.node);
  Vec3 from_m = step.current.p_world_m;
  if (space.is_leg_free(from_m, to_m)) return {};
  if (!std::isfinite(roadmap.row_m(step.state.at, step.stop)[view.node])) {
    return {Rejection::path_blocked};
  }
  std::vector<Vec3> points_m = roadmap.via_world_m(step.state.at, view.node);
  points_m.push_back(to_m);
  for (const Vec3& next_m : points_m) {
    if (!space.is_leg_free(from_m, next_m)) return {Rejection::path_blocked};
    from_m = next_m;
  }
  points_m.pop_back();
  return {{}, std::move(points_m)};
}

/// The next views of the tour, from a node on, with the points between them.
std::vector<Onward> way_onward(const Step& step, Roadmap::Node from) {
  std::vector<Onward> onward;
  for (const TourView& view :
       std::span(step.state.tour).first(std::min(kViewsAhead, step.state.tour.size()))) {
    if (!std::isfinite(step.state.roadmap.row_m(from, step.stop)[view.node])) break;
    for (const Vec3& via_m : step.state.roadmap.via_world_m(from, view.node)) {
      onward.push_back({{via_m, view.pose.yaw_rad}, false});
    }
    onward.push_back({view.pose});
    from = view.node;
  }
  return onward;
}

/// Whether a view of a tour in seconds is no longer worth the way by it: frames on the way to the
/// views before it have seen what it was for.
bool passes_over(const Step& step, const TourView& view, double gain) {
  const TourState& state = step.state;
  if (step.config.cost != TourCost::seconds || state.tour.empty()) return false;
  const auto leg_s = [&](const ViewPose& a, const ViewPose& b) {
    return step.model.travel.leg_s((a.p_world_m - b.p_world_m).norm(),
                                   wrap_angle_rad(b.yaw_rad - a.yaw_rad));
  };
  const ViewPose& next = state.tour.front().pose;
  const double detour_s =
      leg_s(step.current, view.pose) + leg_s(view.pose, next) - leg_s(step.current, next);
  const double price = 0.5 * state.cost_factor * step.price();
  return gain < price * (detour_s + step.config.seconds_per_view);
}

/// Hands out the tour's next view that can be flown to; those before it are rejected.
bool hand_out_view(const Step& step, const ViewChecker& checker, Plan& plan) {
  TourState& state = step.state;
  while (!state.tour.empty()) {
    const int left = static_cast<int>(state.tour.size());
    const TourView view = state.tour.front();
    state.tour.erase(state.tour.begin());
    FoundPath path = path_to(step, checker, view);
    Candidate& candidate = plan.candidates.emplace_back(
        Candidate{.view = view.pose, .sampler = Sampler::tour, .rejected = path.rejected});
    if (path.rejected) {
      if (path.rejected == Rejection::path_blocked) state.roadmap.forget_ways();
      state.refused.push_back(view.pose);
      state.is_due = true;
      continue;
    }
    const std::vector<SeenPatch> seen =
        state.visibility.observe(step.scene(), view.pose, step.scratch.threads);
    const double gain = state.calibration.expected(seen, state.patches);
    if (passes_over(step, view, gain)) {
      plan.candidates.pop_back();
      continue;
    }
    candidate.path_m = checker.length_m(path, view.pose);
    candidate.via_world_m = std::move(path.via_world_m);
    // of frames between views too, it learns from where they were taken
    if (!has_frames_between(step.model)) state.calibration.note(seen, state.patches, state.cells);
    candidate.score = {.value = gain, .information = gain};
    choose(plan, plan.candidates.size() - 1, left, left);
    plan.views.back().then = way_onward(step, view.node);
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
  std::vector<Onward> then = plan.has_view() ? plan.next().then : std::vector<Onward>();
  plan.views = {recorded.front()};
  plan.views.front().then = std::move(then);
  return plan;
}

}  // namespace gnbv
