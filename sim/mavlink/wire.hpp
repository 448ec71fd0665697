// Between a message's struct and its bytes: the fields in the order in which they are declared,
// little endian.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace gnbv::mavlink {
namespace detail {

/// Converts to any field's type, so that Message{Any, Any, ...} compiles up to its fields' number.
struct Any {
  template <typename T>
  operator T() const;  // NOLINT: has to be implicit; never called
};

template <typename Message, std::size_t... i>
constexpr bool takes(std::index_sequence<i...>) {
  return requires { Message{(static_cast<void>(i), Any{})...}; };
}

template <typename Message, std::size_t count = 0>
constexpr std::size_t field_count() {
  if constexpr (takes<Message>(std::make_index_sequence<count + 1>{})) {
    return field_count<Message, count + 1>();
  } else {
    return count;
  }
}

/// References to a message's fields: C++20 can only take a struct apart by a known number of names.
template <std::size_t count>
auto tied(auto& message) {
  static_assert(count >= 2 && count <= 16, "a message with that many fields needs a line here");
  if constexpr (count == 2) {
    auto& [a, b] = message;
    return std::tie(a, b);
  } else if constexpr (count == 3) {
    auto& [a, b, c] = message;
    return std::tie(a, b, c);
  } else if constexpr (count == 4) {
    auto& [a, b, c, d] = message;
    return std::tie(a, b, c, d);
  } else if constexpr (count == 5) {
    auto& [a, b, c, d, e] = message;
    return std::tie(a, b, c, d, e);
  } else if constexpr (count == 6) {
    auto& [a, b, c, d, e, f] = message;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (count == 7) {
    auto& [a, b, c, d, e, f, g] = message;
    return std::tie(a, b, c, d, e, f, g);
  } else if constexpr (count == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = message;
    return std::tie(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (count == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = message;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (count == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = message;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (count == 14) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = message;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  } else {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = message;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
  }
}

template <std::integral T>
void write(std::vector<std::uint8_t>& bytes, T value) {
  const auto bits = static_cast<std::make_unsigned_t<T>>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(bits) >> (8 * i)));
  }
}
inline void write(std::vector<std::uint8_t>& bytes, float value) {
  write(bytes, std::bit_cast<std::uint32_t>(value));
}
template <typename T, std::size_t N>
void write(std::vector<std::uint8_t>& bytes, const std::array<T, N>& values) {
  for (const T& value : values) write(bytes, value);
}

template <std::integral T>
void read(std::span<const std::uint8_t>& bytes, T& value) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) bits |= std::uint64_t{bytes[i]} << (8 * i);
  value = static_cast<T>(bits);
  bytes = bytes.subspan(sizeof(T));
}
inline void read(std::span<const std::uint8_t>& bytes, float& value) {
  std::uint32_t bits = 0;
  read(bytes, bits);
  value = std::bit_cast<float>(bits);
}
template <typename T, std::size_t N>
void read(std::span<const std::uint8_t>& bytes, std::array<T, N>& values) {
  for (T& value : values) read(bytes, value);
}

}  // namespace detail

/// The payload with all its fields, Message::kInfo.size bytes, little endian.
template <typename Message>
std::vector<std::uint8_t> payload_of(const Message& message) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(Message::kInfo.size);
  std::apply([&](const auto&... field) { (detail::write(bytes, field), ...); },
             detail::tied<detail::field_count<Message>()>(message));
  return bytes;
}

/// The reverse. `payload` holds at least Message::kInfo.size bytes.
template <typename Message>
Message message_of(std::span<const std::uint8_t> payload) {
  Message message;
  std::apply([&](auto&... field) { (detail::read(payload, field), ...); },
             detail::tied<detail::field_count<Message>()>(message));
  return message;
}

}  // namespace gnbv::mavlink
