// The rigid quadrotor in a solid world: rotor references in, true motion out.
#pragma once

#include <memory>

#include "sim/flight.hpp"
#include "sim/rotors.hpp"

namespace gnbv {

class RigidVehicle {
 public:
  /// The world is copied into the collision scene. Throws BrokenInvariant on a NaN in `start`.
  RigidVehicle(const AirframeParameters& airframe, const World& world, const VehicleState& start,
               const RotorSpeeds& start_rad_s);
  ~RigidVehicle();
  RigidVehicle(const RigidVehicle&) = delete;
  RigidVehicle& operator=(const RigidVehicle&) = delete;

  /// Advances one tick: the rotors push with the speeds they have, then follow the references
  /// (0 = disarmed), as in Gazebo. Throws BrokenInvariant when the state becomes NaN or infinite.
  void step(const RotorSpeeds& reference_rad_s);

  const VehicleState& state() const;
  const RotorSpeeds& rotor_speeds_rad_s() const;
  /// Sum of the rotors' thrust during the last tick.
  double thrust_n() const;
  /// Whether the hull has touched the structure, or the ground, since the start.
  bool has_touched_structure() const;
  bool has_touched_ground() const;
  bool has_collided() const { return has_touched_structure() || has_touched_ground(); }

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace gnbv
