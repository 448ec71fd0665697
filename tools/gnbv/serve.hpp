// The vehicle in real time: simulation paced by the wall clock, MAVLink served meanwhile.
#pragma once

#include <cstdint>
#include <functional>

#include "sim/mavlink/endpoint.hpp"
#include "sim/mavlink/udp.hpp"
#include "sim/quadrotor.hpp"

namespace gnbv {

struct ServeOptions {
  double speed = 1.0;       // simulated seconds per wall second
  double duration_s = 0.0;  // simulated; 0: until should_stop
  std::function<bool()> should_stop;
  std::function<void()> on_lag;  // called once, when the machine cannot keep up
};

enum class ServeEnd { stopped, duration, collision };

/// What no client sees: how it ended, and how long it took by the wall clock.
struct ServeResult {
  ServeEnd end = ServeEnd::stopped;
  double wall_s = 0.0;
};

/// Steps the vehicle and serves the endpoint until one of the ends. A client's messages take effect
/// at the next tick. Time that the machine cannot catch up with is given up: the simulation then
/// runs slower than asked for, and never in bursts.
ServeResult serve(Quadrotor& vehicle, mavlink::Endpoint& endpoint, mavlink::UdpSocket& socket,
                  const ServeOptions& options);

}  // namespace gnbv
