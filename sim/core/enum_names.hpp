// Names of enumeration values in files and messages: one table, read both ways.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "sim/core/error.hpp"

namespace gnbv {

template <typename Enum>
struct Named {
  Enum value;
  std::string_view name;
};
template <typename Enum, std::size_t count>
using EnumNames = std::array<Named<Enum>, count>;

/// Throws BrokenInvariant for a value without a name.
template <typename Enum, std::size_t count>
constexpr std::string_view name_of(Enum value, const EnumNames<Enum, count>& names) {
  for (const Named<Enum>& known : names) {
    if (known.value == value) return known.name;
  }
  throw BrokenInvariant(fmt::format("a value has no name: {}", static_cast<int>(value)));
}

/// Nothing for an unknown name.
template <typename Enum, std::size_t count>
constexpr std::optional<Enum> value_of(std::string_view name, const EnumNames<Enum, count>& names) {
  for (const Named<Enum>& known : names) {
    if (known.name == name) return known.value;
  }
  return std::nullopt;
}

}  // namespace gnbv
