#include "sim/mavlink/serve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/stopwatch.hpp"

namespace gnbv {
namespace {

/// Reading ends after this part of a turn, so that a flood cannot stop the simulation.
constexpr double kHear_s = 0.3 * kTurn_s;

using Stations = std::span<const std::unique_ptr<Station>>;

void hear(Station& station, Quadrotor& vehicle, double now_s, double limit_s) {
  auto& [endpoint, socket] = station;
  for (const Stopwatch watch; watch.elapsed_s() < limit_s;) {
    const auto datagram = socket.receive();
    if (!datagram.has_value()) return;
    if (datagram->is_oversized) {
      endpoint.count_oversized_datagram();
    } else {
      endpoint.receive(datagram->bytes, datagram->from, now_s, vehicle);
    }
  }
}

void speak(mavlink::Aboard& aboard, Stations stations, Quadrotor& vehicle, double now_s) {
  const mavlink::News news = mavlink::take_news(aboard, vehicle);
  for (const auto& station : stations) {
    auto& [endpoint, socket] = *station;
    for (const auto& frame : endpoint.take_outgoing(now_s, vehicle, news)) {
      if (socket.send(frame, *endpoint.client())) endpoint.count_sent();
    }
  }
}

std::int64_t last_tick_of(double duration_s) {
  if (duration_s == 0.0) return std::numeric_limits<std::int64_t>::max();
  return static_cast<std::int64_t>(std::ceil(duration_s * static_cast<double>(kTicksPerSecond)));
}

}  // namespace

Station::Station(mavlink::Aboard& aboard, const mavlink::Meeting& meeting)
    : endpoint(aboard, meeting.speaks_first ? std::optional(meeting.address) : std::nullopt),
      socket(mavlink::bound_for(meeting)) {}

Pace::Pace(double speed)
    : ticks_per_s_(speed * static_cast<double>(kTicksPerSecond)),
      ticks_per_turn_(static_cast<std::int64_t>(std::ceil(2.0 * kTurn_s * ticks_per_s_))) {}

std::int64_t Pace::turn_end(std::int64_t tick, double now_s) const {
  const auto due = static_cast<std::int64_t>(std::floor((now_s - given_up_s_) * ticks_per_s_));
  return std::min(due, tick + ticks_per_turn_);
}

double Pace::due_s(std::int64_t tick) const {
  return given_up_s_ + static_cast<double>(tick) / ticks_per_s_;
}

bool Pace::give_up_lag(std::int64_t tick, double now_s) {
  const double lag_s = now_s - due_s(tick);
  if (lag_s * ticks_per_s_ * kTick_s <= kLagMax_s) return false;
  given_up_s_ += lag_s;
  return true;
}

ServeResult serve(Quadrotor& vehicle, mavlink::Aboard& aboard, Stations stations,
                  const ServeOptions& options) {
  const Stopwatch watch;
  const std::int64_t last_tick = last_tick_of(options.duration_s);
  Pace pace(options.speed);
  bool has_lagged = false;
  const auto end = [&]() -> std::optional<ServeEnd> {
    if (vehicle.has_collided()) return ServeEnd::collision;
    if (vehicle.tick() >= last_tick) return ServeEnd::duration;
    return std::nullopt;
  };
  while (!options.should_stop()) {
    // the first wakes it; the others are heard at the next tick
    stations[0]->socket.wait(std::min(pace.due_s(vehicle.tick() + 1) - watch.elapsed_s(), kTurn_s));
    for (const auto& station : stations) {
      hear(*station, vehicle, watch.elapsed_s(), kHear_s / static_cast<double>(stations.size()));
    }
    const double now_s = watch.elapsed_s();  // what was heard takes nothing of the steps' time
    const std::int64_t turn_end = pace.turn_end(vehicle.tick(), now_s);
    while (!end() && vehicle.tick() < turn_end && watch.elapsed_s() < now_s + kTurn_s) {
      vehicle.step();
    }
    speak(aboard, stations, vehicle, now_s);
    if (options.on_turn) options.on_turn(vehicle);
    if (end()) return {*end(), watch.elapsed_s()};
    if (pace.give_up_lag(vehicle.tick(), now_s) && !has_lagged) {
      has_lagged = true;
      options.on_lag();
    }
  }
  return {ServeEnd::stopped, watch.elapsed_s()};
}

}  // namespace gnbv
