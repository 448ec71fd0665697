// Checks of numbers on the command line; those of CLI11 let NaN pass, and print 300 digits.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace gnbv {

inline CLI::Validator number_check(const std::string& must_be, bool (*is_good)(double)) {
  return {[=](std::string& text) {
            double value = 0.0;
            const bool is_number = CLI::detail::lexical_cast(text, value);
            return is_number && is_good(value) ? "" : fmt::format("'{}' must be {}", text, must_be);
          },
          must_be};
}

inline CLI::Validator is_finite() {
  return number_check("a finite number", [](double x) { return std::isfinite(x); });
}
inline CLI::Validator is_positive() {
  return number_check("a number above 0", [](double x) { return std::isfinite(x) && x > 0.0; });
}
inline CLI::Validator is_elevation_deg() {
  return number_check("from -89 to 90", [](double x) { return x >= -89.0 && x <= 90.0; });
}

}  // namespace gnbv
