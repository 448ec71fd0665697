// Counts as few bytes, for files of many small ones.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gnbv {

/// Appends seven bits a byte, the lowest first; the high bit says that more follow.
void put_count(std::uint64_t count, std::string& bytes);

/// Takes a count off the front; nothing when the bytes end before it does.
std::optional<std::uint64_t> take_count(std::string_view& bytes);

}  // namespace gnbv
