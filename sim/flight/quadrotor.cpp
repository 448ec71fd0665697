#include "sim/flight/quadrotor.hpp"

#include <cmath>

#include "sim/core/error.hpp"
#include "sim/flight/guidance.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

/// Level and in still air, unless a vehicle in the air has a mean wind to lean against.
struct Quadrotor::Beginning {
  VehicleState state;
  RotorSpeeds speeds_rad_s{};
  HoverTrim trim;
};

Quadrotor::Beginning Quadrotor::begin(const VehicleConfig& config, const World& world,
                                      const ViewPose& start, Px4::Start how,
                                      const Vec3& wind_world_m_s) {
  const AirframeParameters& airframe = config.airframe;
  Beginning beginning{.state = {T_world_body(start)}, .trim = {}};
  Isometry& T = beginning.state.T_world_body;
  if (how == Px4::Start::on_ground) {
    const double ground_m = ground_height_m(world, start.p_world_m);
    if (std::isinf(ground_m)) {
      throw BadInput("a vehicle cannot start on the ground of a world that has no ground");
    }
    T.translation().z() = ground_m + 0.5 * airframe.hull_height_m;
    return beginning;
  }
  HoverTrim& trim = beginning.trim;
  if (!wind_world_m_s.isZero(0.0)) trim = hover_trim(config, wind_world_m_s);
  if (trim.tilt_rad > 0.0) {
    const Vec3 thrust_world(trim.a_world_m_s2.x(), trim.a_world_m_s2.y(), airframe.gravity_m_s2);
    const Eigen::Matrix3d R_world_level = T.linear();
    T.linear() = turn_between(Vec3::UnitZ(), thrust_world).toRotationMatrix() * R_world_level;
  }
  const Allocation allocation = allocation_of(airframe);
  for (std::size_t i = 0; i < allocation.rotors; ++i) {
    const double share = allocation.thrust[i];
    beginning.speeds_rad_s[i] =
        trim.command > 0.0
            ? airframe.idle_speed_rad_s + airframe.command_gain_rad_s * (trim.command * share)
            : std::lerp(airframe.idle_speed_rad_s, hover_speed_rad_s(airframe), share);
  }
  return beginning;
}

Quadrotor::Quadrotor(const VehicleConfig& config, const World& world, const ViewPose& start,
                     std::uint64_t seed, Px4::Start how, const WindConfig& wind)
    : Quadrotor(config, world, begin(config, world, start, how, wind.mean_world_m_s), seed, how,
                wind) {}

Quadrotor::Quadrotor(const VehicleConfig& config, const World& world, const Beginning& beginning,
                     std::uint64_t seed, Px4::Start how, const WindConfig& wind)
    : config_(config),
      may_touch_ground_(how == Px4::Start::on_ground),
      wind_(wind, seed),
      wind_world_m_s_(wind.mean_world_m_s),
      vehicle_(config.airframe, world, beginning.state, beginning.speeds_rad_s),
      estimator_(config.estimate, seed, beginning.state),
      estimate_(estimator_.step(beginning.state)),
      px4_(config.autopilot, config.airframe, estimate_, how) {
  px4_.trim(beginning.trim.a_world_m_s2);
  specific_force_body_m_s2_ = {0.0, 0.0, config.airframe.gravity_m_s2};
}

bool Quadrotor::has_collided() const {
  return vehicle_.has_touched_structure() || (!may_touch_ground_ && vehicle_.has_touched_ground());
}

void Quadrotor::land() {
  may_touch_ground_ = true;
  px4_.set_mode(NavState::land);
}

void Quadrotor::step() {
  const VehicleState truth = vehicle_.state();
  const bool was_armed = px4_.is_armed();  // its rotors stand still otherwise, in whatever wind
  wind_world_m_s_ = wind_.step(truth.T_world_body.translation(), truth.v_world_m_s);
  bool is_first = true;
  vehicle_.step(
      [&](const Vec3& omega_body_rad_s) {
        return std::exchange(is_first, false) ? px4_.step(estimate_)
                                              : px4_.rate_step(omega_body_rad_s);
      },
      wind_world_m_s_);
  const VehicleState& after = vehicle_.state();
  Vec3 felt_world_m_s2 = (after.v_world_m_s - truth.v_world_m_s) / kTick_s;
  felt_world_m_s2.z() += config_.airframe.gravity_m_s2;
  specific_force_body_m_s2_ = after.T_world_body.linear().transpose() * felt_world_m_s2;
  estimate_ = estimator_.step(after);
  power_w_ = !was_armed ? 0.0
                        : gnbv::power_w(config_.power, vehicle_.thrust_n(),
                                        after.v_world_m_s - wind_world_m_s_);
  energy_j_ += kTick_s * power_w_;
}

}  // namespace gnbv
