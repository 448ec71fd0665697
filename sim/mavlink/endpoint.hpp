// The vehicle's end of a MAVLink connection, without the network: datagrams in, frames out. The
// vehicle is system 1, component 1, and speaks MAVLink 2.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/flight/quadrotor.hpp"
#include "sim/mavlink/link.hpp"
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

class Endpoint {
 public:
  /// `battery_wh` as PowerParameters has it. A partner is spoken to before it says anything, and is
  /// the only one who is heard.
  explicit Endpoint(double battery_wh, std::optional<Address> partner = std::nullopt)
      : battery_wh_(battery_wh), link_(partner) {}

  /// Does what the client asks for. COMMAND_LONG, COMMAND_INT (no command known here has its x and
  /// y) and SET_MODE are each acknowledged. SET_POSITION_TARGET_LOCAL_NED is flown or refused. What
  /// a client asks at connection (QGroundControl waits for each) is answered: parameters, by PX4's
  /// names, bounded, always with the value that holds; the mission protocol, of which there is none
  /// (a count of 0, uploads refused); TIMESYNC and PING. `now_s` is wall time from any origin.
  void receive(std::span<const std::uint8_t> datagram, const Address& from, double now_s,
               Quadrotor& vehicle);
  void count_oversized_datagram() { link_.count_oversized_datagram(); }

  /// The frames to send to client(), each a datagram: acknowledgements, texts, and the telemetry
  /// that is due by wall time. Empty without a client. State and position are the autopilot's
  /// estimate; times are simulation time.
  std::vector<std::vector<std::uint8_t>> take_outgoing(double now_s, Quadrotor& vehicle);
  /// Takes note that one of them went out.
  void count_sent() { ++counts_.sent; }

  const std::optional<Address>& client() const { return link_.client(); }
  const LinkCounts& link_counts() const { return link_.counts(); }
  const EndpointCounts& counts() const { return counts_; }

 private:
  struct Handler;  // of each message that a client may send

  VehicleReport report_of(const Quadrotor& vehicle) const;
  void refuse_setpoint(const std::string& reason, double now_s);
  void say(const gnbv::StatusText& text);
  void send(Frame frame);

  double battery_wh_;
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
