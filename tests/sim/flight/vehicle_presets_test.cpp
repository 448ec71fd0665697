// Figures of the vehicles by name (sheet, sections 1 and 7) and the laws that tie their parts.
#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/builtin.hpp"
#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"
#include "sim/flight/guidance.hpp"
#include "tests/sim/flight/bare_vehicle.hpp"
#include "tests/support/streaming_flight.hpp"

namespace gnbv {
namespace {

double thrust_to_weight(const VehicleConfig& vehicle) {
  const AirframeParameters& a = vehicle.airframe;
  const double speed_rad_s = a.idle_speed_rad_s + a.command_gain_rad_s;
  return 4.0 * a.thrust_coefficient_n_s2 * speed_rad_s * speed_rad_s / (a.mass_kg * a.gravity_m_s2);
}

/// What holds for a preset.
struct Figures {
  std::string_view preset;
  double hover_command;
  double thrust_to_weight;
  double terminal_m_s;  // at a constant tilt of 10 deg
};

class Preset : public testing::TestWithParam<Figures> {
 protected:
  const VehicleConfig vehicle = vehicle_preset(GetParam().preset);
};

TEST_P(Preset, TiltedFlightReachesItsTerminalSpeed) {
  // attitude held at 10 deg, thrust governed for level flight: V = m g tan(tilt) / (4 w cd)
  const double tilt_rad = deg_to_rad(10.0);
  VehicleState start;
  start.T_world_body.rotate(Eigen::AngleAxisd(tilt_rad, Vec3::UnitY()));
  const AirframeParameters& airframe = vehicle.airframe;
  const Allocation allocation = allocation_of(airframe);
  RigidVehicle body(airframe, empty_world(), start, all(hover_speed_rad_s(airframe)));
  RateControlMemory memory;
  AttitudeSetpoint setpoint;
  setpoint.q_world_body = Eigen::AngleAxisd(tilt_rad, Vec3::UnitY());
  double fallen = 0.0;
  for (int i = 0; i < 60 * kTicksPerSecond; ++i) {
    const VehicleState& state = body.state();
    fallen -= 0.05 * kTick_s * state.v_world_m_s.z();
    setpoint.thrust = hover_command(airframe) + fallen - 0.1 * state.v_world_m_s.z();
    const Eigen::Quaterniond q(state.T_world_body.linear());
    const Vec3 omega_setpoint = attitude_control(vehicle.autopilot, q, setpoint);
    body.step([&](const Vec3& omega_body_rad_s) {
      return reference_speeds(airframe,
                              rate_control(vehicle.autopilot, allocation, memory, omega_body_rad_s,
                                           omega_setpoint, setpoint.thrust));
    });
  }
  const VehicleState& state = body.state();
  EXPECT_NEAR(std::acos(state.T_world_body.linear()(2, 2)), tilt_rad, 1e-3);
  EXPECT_NEAR(state.v_world_m_s.z(), 0.0, 2e-3);
  // three digits; 60 s are at least 8 time constants
  EXPECT_NEAR(state.v_world_m_s.x(), GetParam().terminal_m_s, 0.005 * GetParam().terminal_m_s);
}

TEST_P(Preset, FeedForwardLeavesTheCascadeNothingToCorrect) {
  // rotors and position loop give back the acceleration that the feed-forward was asked for
  const AirframeParameters& airframe = vehicle.airframe;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto random = [&](std::uint64_t k) {  // in [-1, 1)
      return 2.0 * uniform01({.seed = 7, .frame = i, .index = k}) - 1.0;
    };
    const Vec3 v_m_s(2.0 * random(0), 2.0 * random(1), random(2));
    const Vec3 a_m_s2(random(3), random(4), 0.5 * random(5));
    VehicleState state;
    state.v_world_m_s = v_m_s;
    PositionControlMemory memory;
    memory.v_dot_world_m_s2 = a_m_s2;
    memory.v_previous_world_m_s = v_m_s - kPositionLoop_s * a_m_s2;
    Setpoint setpoint;
    setpoint.p_world_m = Vec3::Zero();
    setpoint.v_world_m_s = v_m_s;
    setpoint.a_world_m_s2 = acceleration_setpoint(airframe, vehicle.autopilot, v_m_s, a_m_s2);
    const AttitudeSetpoint out =
        position_control(vehicle.autopilot, airframe, memory, state, setpoint);
    const Eigen::Quaterniond& q = out.q_world_body;
    const RotorSpeeds speeds =
        all(airframe.idle_speed_rad_s + airframe.command_gain_rad_s * out.thrust);
    const Wrench wrench = rotor_wrench(airframe, speeds, q.conjugate() * v_m_s, Vec3::Zero());
    const Vec3 moved_m_s2 =
        q * wrench.force_body_n / airframe.mass_kg - airframe.gravity_m_s2 * Vec3::UnitZ();
    EXPECT_LT((moved_m_s2 - a_m_s2).norm(), 1e-3);  // eight iterations
  }
}

TEST_P(Preset, AutoModesKeepToItsOwnSpeedLimits) {
  const AutopilotParameters& limits = vehicle.autopilot;
  const CommanderParameters& c = limits.commander;
  EXPECT_LE(c.cruise_speed_m_s, limits.speed_max_m_s);
  EXPECT_LE(c.climb_speed_m_s, limits.climb_speed_max_m_s);
  EXPECT_LE(c.takeoff_speed_m_s, limits.climb_speed_max_m_s);
  EXPECT_LE(c.descent_speed_m_s, limits.descent_speed_max_m_s);
  EXPECT_LE(c.land_speed_m_s, limits.descent_speed_max_m_s);
}

INSTANTIATE_TEST_SUITE_P(Figures, Preset,
                         testing::Values(Figures{"iris", 0.7067, 1.86, 4.70},
                                         Figures{"iris_sitl_2019", 0.5635, 2.75, 1.22},
                                         Figures{"authors", 0.7008, 1.29, 12.4},
                                         Figures{"f450", 0.6278, 2.14, 12.2}),
                         [](const auto& test) { return std::string(test.param.preset); });

TEST(Presets, FullThrottleClimbsAtTheAxialLimit) {
  for (const auto& [preset, limit_m_s] :
       {std::pair("iris", 11.56), std::pair("iris_sitl_2019", 15.9)}) {
    const VehicleConfig vehicle = vehicle_preset(preset);
    RigidVehicle body(vehicle.airframe, empty_world(), VehicleState{}, all(1100.0));
    step(body, all(1100.0), 20 * kTicksPerSecond);
    // 25 (1 - 1/TW) is a fixed point of the integration too; 20 s leave nothing of the approach
    EXPECT_NEAR(body.state().v_world_m_s.z(), 25.0 * (1.0 - 1.0 / thrust_to_weight(vehicle)), 1e-4);
    EXPECT_NEAR(body.state().v_world_m_s.z(), limit_m_s, 0.02) << "the sheet's digits";
  }
}

TEST(Presets, ThrustIsLostToTheSpeedTheirPluginsLookAt) {
  const Vec3 sideways_m_s(5, 0, 0);
  const Vec3 up_m_s(0, 0, -5);
  const auto shares = [&](std::string_view preset) {
    const AirframeParameters airframe = vehicle_preset(preset).airframe;
    return std::pair(thrust_share(airframe, sideways_m_s), thrust_share(airframe, up_m_s));
  };
  EXPECT_EQ(shares("iris"), std::pair(1.0, 0.8));
  EXPECT_EQ(shares("iris_sitl_2019"), std::pair(0.8, 0.8));
  EXPECT_EQ(shares("authors"), std::pair(1.0, 1.0));
  EXPECT_EQ(thrust_share(vehicle_preset("iris").airframe, Vec3(0, 0, 30)), 0.0);
}

TEST(Presets, RollingMomentsCancelOnlyWhereTheyFollowTheSpin) {
  const auto moment = [](std::string_view preset) {
    AirframeParameters airframe = vehicle_preset(preset).airframe;
    airframe.drag_coefficient_n_s2_per_m = 0.0;  // whose lever arm turns the body too
    airframe.thrust_loss = ThrustLoss::none;
    return rotor_wrench(airframe, all(700.0), Vec3(3, 0, 0), Vec3::Zero()).torque_body_n_m;
  };
  EXPECT_NEAR(moment("iris").norm(), 0.0, 1e-12);
  EXPECT_NEAR((moment("authors") + 4.0 * 700.0 * 1e-6 * Vec3(3, 0, 0)).norm(), 0.0, 1e-12);
}

TEST(Presets, OldVelocityGainsGiveTheThrustTheyNamed) {
  // 0.2 of the full thrust for an error of 1 m/s, below any limit (PX4 1.9.2, MPC_XY_VEL_P)
  const VehicleConfig vehicle = vehicle_preset("iris_sitl_2019");
  const double hover = hover_command(vehicle.airframe);
  PositionControlMemory memory;
  Setpoint setpoint;
  setpoint.v_world_m_s = Vec3(1, 0, 0);
  const AttitudeSetpoint out =
      position_control(vehicle.autopilot, vehicle.airframe, memory, VehicleState{}, setpoint);
  const Vec3 thrust = out.thrust * (out.q_world_body * Vec3::UnitZ());
  EXPECT_NEAR(thrust.x(), 0.2, 1e-12);
  EXPECT_NEAR(thrust.z(), hover, 1e-12);
}

TEST(Presets, UnknownNamesThrow) { EXPECT_THROW(vehicle_preset("concorde"), BrokenInvariant); }

TEST(Power, LiuEtAlsHoverIsTheIdealOneAtAPlausibleEfficiency) {
  const AirframeParameters iris;
  const double weight_n = iris.mass_kg * iris.gravity_m_s2;
  const double disk_m2 = 4.0 * kPi * 0.128 * 0.128;
  const double ideal_w = std::pow(weight_n, 1.5) / std::sqrt(2.0 * 1.225 * disk_m2);
  EXPECT_NEAR(ideal_w, 83.0, 0.5);  // the sheet's digits, momentum theory
  const double hover_w = power_w({}, weight_n, Vec3::Zero());
  EXPECT_NEAR(hover_w, 185.0, 0.5);
  EXPECT_NEAR(power_w({}, 1.37 * iris.gravity_m_s2, Vec3::Zero()), 154.0, 0.5);
  EXPECT_GT(ideal_w / hover_w, 0.4);  // figure of merit times motor and controller
  EXPECT_LT(ideal_w / hover_w, 0.6);
}

}  // namespace
}  // namespace gnbv
