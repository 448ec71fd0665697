// The vehicle's end of a MAVLink connection, without the network: datagrams in, frames out. The
// vehicle is component 1 of its system, its camera component 100. Both speak MAVLink 2.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/flight/quadrotor.hpp"
#include "sim/mavlink/aboard.hpp"
#include "sim/mavlink/link.hpp"
#include "sim/mavlink/mission_exchange.hpp"
#include "sim/mavlink/telemetry.hpp"

namespace gnbv::mavlink {

/// What became of the frames that the link accepted, and what was sent.
struct EndpointCounts {
  std::uint64_t setpoints = 0;
  std::uint64_t refused_setpoints = 0;
  std::uint64_t commands = 0;
  std::uint64_t questions = 0;  // parameters, missions, time
  std::uint64_t ignored = 0;    // for another system, or a message that the vehicle does not read
  std::uint64_t unsaid = 0;     // beyond kOutgoingMax
  std::uint64_t sent = 0;
};

/// Frames between two calls of Endpoint::take_outgoing; more are lost, as the network loses frames:
/// whatever a client asks, the answers take a bounded time.
constexpr std::size_t kOutgoingMax = 256;

/// What the vehicle says of its own accord, to every client.
struct News {
  std::vector<gnbv::StatusText> texts;
  std::vector<std::uint16_t> reached;  // items of the mission
  std::vector<std::size_t> were_set;   // parameters, by whichever client
};
/// What there is since the last call; with the news of arming comes where local NED counts from.
News take_news(Aboard& aboard, Quadrotor& vehicle);

/// One link of the vehicle to a client; several share what is aboard.
class Endpoint {
 public:
  /// A partner is spoken to before it says anything, and is the only one who is heard.
  explicit Endpoint(Aboard& aboard, std::optional<Address> partner = std::nullopt)
      : aboard_(aboard), link_(partner, aboard.system_id) {}

  /// Does what the client asks for. COMMAND_LONG, COMMAND_INT and SET_MODE are each acknowledged;
  /// DO_REPOSITION has a place on the globe, or a local one in COMMAND_INT's frame 1. Setpoints of
  /// position, local and global, are flown or refused. What a client asks at connection
  /// (QGroundControl waits for each) is answered: parameters, by PX4's names, bounded, always with
  /// the value that holds; the mission protocol; TIMESYNC and PING. `now_s` is wall time from any
  /// origin.
  void receive(std::span<const std::uint8_t> datagram, const Address& from, double now_s,
               Quadrotor& vehicle);
  void count_oversized_datagram() { link_.count_oversized_datagram(); }

  /// The frames to send to client(), each a datagram: acknowledgements, texts, and the telemetry
  /// that is due by wall time. Empty without a client. State and position are the autopilot's
  /// estimate; times are simulation time.
  std::vector<std::vector<std::uint8_t>> take_outgoing(double now_s, const Quadrotor& vehicle,
                                                       const News& news);
  /// Takes note that one of them went out.
  void count_sent() { ++counts_.sent; }

  const std::optional<Address>& client() const { return link_.client(); }
  const LinkCounts& link_counts() const { return link_.counts(); }
  const EndpointCounts& counts() const { return counts_; }

 private:
  struct Handler;  // of each message that a client may send

  VehicleReport report_of(const Quadrotor& vehicle) const;
  bool answers_as_camera(const Frame& frame, const Quadrotor& vehicle);
  void refuse_setpoint(const std::string& reason, double now_s);
  void say(const gnbv::StatusText& text);
  void send(Frame frame);

  Aboard& aboard_;
  MissionExchange missions_;
  Link link_;
  EndpointCounts counts_;
  std::vector<std::vector<std::uint8_t>> outgoing_;
  std::uint8_t sequence_ = 0;
  std::uint16_t text_id_ = 0;
  std::string refusal_told_;
  double refusal_told_s_ = 0.0;
  Streams streams_;
};

}  // namespace gnbv::mavlink
