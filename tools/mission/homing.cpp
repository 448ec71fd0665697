#include <algorithm>

#include "planner/motion/paths.hpp"
#include "sim/flight/guidance.hpp"
#include "sim/flight/rotors.hpp"
#include "tools/mission/mission_state.hpp"

namespace gnbv {
namespace {

constexpr PathSearchConfig kSearch = {.max_expansions = 20000};  // a mission asks twice a view
constexpr double kNoLeg_m = 0.01;

bool has_battery(const Mission& m) { return m.scenario.vehicle.power.battery_wh > 0.0; }

/// Back through the places of all views to that of the first one, which is home.
std::vector<Vec3> as_it_came(const Mission& m) {
  std::vector<Vec3> way_m;
  if (!m.taken_at_m.empty()) way_m.push_back(m.taken_at_m.back());
  for (std::size_t i = m.taken_at_m.size(); i-- > 1;) {
    const Decision& decision = m.history.decisions[i];
    const bool was_reached =
        (decision.view.p_world_m - m.taken_at_m[i]).norm() < m.model.validity.collision_radius_m;
    const std::vector<Vec3>& via_m = decision.via_world_m;
    if (was_reached) way_m.insert(way_m.end(), via_m.rbegin(), via_m.rend());
    way_m.push_back(m.taken_at_m[i - 1]);
  }
  way_m.push_back(m.out.start.p_world_m);
  return way_m;
}

/// As after the profile.
std::vector<Vec3> over_the_top(const Mission& m, const Vec3& from_world_m, bool reads_map) {
  const Vec3& home_m = m.out.start.p_world_m;
  if ((home_m - from_world_m).norm() < m.scenario.guidance.arrival_distance_m) return {home_m};
  auto way_m = way_over_the_top(m, from_world_m, home_m, reads_map);
  return way_m ? *std::move(way_m) : as_it_came(m);
}

std::optional<std::vector<Vec3>> found_way(const Mission& m, const Vec3& from_world_m) {
  const Vec3& home_m = m.out.start.p_world_m;
  FoundPath way = find_path(kSearch, free_space(m), from_world_m, home_m);
  if (way.rejected) return std::nullopt;
  way.via_world_m.push_back(home_m);
  return std::move(way.via_world_m);
}

/// Along the points; on the way to the first of them the vehicle turns to `yaw_rad`.
double energy_along_wh(const Mission& m, const ViewPose& from, std::span<const Vec3> way_m,
                       double yaw_rad) {
  double sum_wh = 0.0;
  ViewPose at = from;
  for (const Vec3& to_m : way_m) {
    if ((to_m - at.p_world_m).norm() < kNoLeg_m && at.yaw_rad == yaw_rad) continue;
    const ViewPose to = {to_m, yaw_rad};
    sum_wh += leg_energy_wh(m.scenario.vehicle, m.scenario.guidance, at, to);
    at = to;
  }
  return sum_wh;
}

/// The same without a turn, as the vehicle flies home.
double energy_along_wh(const Mission& m, const Vec3& from_world_m, std::span<const Vec3> way_m) {
  return energy_along_wh(m, {from_world_m, 0.0}, way_m, 0.0);
}

/// How much more than a still hover the flight has drawn so far: a wind costs on the way home, too.
double measured_excess(const Mission& m) {
  const double hover_wh =
      hover_power_w(m.scenario.vehicle) * time_s(*m.flight) / kJoulesPerWattHour;
  return hover_wh > 0.0 ? std::max(1.0, m.flight->energy_wh() / hover_wh) : 1.0;
}

Exit make_exit(const Mission& m, const Vec3& p_world_m, std::vector<Vec3> way_world_m) {
  const double way_wh = energy_along_wh(m, p_world_m, way_world_m);
  return {p_world_m, std::move(way_world_m), way_wh};
}

double energy_by_wh(const Mission& m, const Vec3& from_world_m, const Exit& exit) {
  return energy_along_wh(m, from_world_m, {&exit.p_world_m, 1}) + exit.way_wh;
}

/// The one by which the way home takes the least; none: home leads over the top.
const Exit* best_exit(const Mission& m, const Vec3& from_world_m) {
  const auto best =
      std::min_element(m.exits.begin(), m.exits.end(), [&](const Exit& a, const Exit& b) {
        return energy_by_wh(m, from_world_m, a) < energy_by_wh(m, from_world_m, b);
      });
  return best == m.exits.end() ? nullptr : &*best;
}

double energy_home_wh(const Mission& m, const Vec3& from_world_m) {
  const Exit* const exit = best_exit(m, from_world_m);
  return measured_excess(m) *
         (exit != nullptr ? energy_by_wh(m, from_world_m, *exit)
                          : energy_along_wh(m, from_world_m, over_the_top(m, from_world_m, false)));
}

/// The points, then the exit's place and its way.
std::vector<Vec3> joined(std::vector<Vec3> points_m, const Exit& exit) {
  points_m.push_back(exit.p_world_m);
  points_m.insert(points_m.end(), exit.way_world_m.begin(), exit.way_world_m.end());
  return points_m;
}

/// Between two exits: at each point of the way the cheaper of back to the one and on to the other.
std::vector<Exit> corners_between(const Mission& m, const Exit& here, std::span<const Vec3> via_m,
                                  const Exit& there) {
  std::vector<Exit> corners = {here};
  for (std::size_t i = 0; i < via_m.size(); ++i) {
    std::vector<Vec3> back_m(via_m.begin(), via_m.begin() + static_cast<std::ptrdiff_t>(i));
    std::reverse(back_m.begin(), back_m.end());
    back_m = joined(std::move(back_m), here);
    std::vector<Vec3> on_m =
        joined({via_m.begin() + static_cast<std::ptrdiff_t>(i) + 1, via_m.end()}, there);
    Exit back = make_exit(m, via_m[i], std::move(back_m));
    Exit on = make_exit(m, via_m[i], std::move(on_m));
    corners.push_back(back.way_wh <= on.way_wh ? std::move(back) : std::move(on));
  }
  corners.push_back(there);
  return corners;
}

/// What coming home with `way_wh` and landing there would leave, beside the reserve.
bool is_enough(const Mission& m, double way_wh) {
  const PowerParameters& power = m.scenario.vehicle.power;
  const double landing_wh =
      measured_excess(m) * landing_energy_wh(m.scenario.vehicle, m.out.start.p_world_m.z());
  return m.flight->energy_wh() + way_wh + landing_wh + power.reserve_share * power.battery_wh <
         power.battery_wh;
}

Vec3 believed_p_world_m(const Mission& m) {
  return m.flight->estimate().T_world_body.translation();
}

/// Until the rotors stand still, the structure is hit, or much more time has gone by than it takes.
bool land(Mission& m) {
  const double z_m = std::max(0.0, believed_p_world_m(m).z());
  const CommanderParameters& commander = m.scenario.vehicle.autopilot.commander;
  const double limit_s = 2.0 * z_m / commander.land_speed_m_s + m.scenario.guidance.timeout_s;
  const double end_s = time_s(*m.flight) + limit_s;
  m.flight->land();
  while (!m.flight->has_landed() && !m.flight->has_collided() && time_s(*m.flight) < end_s) {
    m.flight->step();
    keep_track(m);
  }
  if (m.flight->has_collided()) m.out.termination = Termination::collision;
  return m.flight->has_landed();
}

/// From where it rests: by the exit that takes the least of those to which a leg is clear.
std::vector<Vec3> way_home(Mission& m) {
  const Vec3 here_m = believed_p_world_m(m);
  if (m.exits.empty()) return over_the_top(m, here_m, true);
  std::erase_if(m.exits, [&, space = leg_space(m)](const Exit& exit) {
    return !space.is_leg_clear(here_m, exit.p_world_m);
  });
  if (!m.exits.empty()) return joined({}, *best_exit(m, here_m));
  return found_way(m, here_m).value_or(as_it_came(m));
}

/// Where a leg was given up, it flies on to a later point to which a free leg leads, or by a way
/// found anew, or tries again; after some tries it stays where it is.
void fly_way_home(Mission& m, double yaw_rad) {
  constexpr int kTries = 10;
  std::vector<Vec3> way_m = way_home(m);
  const int given_up = m.out.legs_timed_out;
  for (std::size_t i = 0; i < way_m.size();) {
    if ((way_m[i] - believed_p_world_m(m)).norm() < m.scenario.guidance.arrival_distance_m) {
      ++i;
      continue;
    }
    const int before = m.out.legs_timed_out;
    const auto over = fly_leg(m, {way_m[i], yaw_rad});
    if (over && *over != Termination::battery) m.out.termination = *over;
    if (over || m.out.legs_timed_out - given_up > kTries) return;
    if (m.out.legs_timed_out == before) {
      ++i;
      continue;
    }
    const auto later =
        std::find_if(way_m.begin() + static_cast<std::ptrdiff_t>(i) + 1, way_m.end(),
                     [&, here_m = believed_p_world_m(m), space = free_space(m)](const Vec3& p_m) {
                       return space.is_leg_free(here_m, p_m);
                     });
    if (later != way_m.end()) {
      i = static_cast<std::size_t>(later - way_m.begin());
    } else if (auto found_m = found_way(m, believed_p_world_m(m))) {
      way_m = *std::move(found_m);
      i = 0;
    }
  }
}

}  // namespace

bool has_energy_to_go_on(const Mission& m) {
  if (!has_battery(m)) return true;
  const VehicleConfig& vehicle = m.scenario.vehicle;
  const Vec3 p_m = believed_p_world_m(m);
  if (vehicle.power.return_home && !m.is_homing) {
    return is_enough(m, energy_home_wh(m, p_m));
  }
  return m.flight->energy_wh() + landing_energy_wh(vehicle, p_m.z()) < vehicle.power.battery_wh;
}

std::vector<Exit> exits_here(const Mission& m) {
  if (!m.scenario.vehicle.power.return_home) return {};
  auto way_m = found_way(m, m.current.p_world_m);
  return {make_exit(m, m.current.p_world_m, way_m ? std::move(*way_m) : as_it_came(m))};
}

bool can_afford(Mission& m, const Decision& next) {
  if (!m.scenario.vehicle.power.return_home) return true;
  const Exit here = m.exits.front();
  auto way_m = found_way(m, next.view.p_world_m);
  if (!way_m) way_m = joined({next.via_world_m.rbegin(), next.via_world_m.rend()}, here);
  const Exit there = make_exit(m, next.view.p_world_m, std::move(*way_m));
  std::vector<Vec3> leg_m = next.via_world_m;
  leg_m.push_back(there.p_world_m);
  const double way_wh = energy_along_wh(m, m.current, leg_m, next.view.yaw_rad) + there.way_wh;
  if (has_battery(m) && !is_enough(m, measured_excess(m) * way_wh)) return false;
  m.corners = corners_between(m, here, next.via_world_m, there);
  return true;
}

bool ends_at_home(const Mission& m, Termination reason) {
  return m.scenario.vehicle.power.return_home && reason != Termination::collision &&
         reason != Termination::off_course && reason != Termination::interrupted;
}

void fly_home(Mission& m) {
  m.is_homing = true;
  const double flown_before_m = m.flown_m;
  HomeFlight home;
  fly_way_home(m, m.current.yaw_rad);
  home.reached = (believed_p_world_m(m) - m.out.start.p_world_m).norm() <
                 m.scenario.planner.validity.collision_radius_m;
  const bool has_ground = m.scenario.structure.ground || !m.scenario.terrain.path.empty();
  const bool may_land = has_ground && !m.flight->has_collided();
  if (may_land) home.landed = land(m);
  home.flown_m = m.flown_m - flown_before_m;
  m.out.home = home;
}

}  // namespace gnbv
