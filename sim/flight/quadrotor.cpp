#include "sim/flight/quadrotor.hpp"

#include <utility>

#include "sim/core/error.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {
namespace {

VehicleState start_state(const VehicleConfig& config, const World& world, const ViewPose& start,
                         Px4::Start how) {
  ViewPose pose = start;
  if (how == Px4::Start::on_ground) {
    if (!world.has_ground) {
      throw BadInput("a vehicle cannot start on the ground of a world that has no ground");
    }
    pose.p_world_m.z() = 0.5 * config.airframe.hull_height_m;
  }
  return VehicleState{T_world_body(pose)};
}

RotorSpeeds start_speeds_rad_s(const AirframeParameters& airframe, Px4::Start how) {
  RotorSpeeds speeds_rad_s{};
  if (how == Px4::Start::airborne_offboard) speeds_rad_s.fill(hover_speed_rad_s(airframe));
  return speeds_rad_s;
}

}  // namespace

Quadrotor::Quadrotor(const VehicleConfig& config, const World& world, const ViewPose& start,
                     std::uint64_t seed, Px4::Start how)
    : Quadrotor(config, world, start_state(config, world, start, how), seed, how) {}

Quadrotor::Quadrotor(const VehicleConfig& config, const World& world, const VehicleState& start,
                     std::uint64_t seed, Px4::Start how)
    : config_(config),
      how_(how),
      vehicle_(config.airframe, world, start, start_speeds_rad_s(config.airframe, how)),
      estimator_(config.estimate, seed, start),
      estimate_(estimator_.step(start)),
      px4_(config.autopilot, config.airframe, estimate_, how) {}

std::int64_t Quadrotor::tick() const { return px4_.tick(); }
VehicleState Quadrotor::state() const { return vehicle_.state(); }
VehicleState Quadrotor::estimate() const { return estimate_; }
void Quadrotor::command(const Setpoint& setpoint) { px4_.offboard_setpoint(setpoint); }
double Quadrotor::energy_wh() const { return energy_j_ / kJoulesPerWattHour; }

bool Quadrotor::has_collided() const {
  return vehicle_.has_touched_structure() ||
         (how_ == Px4::Start::airborne_offboard && vehicle_.has_touched_ground());
}

double Quadrotor::power_w() const {
  return gnbv::power_w(config_.power, vehicle_.thrust_n(), vehicle_.state().v_world_m_s);
}

void Quadrotor::step() {
  bool is_first = true;
  vehicle_.step([&](const Vec3& omega_body_rad_s) {
    return std::exchange(is_first, false) ? px4_.step(estimate_) : px4_.rate_step(omega_body_rad_s);
  });
  estimate_ = estimator_.step(vehicle_.state());
  energy_j_ += kTick_s * power_w();
}

}  // namespace gnbv
