// Who is heard: one client by its address, and every frame once.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/mavlink/frame.hpp"

namespace gnbv::mavlink {

/// IPv4, host byte order.
struct Address {
  std::uint32_t host = 0;
  std::uint16_t port = 0;
  bool operator==(const Address&) const = default;
};

/// Every byte that arrived ends in one of these; only `accepted` went on.
struct LinkCounts {
  ReadCounts frames;
  std::uint64_t datagrams = 0;
  std::uint64_t oversized_datagrams = 0;  // longer than the receiver's buffer
  std::uint64_t foreign_datagrams = 0;    // from another address than the client's
  std::uint64_t replayed = 0;
  std::uint64_t accepted = 0;
};

/// Drops frames that were heard before. A frame whose sequence number is among those of the last
/// kWindow frames accepted from the same sender is a replay; the window is less than half of the
/// 256 numbers, so that every second frame of an honest sender may be lost. A sender from whom
/// nothing was accepted for kRestart_s begins anew, as a restarted client does.
class ReplayFilter {
 public:
  static constexpr std::uint64_t kWindow = 127;
  static constexpr double kRestart_s = 1.0;

  /// Whether the frame is new. `now_s` is any clock that never goes back.
  bool accept(const Frame& frame, double now_s);

 private:
  struct Sender {
    std::uint8_t system_id = 0;
    std::uint8_t component_id = 0;
    double accepted_last_s = 0.0;
    std::uint64_t accepted_count = 0;
    std::array<std::uint64_t, 256>
        accepted_as{};  // by sequence number: the count then, 0 for never
  };
  /// A client speaks as a handful of components at most; the one silent for longest is forgotten.
  static constexpr std::size_t kSendersMax = 8;
  Sender& sender_of(const Frame& frame, double now_s);

  std::vector<Sender> senders_;
};

/// The first address from which a good frame comes is the client's, until it was silent for
/// kClientSilence_s; what other addresses send meanwhile is not read.
class Link {
 public:
  static constexpr double kClientSilence_s = 5.0;

  /// The datagram's frames that are good, new, and the client's.
  std::vector<Frame> receive(std::span<const std::uint8_t> datagram, const Address& from,
                             double now_s);
  /// A datagram that did not fit the receiver's buffer.
  void count_oversized_datagram();

  const std::optional<Address>& client() const { return client_; }
  const LinkCounts& counts() const { return counts_; }

 private:
  std::optional<Address> client_;
  double client_heard_s_ = 0.0;
  ReplayFilter replays_;
  LinkCounts counts_;
};

}  // namespace gnbv::mavlink
