// The quadrotor with its autopilot in its world: what `gnbv fly` serves and what missions fly.
#pragma once

#include "sim/flight/disturbances.hpp"
#include "sim/flight/px4.hpp"
#include "sim/flight/vehicle.hpp"

namespace gnbv {

class Quadrotor final : public Flight {
 public:
  /// Rebuilds the physics world. on_ground: at rest on its hull at start.p_world_m with z ignored;
  /// airborne_offboard: hovering at `start`, in the mean wind, with rotors at hover speed.
  Quadrotor(const VehicleConfig& config, const World& world, const ViewPose& start,
            std::uint64_t seed, Px4::Start how, const WindConfig& wind = {});

  std::unique_ptr<Flight> clone() const override { return std::make_unique<Quadrotor>(*this); }
  std::int64_t tick() const override { return px4_.tick(); }
  VehicleState state() const override { return vehicle_.state(); }
  VehicleState estimate() const override { return estimate_; }
  /// A setpoint of the offboard stream.
  void command(const Setpoint& setpoint) override { px4_.offboard_setpoint(setpoint); }
  void leave_ground() override {
    may_touch_ground_ = false;
    vehicle_.forget_ground();
  }
  void land() override;
  bool has_landed() const override { return !px4_.is_armed(); }
  void step() override;
  /// The structure always counts; the ground counts only for a vehicle that started airborne and
  /// was not told to land.
  bool has_collided() const override;
  double energy_wh() const override { return energy_j_ / kJoulesPerWattHour; }
  /// Electrical power at the last tick.
  double power_w() const { return power_w_; }
  /// What an accelerometer at the centre of mass felt in the last tick.
  const Vec3& specific_force_body_m_s2() const { return specific_force_body_m_s2_; }

  Px4& px4() { return px4_; }
  const Px4& px4() const { return px4_; }

 private:
  struct Beginning;
  static Beginning begin(const VehicleConfig& config, const World& world, const ViewPose& start,
                         Px4::Start how, const Vec3& wind_world_m_s);
  Quadrotor(const VehicleConfig& config, const World& world, const Beginning& beginning,
            std::uint64_t seed, Px4::Start how, const WindConfig& wind);

  VehicleConfig config_;
  bool may_touch_ground_;
  Wind wind_;
  Vec3 wind_world_m_s_;  // at the last tick
  RigidVehicle vehicle_;
  StateEstimator estimator_;
  VehicleState estimate_;
  Px4 px4_;
  double power_w_ = 0.0;
  double energy_j_ = 0.0;
  Vec3 specific_force_body_m_s2_;
};

}  // namespace gnbv
