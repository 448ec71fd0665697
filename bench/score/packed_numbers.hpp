// Numbers as few bytes, for files of many small ones.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/file.hpp"

namespace gnbv {

/// Appends seven bits a byte, the lowest first; the high bit says that more follow.
inline void put_count(std::string& bytes, std::uint64_t count) {
  for (; count >= 0x80; count >>= 7) append_bytes(bytes, static_cast<std::uint8_t>(count | 0x80));
  append_bytes(bytes, static_cast<std::uint8_t>(count));
}

/// How many there are, and their gaps, which are small: neighbouring voxels differ by one.
template <typename T>
void put_ascending(std::string& bytes, const std::vector<T>& numbers) {
  put_count(bytes, numbers.size());
  T before = 0;
  for (const T number : numbers) put_count(bytes, number - std::exchange(before, number));
}

/// Takes them off again; is_good() turns false at the first that is not there.
class PackedNumbers {
 public:
  explicit PackedNumbers(std::string_view bytes) : left_(bytes) {}
  bool is_good() const { return is_good_; }
  /// Whether all of it was there, and nothing else.
  bool is_read() const { return is_good_ && left_.empty(); }

  template <typename T>
  T take() {
    T value{};
    is_good_ = is_good_ && left_.size() >= sizeof value;
    if (!is_good_) return value;
    std::memcpy(&value, left_.data(), sizeof value);
    left_.remove_prefix(sizeof value);
    return value;
  }
  std::uint64_t take_count() {
    std::uint64_t count = 0;
    for (unsigned shift = 0; shift < 64 && is_good_; shift += 7) {
      const auto byte = take<std::uint8_t>();
      count |= static_cast<std::uint64_t>(byte & 0x7fU) << shift;
      if ((byte & 0x80U) == 0) return count;
    }
    is_good_ = false;
    return 0;
  }
  template <typename T>
  std::vector<T> take_ascending() {
    std::vector<T> numbers;
    T number = 0;
    for (std::uint64_t left = take_count(); left > 0 && is_good_; --left) {
      numbers.push_back(number += static_cast<T>(take_count()));
    }
    return numbers;
  }

 private:
  std::string_view left_;
  bool is_good_ = true;
};

}  // namespace gnbv
