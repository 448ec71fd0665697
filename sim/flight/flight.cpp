#include "sim/flight/flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sim/core/error.hpp"
#include "sim/flight/quadrotor.hpp"
#include "sim/flight/rotors.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

double ground_height_m(const World& world, const Vec3& at_m) {
  double highest_m = -std::numeric_limits<double>::infinity();
  for (const auto& face : world.terrain.faces) {
    const auto corner = [&](std::size_t i) -> Vec3 {
      return world.terrain.vertices_m[face[i]].cast<double>();
    };
    const Vec3 a = corner(0);
    const Vec3 ab = corner(1) - a;
    const Vec3 ac = corner(2) - a;
    Eigen::Matrix2d edges;
    edges << ab.head<2>(), ac.head<2>();
    if (edges.determinant() == 0.0) continue;  // upright
    const Eigen::Vector2d s = edges.inverse() * (at_m - a).head<2>();
    if (s.minCoeff() >= 0.0 && s.sum() <= 1.0) {
      highest_m = std::max(highest_m, a.z() + s[0] * ab.z() + s[1] * ac.z());
    }
  }
  return std::isinf(highest_m) && world.has_ground ? 0.0 : highest_m;
}

namespace {

class IdealFlight final : public Flight {
 public:
  IdealFlight(const VehicleConfig& config, const World& world, const ViewPose& start)
      : hover_power_w_(hover_power_w(config)),
        land_speed_m_s_(config.autopilot.commander.land_speed_m_s),
        ground_{.structure = {}, .has_ground = world.has_ground, .terrain = world.terrain},
        pose_(start) {
    check();
  }

  std::unique_ptr<Flight> clone() const override { return std::make_unique<IdealFlight>(*this); }
  std::int64_t tick() const override { return tick_; }
  bool has_collided() const override { return false; }
  void command(const Setpoint& setpoint) override {
    if (!landing_z_m_) setpoint_ = setpoint;
  }

  void leave_ground() override {}

  void land() override {
    landing_z_m_ = ground_height_m(ground_, pose_.p_world_m);
    setpoint_ = {};
    setpoint_.v_world_m_s = Vec3(0.0, 0.0, -land_speed_m_s_);
  }

  bool has_landed() const override { return landing_z_m_ && pose_.p_world_m.z() <= *landing_z_m_; }

  VehicleState state() const override {
    return {T_world_body(pose_), v_world_m_s_, Vec3(0.0, 0.0, yaw_rate_rad_s_)};
  }

  VehicleState estimate() const override { return state(); }

  double energy_wh() const override {
    return hover_power_w_ * kTick_s * static_cast<double>(tick_) / kJoulesPerWattHour;
  }

  void step() override {
    const auto given_or = [](double given, double otherwise) {
      return std::isfinite(given) ? given : otherwise;
    };
    for (int i = 0; i < 3; ++i) {
      v_world_m_s_[i] = given_or(setpoint_.v_world_m_s[i], 0.0);
      pose_.p_world_m[i] =
          given_or(setpoint_.p_world_m[i], pose_.p_world_m[i] + kTick_s * v_world_m_s_[i]);
    }
    yaw_rate_rad_s_ = given_or(setpoint_.yaw_rate_rad_s, 0.0);
    pose_.yaw_rad =
        given_or(setpoint_.yaw_rad, wrap_angle_rad(pose_.yaw_rad + kTick_s * yaw_rate_rad_s_));
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
  World ground_;
  std::optional<double> landing_z_m_;  // of the ground below, once it lands
  ViewPose pose_;
  Vec3 v_world_m_s_ = Vec3::Zero();
  double yaw_rate_rad_s_ = 0.0;
  Setpoint setpoint_;
  std::int64_t tick_ = 0;
};

}  // namespace

std::unique_ptr<Flight> make_flight(const VehicleConfig& config, const World& world,
                                    const ViewPose& start, std::uint64_t seed,
                                    const WindConfig& wind, FlightStart from) {
  const bool is_ideal = config.kind == VehicleKind::ideal;
  if (from == FlightStart::air) {
    if (is_ideal) return std::make_unique<IdealFlight>(config, world, start);
    return std::make_unique<Quadrotor>(config, world, start, seed, Px4::Start::airborne_offboard,
                                       wind);
  }
  if (is_ideal) {
    ViewPose below = start;
    below.p_world_m.z() = ground_height_m(world, start.p_world_m);
    return std::make_unique<IdealFlight>(config, world, below);
  }
  auto flight =
      std::make_unique<Quadrotor>(config, world, start, seed, Px4::Start::on_ground, wind);
  flight->command(
      {.p_world_m = flight->estimate().T_world_body.translation(), .yaw_rad = start.yaw_rad});
  const bool is_ready = flight->px4().set_mode(NavState::offboard) == Ack::accepted &&
                        flight->px4().arm(true) == Ack::accepted;
  GNBV_CHECK(is_ready, "a vehicle at rest could not be armed");
  return flight;
}

}  // namespace gnbv
