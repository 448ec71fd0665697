// Flight by the rigid vehicle under the PX4 cascade, and the choice between it and the ideal one.
#include "sim/flight.hpp"

#include "sim/autopilot.hpp"
#include "sim/core/error.hpp"
#include "sim/ideal_flight.hpp"
#include "sim/vehicle.hpp"

namespace gnbv {
namespace {

class QuadrotorFlight final : public Flight {
 public:
  QuadrotorFlight(const VehicleConfig& config, const World& world, const ViewPose& start)
      : config_(config),
        vehicle_(config.airframe, world, VehicleState{T_world_body(start)},
                 uniform(hover_speed_rad_s(config.airframe))) {
    setpoint_.p_world_m = start.p_world_m;
    setpoint_.yaw_rad = start.yaw_rad;
  }

  std::int64_t tick() const override { return tick_; }
  VehicleState state() const override { return vehicle_.state(); }
  VehicleState estimate() const override { return vehicle_.state(); }
  void command(const Setpoint& setpoint) override { setpoint_ = setpoint; }
  bool has_collided() const override { return vehicle_.has_collided(); }
  double energy_wh() const override { return energy_j_ / kJoulesPerWattHour; }

  void step() override {
    const RotorCommands commands =
        autopilot(config_.autopilot, config_.airframe, memory_, tick_, vehicle_.state(), setpoint_);
    vehicle_.step(reference_speeds(config_.airframe, commands));
    energy_j_ +=
        kTick_s * power_w(config_.power, vehicle_.thrust_n(), vehicle_.state().v_world_m_s);
    ++tick_;
  }

 private:
  static RotorSpeeds uniform(double speed_rad_s) {
    RotorSpeeds speeds{};
    speeds.fill(speed_rad_s);
    return speeds;
  }

  VehicleConfig config_;
  RigidVehicle vehicle_;
  AutopilotMemory memory_;
  Setpoint setpoint_;
  std::int64_t tick_ = 0;
  double energy_j_ = 0.0;
};

}  // namespace

std::unique_ptr<Flight> make_flight(const VehicleConfig& config, const World& world,
                                    const ViewPose& start, std::uint64_t /*seed*/) {
  switch (config.kind) {
    case VehicleKind::quadrotor:
      return std::make_unique<QuadrotorFlight>(config, world, start);
    case VehicleKind::ideal:
      return make_ideal_flight(config, start);
  }
  throw BrokenInvariant("vehicle kind outside its enumeration");
}

}  // namespace gnbv
