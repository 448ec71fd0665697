// Laws of the PX4 cascade. Step responses are those of an independent RK4 integration of the same
// model (sheet, section 7).
#include <gtest/gtest.h>

#include <functional>

#include "scenarios/builtin.hpp"
#include "sim/flight/cascade.hpp"
#include "sim/mesh/world.hpp"
#include "tests/sim/flight/px4_client.hpp"
#include "tests/support/streaming_flight.hpp"

namespace gnbv {
namespace {

const VehicleConfig kConfig;
const ViewPose kStart = {Vec3(0, 0, 10), 0.0};

/// When `share(state)` first reaches 90 %, when it last leaves 100 +- 2 %, and its largest value,
/// all within 20 s.
struct Response {
  double t90_s = -1.0;
  double settled_s = 0.0;
  double peak = 0.0;
};
Response respond(const Setpoint& setpoint, const std::function<double(const VehicleState&)>& share,
                 const VehicleConfig& vehicle = kConfig) {
  const auto flight = streaming(make_flight(vehicle, World{}, kStart, 1));
  flight->command(setpoint);
  Response response;
  while (flight->tick() < 20 * kTicksPerSecond) {
    flight->step();
    const double now = share(flight->state());
    const double time_s = static_cast<double>(flight->tick()) * kTick_s;
    response.peak = std::max(response.peak, now);
    if (response.t90_s < 0.0 && now >= 0.9) response.t90_s = time_s;
    if (std::abs(now - 1.0) > 0.02) response.settled_s = time_s;
  }
  EXPECT_FALSE(flight->has_collided());
  return response;
}

/// Of a step along x.
Response respond_along_x(double step_m, const VehicleConfig& vehicle = kConfig) {
  return respond(
      go_to(Vec3(step_m, 0, 10), 0.0),
      [&](const VehicleState& state) { return state.T_world_body.translation().x() / step_m; },
      vehicle);
}

// The sheet allows 10 %; two integrators of one model agree better than that.
constexpr double kStepTolerance = 0.04;

TEST(Autopilot, PositionStepsRespondAsTheReferenceModel) {
  for (const auto& [step_m, t90_s, overshoot, settled_s] :
       {std::tuple(1.0, 2.00, 0.083, 5.0), std::tuple(5.0, 2.08, 0.077, 5.0),
        std::tuple(10.0, 2.34, 0.046, 4.6)}) {
    const Response r = respond_along_x(step_m);
    EXPECT_NEAR(r.t90_s, t90_s, kStepTolerance * t90_s) << step_m << " m";
    EXPECT_NEAR(r.settled_s, settled_s, kStepTolerance * settled_s) << step_m << " m";
    EXPECT_NEAR(r.peak - 1.0, overshoot, 0.005) << step_m << " m";
  }
}

TEST(Autopilot, GainsOf2019ReachAPositionWithoutOvershoot) {
  VehicleConfig vehicle;  // the sheet's row is today's airframe with those gains
  vehicle.autopilot = vehicle_preset("iris_sitl_2019").autopilot;
  const Response r = respond_along_x(5.0, vehicle);
  EXPECT_NEAR(r.t90_s, 2.73, kStepTolerance * 2.73);
  EXPECT_LT(r.peak, 1.001);
}

TEST(Autopilot, HeightYawAndSpeedStepsRespondAsTheReferenceModel) {
  const auto height = [](const VehicleState& state) {
    return (state.T_world_body.translation().z() - 10.0) / 2.0;
  };
  const Response up = respond(go_to(Vec3(0, 0, 12)), height);
  EXPECT_NEAR(up.t90_s, 2.30, kStepTolerance * 2.30);
  EXPECT_NEAR(up.settled_s, 4.2, kStepTolerance * 4.2);
  for (const auto& [step_deg, t90_s] : {std::pair(45.0, 0.68), std::pair(90.0, 0.75)}) {
    const double yaw_rad = deg_to_rad(step_deg);
    const Response r = respond(go_to(Vec3(0, 0, 10), yaw_rad), [&](const VehicleState& state) {
      return yaw_of(state.T_world_body) / yaw_rad;
    });
    EXPECT_NEAR(r.t90_s, t90_s, kStepTolerance * t90_s) << step_deg << " deg";
  }
  const Response ahead = respond(fly_at(Vec3(1, 0, 0)), [](const VehicleState& state) {
    EXPECT_NEAR(state.T_world_body.translation().z(), 10.0, 0.05);
    return state.v_world_m_s.x();
  });
  EXPECT_NEAR(ahead.t90_s, 1.66, kStepTolerance * 1.66);
}

/// Seconds until the vehicle, hopping from corner to corner, is as near as that to each of them.
double longest_hop_s(const std::vector<Vec3>& corners_m, double near_m) {
  const auto flight = streaming(make_flight(kConfig, World{}, {corners_m.front(), 0.0}, 1));
  double longest_s = 0.0;
  for (const Vec3& corner_m : corners_m) {
    flight->command(go_to(corner_m, 0.0));
    const std::int64_t begun = flight->tick();
    while ((flight->state().T_world_body.translation() - corner_m).norm() > near_m &&
           flight->tick() < begun + 60 * kTicksPerSecond) {
      flight->step();
    }
    longest_s = std::max(longest_s, static_cast<double>(flight->tick() - begun) * kTick_s);
  }
  return longest_s;
}

TEST(Autopilot, PassesPx4sOwnOffboardTests) {
  // mavros_offboard_posctl_test.py: within 1 m in 18 s
  EXPECT_LT(longest_hop_s({Vec3(0, 0, 10), Vec3(2, 2, 8), Vec3(2, -2, 8), Vec3(-2, -2, 8),
                           Vec3(2, 2, 8), Vec3(0, 0, 10)},
                          1.0),
            18.0);
  // test_multicopter_offboard.cpp: 5 m hops to 0.3 m in 10 s
  EXPECT_LT(longest_hop_s(
                {Vec3(0, 0, 5), Vec3(0, 5, 5), Vec3(5, 5, 5), Vec3(5, 0, 5), Vec3(0, 0, 5)}, 0.3),
            10.0);
}

TEST(Autopilot, StepsToAllSidesAreAlike) {
  const auto t90_s = [](double x, double y) {
    const Eigen::Vector2d step_m(x, y);
    return respond(go_to(Vec3(x, y, 10), 0.0),
                   [&](const VehicleState& state) {
                     return state.T_world_body.translation().head<2>().dot(step_m) / 25.0;
                   })
        .t90_s;
  };
  // two ticks: the rotors' places and the inertias about x and y differ by some per cent
  const double forward_s = t90_s(5, 0);
  EXPECT_NEAR(t90_s(-5, 0), forward_s, 2.5 * kTick_s);
  EXPECT_NEAR(t90_s(0, 5), forward_s, 2.5 * kTick_s);
  EXPECT_NEAR(t90_s(0, -5), forward_s, 2.5 * kTick_s);
}

TEST(Autopilot, YawRateAloneTurnsAtThatRate) {
  const auto flight = streaming(make_flight(kConfig, World{}, kStart, 1));
  Setpoint setpoint = go_to(kStart.p_world_m, kNan);
  setpoint.yaw_rate_rad_s = 0.5;
  flight->command(setpoint);
  for (int i = 0; i < 1250; ++i) flight->step();
  // the yaw setpoint is the yaw of up to 20 ms ago, which brakes by 2.8/s * 0.5 rad/s * 8 ms
  EXPECT_NEAR(flight->state().omega_body_rad_s.z(), 0.5, 0.015);
}

TEST(PositionControl, ConstrainedSumKeepsItsPriority) {
  using Vec2 = Eigen::Vector2d;
  EXPECT_EQ(constrain_xy(Vec2(1, 2), Vec2(2, 1), 12.0), Vec2(3, 3));
  const Vec2 limited = constrain_xy(Vec2(3, 0), Vec2(0, 10), 5.0);
  EXPECT_NEAR((limited - Vec2(3, 4)).norm(), 0.0, 1e-12);  // the 3-4-5 triangle
  const Vec2 skew = constrain_xy(Vec2(3, 0), Vec2(4, 4), 5.0);
  EXPECT_NEAR(skew.norm(), 5.0, 1e-12);
  EXPECT_NEAR(skew.x() - 3.0, skew.y(), 1e-12);  // only the rest was shortened
  EXPECT_GT(skew.y(), 0.0);
  EXPECT_NEAR((constrain_xy(Vec2(0, 9), Vec2(5, 0), 6.0) - Vec2(0, 6)).norm(), 0.0, 1e-12);
}

TEST(PositionControl, NeverAsksForMoreTiltOrThrustThanAllowed) {
  for (const double far_m : {1.0, 10.0, 100.0}) {
    for (const double climb_m_s : {-20.0, 0.0, 20.0}) {
      PositionControlMemory memory;
      VehicleState state;
      state.v_world_m_s.z() = climb_m_s;
      const AttitudeSetpoint out = position_control(kConfig.autopilot, kConfig.airframe, memory,
                                                    state, go_to(Vec3(far_m, -far_m, 0.0), 0.3));
      const double cos_tilt = (out.q_world_body * Vec3::UnitZ()).z();
      EXPECT_LE(std::acos(std::min(1.0, cos_tilt)), kConfig.autopilot.tilt_max_rad + 1e-9);
      EXPECT_LE(out.thrust, 1.0 + 1e-12);
      EXPECT_GE(out.thrust, kConfig.autopilot.thrust_min - 1e-12);
    }
  }
}

TEST(PositionControl, SetpointsNeedEveryAxisAndPairs) {
  EXPECT_FALSE(is_valid(Setpoint{}));
  EXPECT_TRUE(is_valid(go_to(Vec3(1, 2, 3), kNan)));
  EXPECT_FALSE(is_valid(go_to(Vec3(1, kNan, 3), kNan)));
  Setpoint unpaired = go_to(Vec3(1, kNan, 3), kNan);
  unpaired.v_world_m_s = Vec3(1, 1, 1);
  EXPECT_FALSE(is_valid(unpaired));
  Setpoint mixed = go_to(Vec3(kNan, kNan, 3), kNan);
  EXPECT_FALSE(is_valid(mixed));
  mixed.v_world_m_s = Vec3(1, 0, kNan);
  EXPECT_TRUE(is_valid(mixed));
  Setpoint acceleration;
  acceleration.a_world_m_s2 = Vec3(0, 0, 1);
  EXPECT_TRUE(is_valid(acceleration));
}

}  // namespace
}  // namespace gnbv
