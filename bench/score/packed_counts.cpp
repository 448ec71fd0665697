#include "bench/score/packed_counts.hpp"

namespace gnbv {

void put_count(std::uint64_t count, std::string& bytes) {
  for (; count >= 0x80; count >>= 7) bytes += static_cast<char>(count | 0x80);
  bytes += static_cast<char>(count);
}

std::optional<std::uint64_t> take_count(std::string_view& bytes) {
  std::uint64_t count = 0;
  for (unsigned shift = 0; shift < 64 && !bytes.empty(); shift += 7) {
    const auto byte = static_cast<unsigned char>(bytes.front());
    bytes.remove_prefix(1);
    count |= static_cast<std::uint64_t>(byte & 0x7fU) << shift;
    if ((byte & 0x80U) == 0) return count;
  }
  return std::nullopt;
}

}  // namespace gnbv
