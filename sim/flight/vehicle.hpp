// The rigid quadrotor in a solid world: rotor references in, true motion out.
#pragma once

#include <functional>
#include <memory>

#include "sim/flight/flight.hpp"
#include "sim/flight/rotors.hpp"

namespace gnbv {

class RigidVehicle {
 public:
  /// The world is copied into the collision scene. Throws BrokenInvariant on a NaN in `start`.
  RigidVehicle(const AirframeParameters& airframe, const World& world, const VehicleState& start,
               const RotorSpeeds& start_rad_s);
  ~RigidVehicle();
  RigidVehicle(const RigidVehicle&) = delete;
  RigidVehicle& operator=(const RigidVehicle&) = delete;

  /// Rotor references (0 = disarmed) for a body rate, in body axes.
  using RateControl = std::function<RotorSpeeds(const Vec3& omega_body_rad_s)>;

  /// Advances one tick in kRateStepsPerTick steps, in air that moves with that velocity: the rotors
  /// push with the speeds they have, then follow the references, as in Gazebo. The body rate that
  /// `control` sees at each step is carried forward with the rotors' torque; Bullet then moves the
  /// body with the mean of the pushes. Throws BrokenInvariant when the state becomes NaN or
  /// infinite.
  void step(const RateControl& control, const Vec3& wind_world_m_s = Vec3::Zero());

  const VehicleState& state() const;
  const RotorSpeeds& rotor_speeds_rad_s() const;  // for tests: nothing flown measures them
  /// Sum of the rotors' thrust during the last tick.
  double thrust_n() const;
  /// Whether the hull has touched the structure or an obstacle, or the ground or terrain, since the
  /// start.
  bool has_touched_structure() const;
  bool has_touched_ground() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace gnbv
