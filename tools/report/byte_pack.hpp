// Arrays of numbers as one block of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Where an array lies in a BytePack.
struct ByteSlice {
  std::size_t at = 0;     // bytes from the beginning, a multiple of 4
  std::size_t count = 0;  // elements
};

/// Little-endian arrays one after the other, each aligned for the typed arrays of a browser.
class BytePack {
 public:
  template <typename T>
  requires std::is_arithmetic_v<T> ByteSlice add(std::span<const T> values) {
    const std::size_t at = (bytes_.size() + 3) / 4 * 4;
    bytes_.resize(at + values.size_bytes());
    if (!values.empty()) std::memcpy(bytes_.data() + at, values.data(), values.size_bytes());
    return {at, values.size()};
  }
  template <typename T>
  ByteSlice add(const std::vector<T>& values) {
    return add(std::span<const T>(values));
  }

  std::span<const std::uint8_t> bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Points as 16-bit steps between the corners of their bounding box: off by at most
/// size / 131070 an axis.
struct QuantisedPoints {
  Vec3f min_m = Vec3f::Zero();
  Vec3f size_m = Vec3f::Zero();
  std::vector<std::uint16_t> steps;  // (n, 3), 65535 = min + size
};

QuantisedPoints quantised(std::span<const Vec3f> points_m);

/// Point `i` as the page restores it.
Vec3f restored_point(const QuantisedPoints& points, std::size_t i);

}  // namespace gnbv
