// SHA-256 over typed data: result_sha256, and the keys of caches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

struct evp_md_ctx_st;  // OpenSSL's

namespace gnbv {

class Sha256 {
 public:
  Sha256();

  void add_bytes(std::span<const std::byte> bytes);
  void add(std::string_view text) { add_bytes(std::as_bytes(std::span(text.data(), text.size()))); }
  /// As little-endian machines store them.
  template <typename T>
  requires std::is_arithmetic_v<T>
  void add(std::span<const T> values) { add_bytes(std::as_bytes(values)); }
  template <typename T>
  requires std::is_arithmetic_v<T>
  void add(T value) { add(std::span<const T>(&value, 1)); }

  /// Call one of the two once, last.
  std::array<std::uint8_t, 32> digest();
  std::string hex();  // 64 lower-case digits

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/// hex() of a text alone.
std::string sha256_of(std::string_view text);

}  // namespace gnbv
