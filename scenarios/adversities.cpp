#include "scenarios/adversities.hpp"

#include <fmt/format.h>

#include "sim/flight/rotors.hpp"

namespace gnbv {
namespace {

/// A wind against which the vehicle cannot hold its place at all.
void check_wind(const Scenario& s, std::vector<Problem>& out) {
  const Vec3& wind_m_s = s.wind.mean_world_m_s;
  const bool is_calm = wind_m_s.isZero(0.0) && s.wind.gust_w20_m_s == 0.0;
  if (is_calm) return;
  if (s.vehicle.kind == VehicleKind::ideal) {
    out.push_back({{"wind.mean_m_s", "vehicle.kind"},
                   "an ideal vehicle moves exactly as commanded: it feels no wind"});
    return;
  }
  const AirframeParameters& a = s.vehicle.airframe;
  const double calm_command = (hover_speed_rad_s(a) - a.idle_speed_rad_s) / a.command_gain_rad_s;
  if (!(calm_command > 0.0 && calm_command < 1.0))
    return;  // it does not fly at all: said elsewhere
  const AutopilotParameters& autopilot = s.vehicle.autopilot;
  const HoverTrim trim = hover_trim(s.vehicle, wind_m_s);
  const bool is_held = trim.tilt_rad < autopilot.tilt_max_rad &&
                       trim.command > autopilot.thrust_min && trim.command < autopilot.thrust_max;
  if (is_held) return;
  out.push_back(
      {{"wind.mean_m_s", "vehicle.autopilot.tilt_max_deg", "vehicle.autopilot.thrust_max"},
       fmt::format("hovering in a wind of {:.3g} m/s takes a tilt of {:.3g} deg and the command "
                   "{:.3g}; the autopilot allows less than {:.3g} deg, and commands from {} to {}",
                   wind_m_s.norm(), rad_to_deg(trim.tilt_rad), trim.command,
                   rad_to_deg(autopilot.tilt_max_rad), autopilot.thrust_min,
                   autopilot.thrust_max)});
}

void check_outages(const EstimateConfig& estimate, std::vector<Problem>& out) {
  const std::string key = "vehicle.estimate.outages";
  if (!estimate.outages.empty() && estimate.model != EstimateModel::gnss) {
    out.push_back(
        {{key, "vehicle.estimate.model"}, "only an estimate by satellites, `gnss`, can lose them"});
  }
  for (std::size_t i = 1; i < estimate.outages.size(); ++i) {
    const GnssOutage& before = estimate.outages[i - 1];
    if (before.start_s + before.duration_s <= estimate.outages[i].start_s) continue;
    out.push_back({{fmt::format("{}.{}.start_s", key, i)},
                   fmt::format("the outage at {} s begins before that at {} s has ended",
                               estimate.outages[i].start_s, before.start_s)});
  }
}

}  // namespace

void check_adversities(const Scenario& scenario, std::vector<Problem>& out) {
  check_wind(scenario, out);
  check_outages(scenario.vehicle.estimate, out);
}

}  // namespace gnbv
