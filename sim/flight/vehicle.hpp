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
  /// Shares what stands still. Throws std::runtime_error where the hull touches something: what
  /// Bullet remembers of a contact cannot be copied.
  RigidVehicle(const RigidVehicle& other);
  ~RigidVehicle();

  /// Rotor references (0 = disarmed) for a body rate, in body axes.
  using RateControl = std::function<RotorSpeeds(const Vec3& omega_body_rad_s)>;

  /// Advances one tick in kRateStepsPerTick steps, in air that moves with that velocity: the rotors
  /// push with the speeds they have, then follow the references, as in Gazebo. The body rate that
  /// `control` sees at each step is carried forward with the rotors' torque; Bullet then moves the
  /// body with the mean of the pushes. Throws BrokenInvariant when the state becomes NaN or
  /// infinite.
  void step(const RateControl& control, const Vec3& wind_world_m_s = Vec3::Zero());

  const VehicleState& state() const { return state_; }
  /// Sum of the rotors' thrust during the last tick.
  double thrust_n() const { return thrust_n_; }
  /// Whether the hull has touched the structure or an obstacle since the start.
  bool has_touched_structure() const { return has_touched_structure_; }
  /// The same of the ground and terrain.
  bool has_touched_ground() const { return has_touched_ground_; }
  /// As if it had never touched the ground so far.
  void forget_ground() { has_touched_ground_ = false; }

 private:
  struct Scene;  // what Bullet knows

  /// Turns the rotors through one tick; their mean wrench.
  Wrench turn_rotors(const RateControl& control, const Vec3& wind_world_m_s);
  /// Angular velocity, in world axes, of a body at attitude R with this angular momentum.
  Vec3 omega_world(const Eigen::Matrix3d& R_world_body, const Vec3& L_world) const;
  /// Notes what the hull touches, and takes away the part of the velocity that leads into it.
  Vec3 feel_contacts(const Vec3& v_world_m_s);
  void check() const;

  AirframeParameters airframe_;
  RotorLag lag_;
  VehicleState state_;
  // The momenta, kept so that rounding alone can change them. At rest on the ground the velocity
  // here is that of half a tick of free fall, which Bullet takes away in the middle of the tick.
  Vec3 v_world_m_s_;
  Vec3 angular_momentum_world_n_m_s_;
  RotorSpeeds speeds_rad_s_;
  double thrust_n_ = 0.0;
  bool has_touched_structure_ = false;
  bool has_touched_ground_ = false;
  std::unique_ptr<Scene> scene_;
};

}  // namespace gnbv
