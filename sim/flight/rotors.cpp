#include "sim/flight/rotors.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/flight/allocation.hpp"

namespace gnbv {

double rotor_speed_after(const AirframeParameters& airframe, double speed_rad_s,
                         double reference_rad_s, double dt_s) {
  const double tau_s =
      reference_rad_s > speed_rad_s ? airframe.time_constant_up_s : airframe.time_constant_down_s;
  return reference_rad_s + (speed_rad_s - reference_rad_s) * std::exp(-dt_s / tau_s);
}

RotorSpeeds reference_speeds(const AirframeParameters& airframe, const RotorCommands& commands) {
  RotorSpeeds speeds_rad_s{};
  for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
    speeds_rad_s[i] = airframe.idle_speed_rad_s + airframe.command_gain_rad_s * commands[i];
  }
  return speeds_rad_s;
}

double hover_speed_rad_s(const AirframeParameters& airframe) {
  const double weight_n = airframe.mass_kg * airframe.gravity_m_s2;
  return std::sqrt(
      weight_n / (static_cast<double>(airframe.rotors.size()) * airframe.thrust_coefficient_n_s2));
}

double command_at_speed(const AirframeParameters& airframe, double speed_rad_s) {
  return (speed_rad_s - airframe.idle_speed_rad_s) / airframe.command_gain_rad_s;
}

double hover_command(const AirframeParameters& airframe) {
  return command_at_speed(airframe, hover_speed_rad_s(airframe));
}

double yaw_authority_rad_s2(const AirframeParameters& airframe) {
  const double thrust_per_command_n = 2.0 * airframe.thrust_coefficient_n_s2 *
                                      hover_speed_rad_s(airframe) * airframe.command_gain_rad_s;
  const Allocation allocation = allocation_of(airframe);
  double turning = 0.0;
  for (std::size_t i = 0; i < allocation.rotors; ++i) {
    turning -= airframe.rotors[i].spin * allocation.torque[2].command[i];
  }
  return turning * airframe.moment_per_thrust_m * thrust_per_command_n / airframe.inertia_kg_m2.z();
}

double thrust_share(const AirframeParameters& airframe, const Vec3& v_rotor_body_m_s) {
  const auto share_at = [&](double speed_m_s) {
    return std::clamp(1.0 - speed_m_s / airframe.thrust_loss_limit_m_s, 0.0, 1.0);
  };
  switch (airframe.thrust_loss) {
    case ThrustLoss::none:
      return 1.0;
    case ThrustLoss::axial_speed:
      return share_at(std::abs(v_rotor_body_m_s.z()));
    case ThrustLoss::whole_speed:
      return share_at(v_rotor_body_m_s.norm());
  }
  throw BrokenInvariant("thrust loss outside its enumeration");
}

Wrench rotor_wrench(const AirframeParameters& airframe, const RotorSpeeds& speeds_rad_s,
                    const Vec3& v_body_m_s, const Vec3& omega_body_rad_s) {
  Wrench sum;
  for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
    const RotorMount& rotor = airframe.rotors[i];
    const double speed_rad_s = speeds_rad_s[i];
    const Vec3 v_rotor_m_s = v_body_m_s + omega_body_rad_s.cross(rotor.p_body_m);
    const Vec3 v_disk_m_s(v_rotor_m_s.x(), v_rotor_m_s.y(), 0.0);
    const double thrust_at_rest_n = airframe.thrust_coefficient_n_s2 * speed_rad_s * speed_rad_s;
    const double thrust_n = thrust_at_rest_n * thrust_share(airframe, v_rotor_m_s);

    const Vec3 force_n =
        thrust_n * Vec3::UnitZ() - speed_rad_s * airframe.drag_coefficient_n_s2_per_m * v_disk_m_s;
    // the plugin takes the reaction torque from the thrust at rest
    Vec3 torque_n_m = rotor.p_body_m.cross(force_n);
    torque_n_m.z() -= rotor.spin * airframe.moment_per_thrust_m * thrust_at_rest_n;
    const double rolling_sign = airframe.rolling_follows_spin ? rotor.spin : 1.0;
    torque_n_m -= rolling_sign * speed_rad_s * airframe.rolling_coefficient_n_s2 * v_disk_m_s;

    sum.force_body_n += force_n;
    sum.torque_body_n_m += torque_n_m;
    sum.thrust_n += thrust_n;
  }
  return sum;
}

double power_w(const PowerParameters& power, double thrust_n, const Vec3& v_world_m_s) {
  const double half_climb_m_s = 0.5 * v_world_m_s.z();
  const double v_horizontal_m_s = v_world_m_s.head<2>().norm();
  const double induced_w = power.k1 * thrust_n *
                           (half_climb_m_s + std::sqrt(half_climb_m_s * half_climb_m_s +
                                                       thrust_n / (power.k2 * power.k2)));
  const double profile_w = power.c2 * thrust_n * std::sqrt(thrust_n);
  const double parasitic_w = power.c4 * v_horizontal_m_s * v_horizontal_m_s * v_horizontal_m_s;
  return induced_w + profile_w + parasitic_w;
}

double hover_power_w(const VehicleConfig& vehicle) {
  const double weight_n = vehicle.airframe.mass_kg * vehicle.airframe.gravity_m_s2;
  return power_w(vehicle.power, weight_n, Vec3::Zero());
}

}  // namespace gnbv
