#include "sim/mavlink/udp.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

#include "sim/core/error.hpp"

namespace gnbv::mavlink {
namespace {

constexpr std::string_view kScheme = "udp://";

sockaddr_in to_system(const Address& address) {
  sockaddr_in system{};
  system.sin_family = AF_INET;
  system.sin_addr.s_addr = htonl(address.host);
  system.sin_port = htons(address.port);
  return system;
}

Address from_system(const sockaddr_in& system) {
  return {ntohl(system.sin_addr.s_addr), ntohs(system.sin_port)};
}

// the sockets interface takes every address family through this one type
sockaddr* generic(sockaddr_in& system) { return reinterpret_cast<sockaddr*>(&system); }

std::uint32_t resolve_host(const std::string& host, const std::string& url) {
  if (host.empty()) return INADDR_LOOPBACK;
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), nullptr, &hints, &found);
  if (error != 0) {
    throw BadInput(fmt::format("{}: host '{}': {}", url, host, gai_strerror(error)));
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(found, freeaddrinfo);
  sockaddr_in system{};
  std::memcpy(&system, found->ai_addr, sizeof system);
  return from_system(system).host;
}

/// The address behind the scheme of a URL.
Address address_in(const std::string& url, std::string_view scheme) {
  const std::size_t colon = url.rfind(':');
  if (colon < scheme.size()) {
    throw BadInput(fmt::format("'{}': expected {}HOST:PORT", url, scheme));
  }
  const std::string_view port_text = std::string_view(url).substr(colon + 1);
  Address address;
  const auto [end, error] =
      std::from_chars(port_text.data(), port_text.data() + port_text.size(), address.port);
  if (error != std::errc() || end != port_text.data() + port_text.size()) {
    throw BadInput(fmt::format("{}: port '{}' is not a number from 0 to 65535", url, port_text));
  }
  address.host = resolve_host(url.substr(scheme.size(), colon - scheme.size()), url);
  return address;
}

}  // namespace

std::string url_of(const Address& address) {
  return fmt::format("{}{}.{}.{}.{}:{}", kScheme, address.host >> 24, address.host >> 16 & 0xff,
                     address.host >> 8 & 0xff, address.host & 0xff, address.port);
}

bool is_loopback(const Address& address) { return address.host >> 24 == 127; }

Meeting resolve_meeting(const std::string& url) {
  if (url.starts_with("udpin://")) return {address_in(url, "udpin://"), false};
  if (url.starts_with(kScheme)) return {address_in(url, kScheme), false};
  if (!url.starts_with("udpout://")) {
    throw BadInput(
        fmt::format("'{}': expected udpout://HOST:PORT of a client to speak to, or "
                    "udpin://HOST:PORT to listen at",
                    url));
  }
  return {resolve_partner(url, "udpout://"), true};
}

Address resolve_partner(const std::string& url, std::string_view scheme) {
  const Address address = address_in(url, scheme);
  if (address.host == INADDR_ANY || address.port == 0) {
    throw BadInput(fmt::format("{}: nobody waits there; name the client's own address", url));
  }
  return address;
}

Address bound_for(const Meeting& meeting) {
  if (!meeting.speaks_first) return meeting.address;
  return {is_loopback(meeting.address) ? INADDR_LOOPBACK : INADDR_ANY, 0};
}

UdpSocket::UdpSocket(const Address& address)
    : descriptor_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  sockaddr_in system = to_system(address);
  if (descriptor_ >= 0 && bind(descriptor_, generic(system), sizeof system) == 0) return;
  const int error = errno;
  if (descriptor_ >= 0) close(descriptor_);
  throw BadInput(fmt::format("{}: cannot listen there: {}", url_of(address), std::strerror(error)));
}

UdpSocket::~UdpSocket() { close(descriptor_); }

Address UdpSocket::address() const {
  sockaddr_in system{};
  socklen_t size = sizeof system;
  GNBV_CHECK(getsockname(descriptor_, generic(system), &size) == 0, "{}", std::strerror(errno));
  return from_system(system);
}

std::optional<UdpSocket::Datagram> UdpSocket::receive() {
  sockaddr_in from{};
  socklen_t from_size = sizeof from;
  // with MSG_TRUNC the result is the datagram's own size, even where the buffer is smaller
  const ssize_t size =
      recvfrom(descriptor_, buffer_.data(), buffer_.size(), MSG_TRUNC, generic(from), &from_size);
  if (size < 0) return std::nullopt;
  const std::size_t kept = std::min(static_cast<std::size_t>(size), buffer_.size());
  return Datagram{.from = from_system(from),
                  .bytes = std::span(buffer_).first(kept),
                  .is_oversized = static_cast<std::size_t>(size) > buffer_.size()};
}

void UdpSocket::wait(double timeout_s) const {
  pollfd readable{.fd = descriptor_, .events = POLLIN, .revents = 0};
  constexpr long kSecond_ns = 1'000'000'000;
  const auto timeout_ns = static_cast<long>(1e9 * std::max(timeout_s, 0.0));
  const timespec timeout{timeout_ns / kSecond_ns, timeout_ns % kSecond_ns};
  ppoll(&readable, 1, &timeout, nullptr);
}

bool UdpSocket::send(std::span<const std::uint8_t> bytes, const Address& to) const {
  sockaddr_in system = to_system(to);
  return sendto(descriptor_, bytes.data(), bytes.size(), 0, generic(system), sizeof system) >= 0;
}

}  // namespace gnbv::mavlink
