// The first stage of a mission: the profile, and what is made of it before the first view.
#include "planner/core/belief.hpp"
#include "planner/motion/free_space.hpp"
#include "tools/mission/mission_state.hpp"
#include "tools/mission/sensing.hpp"

namespace gnbv {
namespace {

/// Flies the legs of the profile while the LIDARs scan. `flown` gets where each began.
std::optional<Termination> scan_profile(Mission& m, ProfileScanner& scanner,
                                        std::vector<ViewPose>& flown) {
  const ProfilingConfig& profiling = m.scenario.planner.profiling;
  const GuidanceConfig& guidance = m.scenario.guidance;
  ProfileRoute route(profiling, m.model.navigation_m, m.current, m.model.no_fly);
  std::size_t looked_at = 0;  // of the sweeps
  bool was_scan = false;
  for (bool is_first = true;; is_first = false) {
    const auto fresh = std::span(scanner.scans()).subspan(looked_at);
    looked_at = scanner.scans().size();
    const bool saw_surface = profiling.method == ProfilingMethod::circular &&
                             sees_surface(fresh, m.model.lidars, m.scenario.planner.floor_z_m);
    const auto leg = route.next(saw_surface);
    const bool is_scan = leg && leg->is_scan;
    // a station of a circular profile takes several legs
    if (was_scan && !is_scan) {
      tell(m, &MissionObserver::on_profile_sweeps, time_s(*m.flight), scanner.scans());
    }
    was_scan = is_scan;
    if (!leg) return std::nullopt;
    const bool scanning = leg->is_scan || (profiling.scan_in_transit && !is_first);
    const double speed_m_s = leg->is_scan ? guidance.profile_speed_m_s : guidance.path_speed_m_s;
    m.out.distance.profile_m += (leg->goal.p_world_m - m.current.p_world_m).norm();
    flown.push_back(m.current);
    const auto over = fly_leg(m, leg->goal, speed_m_s,
                              [&](const Flight& flight) { scanner.tick(flight, scanning); });
    if (over) return over;
    tell(m, &MissionObserver::on_profile, route.share_done());
    if (should_stop(m)) return Termination::interrupted;
  }
}

/// Flies and believes the profile, or takes up a saved one.
std::optional<Termination> take_profile(Mission& m, std::vector<ViewPose>& flown) {
  const ScopeTimer timer(m.out.wall.profile_s);
  const ProfilingConfig& profiling = m.scenario.planner.profiling;
  std::optional<Termination> over;
  if (profiling.method == ProfilingMethod::saved) {
    m.out.belief = read_belief(profiling.file, m.model);
  } else {
    ProfileScanner scanner(m.scene, m.model.lidars, m.scenario.seed);
    over = scan_profile(m, scanner, flown);
    integrate_profile(m.model, scanner.scans(), m.scratch, m.out.belief);
  }
  const auto points = m.out.belief.cloud.points_world_m();
  m.out.profile_points_world_m.assign(points.begin(), points.end());
  m.out.entropy_after_profile_nat = m.out.belief.grid.total_entropy_nat();
  m.out.distance.profile_flown_m = m.flown_m;
  m.out.profile_end_s = time_s(*m.flight);
  if (!over) tell(m, &MissionObserver::on_profile_belief, m.out.belief);
  return over;
}

/// Predicts the other half of a symmetric structure (section 2.3), for a utility that asks for it.
void predict(Mission& m) {
  if (!traits_of(m.scenario.planner).reads_prediction) return;
  const ScopeTimer timer(m.out.wall.symmetry_s);
  Prediction& prediction = m.out.prediction;
  prediction.symmetry = find_symmetry(m.scenario.planner.symmetry, m.out.profile_points_world_m,
                                      m.out.belief.grid, m.scratch.threads);
  prediction.predicted_voxels = predict_surface(prediction.symmetry, m.out.belief.grid);
  prediction.symmetry.mirrored_world_m = {};
}

/// Back to where the views begin: straight when that is clear, else over the top of the workspace
/// or around what is in the way; where nothing of that is known to be clear, as it came.
std::vector<ViewPose> legs_to_first_view(const Mission& m, const std::vector<ViewPose>& flown) {
  const ViewPose& goal = m.out.start;
  const Vec3& from_m = m.current.p_world_m;
  if (is_path_clear(m.out.belief.grid, from_m, goal.p_world_m,
                    m.model.validity.collision_radius_m) &&
      m.model.no_fly.allows_leg(from_m, goal.p_world_m)) {
    return {goal};
  }
  const auto way_m = way_over_the_top(m, from_m, goal.p_world_m);
  std::vector<ViewPose> legs;
  if (!way_m) {
    legs.assign(flown.rbegin(), flown.rend());
    legs.push_back(goal);
    return legs;
  }
  for (const Vec3& p_m : *way_m) {
    legs.push_back(goal);
    legs.back().p_world_m = p_m;
  }
  // straight up, without a turn
  if (legs.front().p_world_m.head<2>() == from_m.head<2>()) {
    const Vec3 up_m = legs.front().p_world_m;
    legs.front() = m.current;
    legs.front().p_world_m = up_m;
  }
  return legs;
}

std::optional<Termination> fly_to_first_view(Mission& m, const std::vector<ViewPose>& flown) {
  const ScopeTimer timer(m.out.wall.fly_s);
  for (const ViewPose& leg : legs_to_first_view(m, flown)) {
    m.out.distance.transfer_m += (leg.p_world_m - m.current.p_world_m).norm();
    if (const auto over = fly_leg(m, leg)) return over;
  }
  m.flown_m = 0.0;
  return std::nullopt;
}

}  // namespace

std::optional<Termination> fly_profile(Mission& m) {
  std::vector<ViewPose> flown;
  if (const auto over = take_profile(m, flown)) return over;
  if (should_stop(m)) return Termination::interrupted;
  predict(m);
  if (const auto over = fly_to_first_view(m, flown)) return over;
  remember_start(m.out.belief, m.history);
  return std::nullopt;
}

}  // namespace gnbv
