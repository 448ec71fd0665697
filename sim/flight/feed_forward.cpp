#include "sim/flight/feed_forward.hpp"

#include <cmath>

#include "sim/flight/rotors.hpp"

namespace gnbv {

Vec3 acceleration_setpoint(const AirframeParameters& airframe, const AutopilotParameters& autopilot,
                           const Vec3& v_world_m_s, const Vec3& a_world_m_s2) {
  const auto rotors = static_cast<double>(airframe.rotors.size());
  Vec3 body_z_world = Vec3::UnitZ();
  double speed_rad_s = hover_speed_rad_s(airframe);
  // thrust and tilt depend on the drag, and the drag on both, but weakly: eight turns leave less
  // than 1 mm/s^2, even with the strongest drag of the presets
  for (int i = 0; i < 8; ++i) {
    const Eigen::Quaterniond q = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), body_z_world);
    const Vec3 v_body_m_s = q.conjugate() * v_world_m_s;
    const Vec3 v_disk_m_s(v_body_m_s.x(), v_body_m_s.y(), 0.0);
    const double drag_per_s =
        rotors * speed_rad_s * airframe.drag_coefficient_n_s2_per_m / airframe.mass_kg;
    const Vec3 thrust_m_s2 =
        a_world_m_s2 + airframe.gravity_m_s2 * Vec3::UnitZ() + drag_per_s * (q * v_disk_m_s);
    body_z_world = thrust_m_s2.normalized();
    const double thrust_at_rest_n =
        airframe.mass_kg * thrust_m_s2.norm() / thrust_share(airframe, v_body_m_s);
    speed_rad_s = std::sqrt(thrust_at_rest_n / (rotors * airframe.thrust_coefficient_n_s2));
  }
  // position_control tilts by a_xy over g, and takes the command's vertical part for 1 + a_z / g
  // of the hover command
  const double lift =
      command_at_speed(airframe, speed_rad_s) * body_z_world.z() / hover_command(airframe);
  const Vec3 setpoint =
      airframe.gravity_m_s2 *
      Vec3(body_z_world.x() / body_z_world.z(), body_z_world.y() / body_z_world.z(), lift - 1.0);
  return setpoint + autopilot.velocity_d.cwiseProduct(a_world_m_s2);
}

double attitude_lag_s(const AutopilotParameters& autopilot) {
  // a loop of gain P follows a long ramp 1 / P later; those of a leg are short, and with this share
  // of it the presets deviate and overshoot least on the whole (measured, in steps of a tenth)
  return 0.8 / autopilot.attitude_p_per_s.x();
}

}  // namespace gnbv
