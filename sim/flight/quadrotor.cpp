#include "sim/flight/quadrotor.hpp"

#include <cmath>
#include <utility>

#include "sim/core/error.hpp"
#include "sim/flight/allocation.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {
namespace {

/// Level, and in still air, unless a vehicle in the air has a mean wind to lean against.
HoverTrim start_trim(const VehicleConfig& config, const WindConfig& wind, Px4::Start how) {
  if (how == Px4::Start::on_ground || wind.mean_world_m_s.isZero(0.0)) return {};
  return hover_trim(config, wind.mean_world_m_s);
}

VehicleState start_state(const VehicleConfig& config, const World& world, const ViewPose& start,
                         Px4::Start how, const HoverTrim& trim) {
  ViewPose pose = start;
  if (how == Px4::Start::on_ground) {
    if (!world.has_ground) {
      throw BadInput("a vehicle cannot start on the ground of a world that has no ground");
    }
    pose.p_world_m.z() = 0.5 * config.airframe.hull_height_m;
  }
  VehicleState state{T_world_body(pose)};
  if (trim.tilt_rad > 0.0) {
    const Vec3 thrust_world(trim.a_world_m_s2.x(), trim.a_world_m_s2.y(),
                            config.airframe.gravity_m_s2);
    const Eigen::Matrix3d R_world_level = state.T_world_body.linear();
    state.T_world_body.linear() =
        Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), thrust_world).toRotationMatrix() *
        R_world_level;
  }
  return state;
}

RotorSpeeds start_speeds_rad_s(const AirframeParameters& airframe, Px4::Start how,
                               const HoverTrim& trim) {
  if (how == Px4::Start::on_ground) return {};
  const Allocation allocation = allocation_of(airframe);
  RotorSpeeds speeds_rad_s{};
  for (std::size_t i = 0; i < allocation.rotors; ++i) {
    const double share = allocation.thrust[i];
    speeds_rad_s[i] =
        trim.command > 0.0
            ? airframe.idle_speed_rad_s + airframe.command_gain_rad_s * (trim.command * share)
            : std::lerp(airframe.idle_speed_rad_s, hover_speed_rad_s(airframe), share);
  }
  return speeds_rad_s;
}

}  // namespace

Quadrotor::Quadrotor(const VehicleConfig& config, const World& world, const ViewPose& start,
                     std::uint64_t seed, Px4::Start how, const WindConfig& wind)
    : Quadrotor(config, world,
                start_state(config, world, start, how, start_trim(config, wind, how)), seed, how,
                wind, start_trim(config, wind, how)) {}

Quadrotor::Quadrotor(const VehicleConfig& config, const World& world, const VehicleState& start,
                     std::uint64_t seed, Px4::Start how, const WindConfig& wind,
                     const HoverTrim& trim)
    : config_(config),
      may_touch_ground_(how == Px4::Start::on_ground),
      wind_(wind, seed),
      wind_world_m_s_(wind.mean_world_m_s),
      vehicle_(config.airframe, world, start, start_speeds_rad_s(config.airframe, how, trim)),
      estimator_(config.estimate, seed, start),
      estimate_(estimator_.step(start)),
      px4_(config.autopilot, config.airframe, estimate_, how) {
  px4_.trim(trim.a_world_m_s2);
}

std::int64_t Quadrotor::tick() const { return px4_.tick(); }
VehicleState Quadrotor::state() const { return vehicle_.state(); }
VehicleState Quadrotor::estimate() const { return estimate_; }
void Quadrotor::command(const Setpoint& setpoint) { px4_.offboard_setpoint(setpoint); }
double Quadrotor::energy_wh() const { return energy_j_ / kJoulesPerWattHour; }

bool Quadrotor::has_collided() const {
  return vehicle_.has_touched_structure() || (!may_touch_ground_ && vehicle_.has_touched_ground());
}

void Quadrotor::land() {
  may_touch_ground_ = true;
  px4_.set_mode(NavState::land);
}

double Quadrotor::power_w() const {
  return gnbv::power_w(config_.power, vehicle_.thrust_n(),
                       vehicle_.state().v_world_m_s - wind_world_m_s_);
}

void Quadrotor::step() {
  const VehicleState& truth = vehicle_.state();
  wind_world_m_s_ = wind_.step(truth.T_world_body.translation(), truth.v_world_m_s);
  bool is_first = true;
  vehicle_.step(
      [&](const Vec3& omega_body_rad_s) {
        return std::exchange(is_first, false) ? px4_.step(estimate_)
                                              : px4_.rate_step(omega_body_rad_s);
      },
      wind_world_m_s_);
  estimate_ = estimator_.step(vehicle_.state());
  energy_j_ += kTick_s * power_w();
}

}  // namespace gnbv
