// The one file that talks to the network: a non-blocking UDP socket (POSIX, IPv4).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "sim/mavlink/link.hpp"

namespace gnbv::mavlink {

/// udp://a.b.c.d:port
std::string url_of(const Address& address);

/// Whether only this machine can send to it: 127.0.0.0/8.
bool is_loopback(const Address& address);

/// Where vehicle and client meet: at an address that the vehicle listens at, or at one where the
/// client waits and which the vehicle speaks to first, as PX4 does.
struct Meeting {
  Address address;
  bool speaks_first = false;
  bool operator==(const Meeting&) const = default;
};

/// "udpout://HOST:PORT" is spoken to, "udp://" and "udpin://" are listened at. HOST may be left out
/// and is then the loopback, never all interfaces; PORT 0 means any free one. Throws BadInput
/// naming the URL, as resolve_partner() does.
Meeting resolve_meeting(const std::string& url);
/// Where somebody waits, behind the scheme that the URL begins with. Throws BadInput naming it,
/// also where nobody can be spoken to: host 0.0.0.0 or port 0.
Address resolve_partner(const std::string& url, std::string_view scheme);
/// What the vehicle's socket binds for it: the address itself, or any free port; the loopback's
/// when the client is on this machine.
Address bound_for(const Meeting& meeting);

class UdpSocket {
 public:
  /// Binds. Throws BadInput with the address and the system's reason when that is not possible.
  explicit UdpSocket(const Address& address);
  ~UdpSocket();
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  /// Where it is bound, with the port that was found for 0.
  Address address() const;

  struct Datagram {
    Address from;
    std::span<const std::uint8_t> bytes;  // valid until the next call
    bool is_oversized = false;            // longer than the buffer; `bytes` is its beginning
  };
  /// The next datagram, if one has come.
  std::optional<Datagram> receive();
  /// Returns at the next datagram, after `timeout_s`, or on a signal.
  void wait(double timeout_s) const;
  /// Whether the system took it. UDP may lose it all the same.
  bool send(std::span<const std::uint8_t> bytes, const Address& to) const;

 private:
  int descriptor_ = -1;
  std::array<std::uint8_t, 2048> buffer_{};  // seven frames of the greatest size
};

}  // namespace gnbv::mavlink
