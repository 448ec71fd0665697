// What a refusal says.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <string_view>

#include "sim/core/error.hpp"

namespace gnbv::test {

/// Of the BadInput that `act` throws; empty when it throws none.
template <typename Act>
std::string fault_of(const Act& act) {
  try {
    act();
  } catch (const BadInput& fault) {
    return fault.what();
  }
  return "";
}

/// Whether a text holds all of these words; a failure shows both.
inline testing::AssertionResult says(std::string_view text,
                                     std::initializer_list<std::string_view> words) {
  for (const std::string_view word : words) {
    if (text.find(word) == std::string_view::npos) {
      return testing::AssertionFailure() << "no '" << word << "' in: " << text;
    }
  }
  return testing::AssertionSuccess();
}

}  // namespace gnbv::test
