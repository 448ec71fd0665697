#include <algorithm>
#include <cmath>

#include "scenarios/problems.hpp"
#include "sim/flight/flight.hpp"
#include "sim/flight/guidance.hpp"
#include "sim/flight/rotors.hpp"

namespace gnbv {
namespace {

const std::string kAirframe = "vehicle.airframe.";
const std::string kAutopilot = "vehicle.autopilot.";

/// Whether the rotors can steer it at all.
bool check_rotors(const AirframeParameters& a, Problems& out) {
  const std::size_t before = out.size();
  for (std::size_t i = 0; i < a.rotors.size(); ++i) {
    require(std::abs(a.rotors[i].spin) == 1.0, out, {fmt::format("{}rotors.{}.spin", kAirframe, i)},
            "has to be 1 or -1");
  }
  if (out.size() > before) return false;
  const std::string fault = allocation_fault(a);
  std::vector<std::string> keys = {kAirframe + "rotors", kAirframe + "moment_per_thrust_m"};
  if (a.moment_per_thrust_m == 0.0) keys.erase(keys.begin());
  return require(fault.empty(), out, keys, "{}", fault);
}

/// A vehicle that turns slower than this would need minutes for a view.
void check_yaw_authority(const AirframeParameters& a, Problems& out) {
  constexpr double kLeast_rad_s2 = 0.1;
  const double authority_rad_s2 = yaw_authority_rad_s2(a);
  require(authority_rad_s2 >= kLeast_rad_s2, out,
          {kAirframe + "moment_per_thrust_m", kAirframe + "inertia_kg_m2",
           kAirframe + "thrust_coefficient_n_s2", kAirframe + "command_gain_rad_s",
           kAirframe + "rotors"},
          "the rotors turn the vehicle about its vertical by {:.2g} rad/s^2 at full yaw command; "
          "at least {} is needed",
          authority_rad_s2, kLeast_rad_s2);
}

/// The drag of the rotors is integrated in ticks of 4 ms, that of its turning in steps of 1 ms: it
/// may take half of the motion in one, or the simulation would not be one.
void check_drag(const AirframeParameters& a, Problems& out) {
  constexpr double kShareMax = 0.5;
  double arm_m = 0.0;
  for (const RotorMount& rotor : a.rotors) arm_m = std::max(arm_m, rotor.p_body_m.norm());
  const double top_rad_s = a.idle_speed_rad_s + a.command_gain_rad_s;
  const double drag_n_s_per_m =
      static_cast<double>(a.rotors.size()) * top_rad_s * a.drag_coefficient_n_s2_per_m;
  const double share = drag_n_s_per_m * kTick_s / a.mass_kg;
  const double turning_share =
      drag_n_s_per_m * arm_m * arm_m * kTick_s / (kRateStepsPerTick * a.inertia_kg_m2.minCoeff());
  require(std::max(share, turning_share) <= kShareMax, out,
          {kAirframe + "drag_coefficient_n_s2_per_m", kAirframe + "mass_kg",
           kAirframe + "inertia_kg_m2", kAirframe + "idle_speed_rad_s",
           kAirframe + "command_gain_rad_s", kAirframe + "rotors"},
          "the rotors' drag at full command would take {:.2g} of the speed in a tick and {:.2g} of "
          "the rotation in a step of the rate loop; at most {} can be simulated",
          share, turning_share, kShareMax);
}

/// What the planner keeps free has to hold the vehicle.
void check_hull(const Scenario& s, Problems& out) {
  const AirframeParameters& a = s.vehicle.airframe;
  const double free_m = s.planner.validity.collision_radius_m;
  const double reach_m = std::hypot(a.hull_radius_m, 0.5 * a.hull_height_m);
  require(reach_m < free_m, out,
          {kAirframe + "hull_radius_m", kAirframe + "hull_height_m",
           "planner.validity.collision_radius_m"},
          "the hull reaches {:.3g} m from the vehicle's centre, and the planner keeps only {:.3g} "
          "m free: planner.validity.collision_radius_m has to be more",
          reach_m, free_m);
}

/// Nobody waits for hours until a leg is over: across the workspace, or half a turn.
void check_leg_times(const Scenario& s, Problems& out) {
  const ViewPose from = {s.workspace_m.min(), 0.0};
  const ViewPose across = {s.workspace_m.max(), 0.0};
  const auto check = [&](const ViewPose& to, double speed_m_s, std::vector<std::string> keys) {
    const double leg_s = leg_duration_s(from, to, speed_m_s, s.guidance, s.vehicle);
    require(leg_s <= kLongestLeg_s, out, std::move(keys),
            "the longest {} would take {:.2g} s; at most {} are flown",
            to.yaw_rad == 0.0 ? "leg through the workspace" : "turn", leg_s, kLongestLeg_s);
  };
  check(across, s.guidance.path_speed_m_s,
        {"guidance.path_speed_m_s", "guidance.acceleration_m_s2", "guidance.jerk_m_s3",
         kAutopilot + "climb_speed_max_m_s"});
  check(across, s.guidance.profile_speed_m_s, {"guidance.profile_speed_m_s"});
  check({from.p_world_m, kPi}, 1.0,
        {"guidance.yaw_rate_deg_s", "guidance.yaw_acceleration_deg_s2", "guidance.yaw_jerk_deg_s3",
         kAutopilot + "rate_max_deg_s"});
}

/// What flies has to hover and to follow its guidance.
void check_quadrotor(const Scenario& s, Problems& out) {
  const AutopilotParameters& autopilot = s.vehicle.autopilot;
  const AirframeParameters& a = s.vehicle.airframe;
  const double hover = needed_hover_command(a);
  require_below(out, kAutopilot, "thrust_min", autopilot.thrust_min, "thrust_max",
                autopilot.thrust_max);
  require_below(out, kAutopilot, "thrust_margin_xy", autopilot.thrust_margin_xy, "thrust_max",
                autopilot.thrust_max);
  check_drag(a, out);
  check_hull(s, out);
  const bool hovers = require(
      autopilot.thrust_min < hover && hover < autopilot.thrust_max, out,
      {kAirframe + "mass_kg", kAirframe + "thrust_coefficient_n_s2", kAirframe + "idle_speed_rad_s",
       kAirframe + "command_gain_rad_s", kAirframe + "gravity_m_s2", kAirframe + "rotors",
       kAutopilot + "thrust_min", kAutopilot + "thrust_max"},
      "hovering takes the command {:.2f}, which is not between thrust_min = {} and thrust_max = {}",
      hover, autopilot.thrust_min, autopilot.thrust_max);
  if (hovers && check_rotors(a, out)) {
    check_yaw_authority(a, out);
    check_leg_times(s, out);
  }
  // A leg flown faster than the autopilot allows would only time out. Climb and descent are limited
  // by the guidance itself.
  const auto check_speed = [&](double speed_m_s, const std::string& key) {
    require(speed_m_s <= autopilot.speed_max_m_s, out,
            {"guidance." + key, kAutopilot + "speed_max_m_s"},
            "{} = {} is above the autopilot's speed_max_m_s = {}", key, speed_m_s,
            autopilot.speed_max_m_s);
  };
  check_speed(s.guidance.path_speed_m_s, "path_speed_m_s");
  check_speed(s.guidance.profile_speed_m_s, "profile_speed_m_s");
}

/// A wind against which the vehicle cannot hold its place at all.
void check_wind(const Scenario& s, Problems& out) {
  const Vec3& wind_m_s = s.wind.mean_world_m_s;
  const bool is_calm = wind_m_s.isZero(0.0) && s.wind.gust_w20_m_s == 0.0;
  if (is_calm) return;
  if (!require(s.vehicle.kind != VehicleKind::ideal, out, {"wind.mean_m_s", "vehicle.kind"},
               "an ideal vehicle moves exactly as commanded: it feels no wind")) {
    return;
  }
  const double calm_command = needed_hover_command(s.vehicle.airframe);
  if (!(calm_command > 0.0 && calm_command < 1.0)) return;  // check_quadrotor() said so
  const AutopilotParameters& autopilot = s.vehicle.autopilot;
  const HoverTrim trim = hover_trim(s.vehicle, wind_m_s);
  require(
      trim.tilt_rad < autopilot.tilt_max_rad && trim.command > autopilot.thrust_min &&
          trim.command < autopilot.thrust_max,
      out, {"wind.mean_m_s", kAutopilot + "tilt_max_deg", kAutopilot + "thrust_max"},
      "hovering in a wind of {:.3g} m/s takes {}; the autopilot allows less than {:.3g} deg, and "
      "commands from {} to {}",
      wind_m_s.norm(),
      std::isfinite(trim.command) ? fmt::format("a tilt of {:.3g} deg and the command {:.3g}",
                                                rad_to_deg(trim.tilt_rad), trim.command)
                                  : "more thrust than the rotors have in it",
      rad_to_deg(autopilot.tilt_max_rad), autopilot.thrust_min, autopilot.thrust_max);
}

void check_estimate(const VehicleConfig& vehicle, Problems& out) {
  const std::string key = "vehicle.estimate.outages";
  const EstimateModel model = vehicle.estimate.model;
  const std::vector<GnssOutage>& outages = vehicle.estimate.outages;
  require(vehicle.kind != VehicleKind::ideal || model == EstimateModel::none, out,
          {"vehicle.estimate.model", "vehicle.kind"},
          "an ideal vehicle knows where it is: its estimate is `none`");
  require(outages.empty() || is_by_satellites(model), out, {key, "vehicle.estimate.model"},
          "only an estimate by satellites, `gnss` or `rtk`, can lose them");
  for (std::size_t i = 1; i < outages.size(); ++i) {
    const GnssOutage& before = outages[i - 1];
    require(before.start_s + before.duration_s <= outages[i].start_s, out,
            {fmt::format("{}.{}.start_s", key, i)},
            "the outage at {} s begins before that at {} s has ended", outages[i].start_s,
            before.start_s);
  }
}

}  // namespace

void check_vehicle(const Scenario& scenario, Problems& out) {
  if (scenario.vehicle.kind == VehicleKind::quadrotor) {
    check_quadrotor(scenario, out);
  } else {
    check_leg_times(scenario, out);
  }
  check_wind(scenario, out);
  check_estimate(scenario.vehicle, out);
}

}  // namespace gnbv
