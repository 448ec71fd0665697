#include "sim/flight/endurance.hpp"

#include <algorithm>

#include "sim/flight/guidance.hpp"
#include "sim/flight/rotors.hpp"

namespace gnbv {
namespace {

double weight_n(const VehicleConfig& vehicle) {
  return vehicle.airframe.mass_kg * vehicle.airframe.gravity_m_s2;
}

}  // namespace

double hover_power_w(const VehicleConfig& vehicle) {
  return power_w(vehicle.power, weight_n(vehicle), Vec3::Zero());
}

double leg_energy_wh(const VehicleConfig& vehicle, const GuidanceConfig& guidance,
                     const ViewPose& from, const ViewPose& to) {
  const double duration_s = leg_duration_s(from, to, guidance.path_speed_m_s, guidance, vehicle);
  const double hover_w = hover_power_w(vehicle);
  if (duration_s <= 0.0) return 0.0;
  const Vec3 v_mean_m_s = (to.p_world_m - from.p_world_m) / duration_s;
  const bool is_ideal = vehicle.kind == VehicleKind::ideal;  // draws hover power all the way
  const double moving_w =
      is_ideal ? hover_w : power_w(vehicle.power, weight_n(vehicle), v_mean_m_s);
  return std::max(hover_w, moving_w) * (duration_s + kArrival_s) / kJoulesPerWattHour;
}

double landing_energy_wh(const VehicleConfig& vehicle, double height_m) {
  const CommanderParameters& commander = vehicle.autopilot.commander;
  const double duration_s = std::max(0.0, height_m) / commander.land_speed_m_s +
                            commander.land_detection_s +
                            std::max(0.0, commander.disarm_after_landing_s);
  return hover_power_w(vehicle) * duration_s / kJoulesPerWattHour;
}

}  // namespace gnbv
