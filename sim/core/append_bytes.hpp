// Values as binary files hold them.
#pragma once

#include <array>
#include <bit>
#include <string>

namespace gnbv {

/// The bytes of a number, the lowest first, behind those of `out`.
template <typename T>
void append_bytes(std::string& out, T value) {
  static_assert(std::endian::native == std::endian::little);
  const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  out.append(bytes.data(), bytes.size());
}

}  // namespace gnbv
