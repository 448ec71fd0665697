// The vehicle in real time: simulation paced by the wall clock, MAVLink served meanwhile.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "sim/flight/quadrotor.hpp"
#include "sim/mavlink/endpoint.hpp"
#include "sim/mavlink/udp.hpp"

namespace gnbv {

struct ServeOptions {
  double speed = 1.0;       // simulated seconds per wall second
  double duration_s = 0.0;  // simulated; 0: until should_stop
  std::function<bool()> should_stop;
  std::function<void()> on_lag;  // called once, when time is given up for the first time
  std::function<void(const Quadrotor&)> on_turn = {};  // after each of its turns
};

enum class ServeEnd { stopped, duration, collision };

/// What no client sees: how it ended, and how long it took by the wall clock.
struct ServeResult {
  ServeEnd end = ServeEnd::stopped;
  double wall_s = 0.0;
};

/// The client is heard at least this often in wall time, whatever the speed.
constexpr double kTurn_s = 0.005;
/// Being further behind than this, in simulated time, is not made up for. It is a small part of the
/// silence after which PX4 takes the offboard stream for lost.
constexpr double kLagMax_s = 0.1;

/// Which ticks are due by the wall clock, which counts in seconds since the beginning.
class Pace {
 public:
  explicit Pace(double speed);
  /// The tick that a vehicle at `tick` is stepped to before the client is heard again: the one that
  /// is due, but never more than what two turns simulate at the asked speed.
  std::int64_t turn_end(std::int64_t tick, double now_s) const;
  /// When a tick is due.
  double due_s(std::int64_t tick) const;
  /// Gives up the lag of a vehicle at `tick` if it exceeds kLagMax_s; whether it did.
  bool give_up_lag(std::int64_t tick, double now_s);

 private:
  double ticks_per_s_;
  std::int64_t ticks_per_turn_;
  double given_up_s_ = 0.0;  // wall time
};

/// One of the links that are served: where, and to whom.
struct Station {
  /// Throws BadInput where that cannot be.
  Station(mavlink::Aboard& aboard, const mavlink::Meeting& meeting);
  mavlink::Endpoint endpoint;
  mavlink::UdpSocket socket;
};

/// Steps the vehicle and serves the stations until one of the ends. A client's messages take effect
/// at the next tick. After a stall at most kLagMax_s of simulated time is made up for, in turns
/// between which the client is heard; the rest is given up, and the simulation is slower than asked
/// for by that much. So a client is never lost because this program was late.
ServeResult serve(Quadrotor& vehicle, mavlink::Aboard& aboard,
                  std::span<const std::unique_ptr<Station>> stations, const ServeOptions& options);

}  // namespace gnbv
