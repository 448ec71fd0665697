// An offboard client of a quadrotor, for the tests of Px4.
#pragma once

#include <limits>
#include <string_view>

#include "sim/flight/quadrotor.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

inline Setpoint go_to(const Vec3& p_world_m, double yaw_rad = 0.0) {
  return {.p_world_m = p_world_m, .yaw_rad = yaw_rad};
}

inline Setpoint fly_at(const Vec3& v_world_m_s) { return {.v_world_m_s = v_world_m_s}; }

/// A wall of 20 m x 20 m at x, facing -x.
inline World walled_world(float x_m = 3.0F) {
  World world;
  world.structure.vertices_m = {{x_m, -10, -5}, {x_m, 10, -5}, {x_m, 10, 15}, {x_m, -10, 15}};
  world.structure.faces = {{0, 2, 1}, {0, 3, 2}};
  return world;
}

inline VehicleConfig with(const CommanderParameters& commander) {
  VehicleConfig config;
  config.autopilot.commander = commander;
  return config;
}

inline Quadrotor on_ground(const VehicleConfig& config = {}, const WindConfig& wind = {}) {
  return {config, World{}, {Vec3(1, 2, 0), 0.5}, 1, Px4::Start::on_ground, wind};
}

inline Quadrotor airborne(const VehicleConfig& config = {},
                          const ViewPose& start = {Vec3(0, 0, 10), 0.0}) {
  return {config, World{}, start, 1, Px4::Start::airborne_offboard};
}

inline int ticks(double time_s) { return static_cast<int>(std::lround(time_s / kTick_s)); }

inline void wait(Quadrotor& quadrotor, double time_s) {
  for (int i = 0; i < ticks(time_s); ++i) quadrotor.step();
}

/// Sends the setpoint now and every `period` ticks after.
inline void stream(Quadrotor& quadrotor, const Setpoint& setpoint, double time_s, int period = 5) {
  for (int i = 0; i < ticks(time_s); ++i) {
    if (i % period == 0) quadrotor.command(setpoint);
    quadrotor.step();
  }
}

/// Ticks until `condition` holds, or -1 when it does not within `limit_s`.
template <typename Condition>
int ticks_until(Quadrotor& quadrotor, double limit_s, Condition condition) {
  for (int i = 0; i <= ticks(limit_s); ++i) {
    if (condition()) return i;
    quadrotor.step();
  }
  return -1;
}

inline Vec3 place(const Quadrotor& quadrotor) {
  return quadrotor.state().T_world_body.translation();
}

inline double tilt_rad(const Eigen::Quaterniond& q_world_body) {
  return std::acos(std::min(1.0, (q_world_body * Vec3::UnitZ()).z()));
}

inline bool has_said(Px4& px4, std::string_view words) {
  bool found = false;
  for (const StatusText& message : px4.take_messages()) {
    found = found || message.text.find(words) != std::string::npos;
  }
  return found;
}

}  // namespace gnbv
