// A client that repeats its last setpoint before every tick, so that the offboard stream of a
// quadrotor never dries up.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "sim/flight/flight.hpp"

namespace gnbv {

class StreamingFlight : public Flight {
 public:
  explicit StreamingFlight(std::unique_ptr<Flight> flight) : flight_(std::move(flight)) {}

  std::unique_ptr<Flight> clone() const override {
    auto copy = std::make_unique<StreamingFlight>(flight_->clone());
    copy->setpoint_ = setpoint_;
    return copy;
  }
  std::int64_t tick() const override { return flight_->tick(); }
  VehicleState state() const override { return flight_->state(); }
  VehicleState estimate() const override { return flight_->estimate(); }
  void command(const Setpoint& setpoint) override { setpoint_ = setpoint; }
  bool has_collided() const override { return flight_->has_collided(); }
  double energy_wh() const override { return flight_->energy_wh(); }
  void leave_ground() override { flight_->leave_ground(); }
  void land() override { flight_->land(); }
  bool has_landed() const override { return flight_->has_landed(); }
  void step() override {
    if (setpoint_) flight_->command(*setpoint_);
    flight_->step();
  }

 private:
  std::unique_ptr<Flight> flight_;
  std::optional<Setpoint> setpoint_;
};

inline std::unique_ptr<Flight> streaming(std::unique_ptr<Flight> flight) {
  return std::make_unique<StreamingFlight>(std::move(flight));
}

}  // namespace gnbv
