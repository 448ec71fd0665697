// Three kinds of wrong: bad input throws BadInput (exit code 2), a broken invariant throws
// BrokenInvariant (exit code 1, with the command that replays the run), and "nothing found" is an
// std::optional, never an exception.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace gnbv {

/// The user gave something unusable. The message names file, line, key and value.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The program is wrong, or a number became NaN. Never caught to go on, only to report.
class BrokenInvariant : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gnbv

/// Stops the run when `condition` is false; on in release builds too. The rest is a fmt message.
#define GNBV_CHECK(condition, ...)                                                                \
  do {                                                                                            \
    if (!(condition)) {                                                                           \
      throw ::gnbv::BrokenInvariant(fmt::format("{}:{}: `{}` does not hold: {}", __FILE__,        \
                                                __LINE__, #condition, fmt::format(__VA_ARGS__))); \
    }                                                                                             \
  } while (false)
