#include "tools/gnbv/serve.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace gnbv {
namespace {

using Clock = std::chrono::steady_clock;

/// The client is looked after at least this often, whatever the speed.
constexpr double kTurn_s = 0.005;
/// More than this behind the wall clock is not made up for.
constexpr double kLagMax_s = 0.5;
/// Datagrams a turn, so that a flood cannot stop the simulation.
constexpr int kDatagramsPerTurn = 256;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void hear(mavlink::Endpoint& endpoint, mavlink::UdpSocket& socket, Quadrotor& vehicle,
          double now_s) {
  for (int i = 0; i < kDatagramsPerTurn; ++i) {
    const auto datagram = socket.receive();
    if (!datagram.has_value()) return;
    if (datagram->is_oversized) {
      endpoint.count_oversized_datagram();
    } else {
      endpoint.receive(datagram->bytes, datagram->from, now_s, vehicle);
    }
  }
}

void speak(mavlink::Endpoint& endpoint, const mavlink::UdpSocket& socket, Quadrotor& vehicle,
           double now_s) {
  for (const auto& frame : endpoint.take_outgoing(now_s, vehicle)) {
    socket.send(frame, *endpoint.client());
  }
}

/// From wall time to the tick that is due, with the time given up taken off.
class Pace {
 public:
  explicit Pace(double speed) : ticks_per_s_(speed * static_cast<double>(kTicksPerSecond)) {}
  std::int64_t due_tick(double now_s) const {
    return static_cast<std::int64_t>(std::floor((now_s - given_up_s_) * ticks_per_s_));
  }
  double due_s(std::int64_t tick) const {
    return given_up_s_ + static_cast<double>(tick) / ticks_per_s_;
  }
  /// Gives up the lag of a vehicle at `tick` if it is too great; whether it was.
  bool give_up_lag(std::int64_t tick, double now_s) {
    const double lag_s = now_s - due_s(tick);
    if (lag_s <= kLagMax_s) return false;
    given_up_s_ += lag_s;
    return true;
  }

 private:
  double ticks_per_s_;
  double given_up_s_ = 0.0;
};

std::int64_t last_tick_of(double duration_s) {
  if (duration_s == 0.0) return std::numeric_limits<std::int64_t>::max();
  return static_cast<std::int64_t>(std::ceil(duration_s * static_cast<double>(kTicksPerSecond)));
}

}  // namespace

ServeResult serve(Quadrotor& vehicle, mavlink::Endpoint& endpoint, mavlink::UdpSocket& socket,
                  const ServeOptions& options) {
  const Clock::time_point begin = Clock::now();
  const std::int64_t last_tick = last_tick_of(options.duration_s);
  Pace pace(options.speed);
  bool has_lagged = false;
  const auto end = [&]() -> std::optional<ServeEnd> {
    if (vehicle.has_collided()) return ServeEnd::collision;
    if (vehicle.tick() >= last_tick) return ServeEnd::duration;
    return std::nullopt;
  };
  while (!options.should_stop()) {
    socket.wait(std::min(pace.due_s(vehicle.tick() + 1) - seconds_since(begin), kTurn_s));
    const double now_s = seconds_since(begin);
    hear(endpoint, socket, vehicle, now_s);
    while (!end() && vehicle.tick() < pace.due_tick(now_s) &&
           seconds_since(begin) < now_s + kTurn_s) {
      vehicle.step();
    }
    speak(endpoint, socket, vehicle, now_s);
    if (end()) return {*end(), seconds_since(begin)};
    if (pace.give_up_lag(vehicle.tick(), now_s) && !has_lagged) {
      has_lagged = true;
      options.on_lag();
    }
  }
  return {ServeEnd::stopped, seconds_since(begin)};
}

}  // namespace gnbv
