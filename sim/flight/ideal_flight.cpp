#include "sim/flight/ideal_flight.hpp"

#include <cmath>

#include "sim/core/error.hpp"
#include "sim/flight/rotors.hpp"

namespace gnbv {
namespace {

class IdealFlight final : public Flight {
 public:
  IdealFlight(const VehicleConfig& config, const ViewPose& start)
      : hover_power_w_(power_w(config.power, config.airframe.mass_kg * config.airframe.gravity_m_s2,
                               Vec3::Zero())),
        land_speed_m_s_(config.autopilot.commander.land_speed_m_s),
        pose_(start) {
    check();
  }

  std::int64_t tick() const override { return tick_; }
  bool has_collided() const override { return false; }
  void command(const Setpoint& setpoint) override {
    if (!is_landing_) setpoint_ = setpoint;
  }

  void land() override {
    is_landing_ = true;
    setpoint_ = {};
    setpoint_.v_world_m_s = Vec3(0.0, 0.0, -land_speed_m_s_);
  }

  bool has_landed() const override { return is_landing_ && pose_.p_world_m.z() <= 0.0; }

  VehicleState state() const override {
    VehicleState state;
    state.T_world_body = T_world_body(pose_);
    state.v_world_m_s = v_world_m_s_;
    state.omega_body_rad_s = Vec3(0.0, 0.0, yaw_rate_rad_s_);
    return state;
  }

  VehicleState estimate() const override { return state(); }

  double energy_wh() const override {
    return hover_power_w_ * kTick_s * static_cast<double>(tick_) / kJoulesPerWattHour;
  }

  void step() override {
    for (int i = 0; i < 3; ++i) {
      const double v_m_s = setpoint_.v_world_m_s[i];
      v_world_m_s_[i] = std::isfinite(v_m_s) ? v_m_s : 0.0;
      if (std::isfinite(setpoint_.p_world_m[i]))
        pose_.p_world_m[i] = setpoint_.p_world_m[i];
      else
        pose_.p_world_m[i] += kTick_s * v_world_m_s_[i];
    }
    yaw_rate_rad_s_ = std::isfinite(setpoint_.yaw_rate_rad_s) ? setpoint_.yaw_rate_rad_s : 0.0;
    pose_.yaw_rad = std::isfinite(setpoint_.yaw_rad)
                        ? setpoint_.yaw_rad
                        : wrap_angle_rad(pose_.yaw_rad + kTick_s * yaw_rate_rad_s_);
    ++tick_;
    check();
  }

 private:
  void check() const {
    GNBV_CHECK(pose_.p_world_m.allFinite() && std::isfinite(pose_.yaw_rad),
               "the vehicle's state became NaN or infinite");
  }

  double hover_power_w_;
  double land_speed_m_s_;
  bool is_landing_ = false;
  ViewPose pose_;
  Vec3 v_world_m_s_ = Vec3::Zero();
  double yaw_rate_rad_s_ = 0.0;
  Setpoint setpoint_;
  std::int64_t tick_ = 0;
};

}  // namespace

std::unique_ptr<Flight> make_ideal_flight(const VehicleConfig& config, const ViewPose& start) {
  return std::make_unique<IdealFlight>(config, start);
}

}  // namespace gnbv
