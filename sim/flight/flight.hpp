// What flies: setpoints in, true motion out. Two implementations live behind it: the quadrotor in
// Bullet behind PX4, and an ideal vehicle that moves as commanded.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "sim/core/pose.hpp"
#include "sim/flight/vehicle_config.hpp"

namespace gnbv {

struct World;

/// Physics and control tick: 4 ms, as Gazebo's worlds/empty.world. Time is a count of ticks.
constexpr std::int64_t kTicksPerSecond = 250;
constexpr double kTick_s = 1.0 / static_cast<double>(kTicksPerSecond);
/// Within a tick, the rate loop and the rotors run at 1 kHz.
constexpr int kRateStepsPerTick = 4;
constexpr double kRateStep_s = kTick_s / kRateStepsPerTick;

constexpr double kNotControlled = std::numeric_limits<double>::quiet_NaN();

/// PX4's TrajectorySetpoint in our world frame (ENU, FLU). Beside a position the velocity is its
/// feed-forward, beside either the acceleration. Each axis needs one of the three, x and y come in
/// pairs; otherwise the vehicle stops and holds.
struct Setpoint {
  Vec3 p_world_m = Vec3::Constant(kNotControlled);
  Vec3 v_world_m_s = Vec3::Constant(kNotControlled);
  Vec3 a_world_m_s2 = Vec3::Constant(kNotControlled);
  double yaw_rad = kNotControlled;
  double yaw_rate_rad_s = kNotControlled;
};

struct VehicleState {
  Isometry T_world_body = Isometry::Identity();
  Vec3 v_world_m_s = Vec3::Zero();
  Vec3 omega_body_rad_s = Vec3::Zero();
};

class Flight {
 public:
  virtual ~Flight() = default;
  /// Another one in the same state, which flies on as this one would, bit by bit. Throws
  /// std::runtime_error for a vehicle that touches something.
  virtual std::unique_ptr<Flight> clone() const = 0;
  /// Ticks since the start.
  virtual std::int64_t tick() const = 0;
  /// The truth.
  virtual VehicleState state() const = 0;
  /// What the autopilot, the guidance and the map believe (VehicleConfig::estimate).
  virtual VehicleState estimate() const = 0;
  /// Holds until the next call. A quadrotor gives it up after CommanderParameters::offboard_loss_s
  /// without another, and stays where it is.
  virtual void command(const Setpoint& setpoint) = 0;
  /// From now on touching the ground counts, as it always does for one that began in the air.
  virtual void leave_ground() = 0;
  /// From now on the vehicle lands where it is, whatever is commanded, and may touch the ground.
  virtual void land() = 0;
  /// Landed, with its rotors off. Never in a world without ground.
  virtual bool has_landed() const = 0;
  /// Advances one tick. Throws BrokenInvariant when the state becomes NaN.
  virtual void step() = 0;
  /// Whether the vehicle has touched the structure or the ground since the start.
  virtual bool has_collided() const = 0;
  /// Energy drawn since the start, by PowerParameters' law.
  virtual double energy_wh() const = 0;
};

/// An airborne vehicle hovering at `start` (rotors at hover speed), in a world rebuilt for it.
/// `seed` keys the errors of the estimate and the gusts.
/// VehicleKind::quadrotor: armed and in OFFBOARD, leaning against the mean wind.
/// VehicleKind::ideal: level, takes position and yaw from the setpoint at once, integrates velocity
/// and yaw rate where these are not given, keeps what is not commanded. It knows where it is, feels
/// no wind, draws hover power and has no body to collide with. It lands on the highest terrain at
/// its x and y, else on the plane ground, whatever else is in between.
/// FlightStart::ground: at rest on the ground below `start`, armed and in OFFBOARD, its rotors off.
/// Where there is none, BadInput for a quadrotor, BrokenInvariant for the ideal vehicle.
enum class FlightStart { air, ground };
std::unique_ptr<Flight> make_flight(const VehicleConfig& config, const World& world,
                                    const ViewPose& start, std::uint64_t seed,
                                    const WindConfig& wind = {},
                                    FlightStart from = FlightStart::air);

/// World z of the highest terrain at (x, y), else of the plane ground; -infinity where there is
/// neither.
double ground_height_m(const World& world, const Vec3& at_m);

}  // namespace gnbv
