// Three kinds of wrong: bad input throws BadInput (exit code 2), a broken invariant throws
// BrokenInvariant (exit code 1, with the command that replays the run), and what is not found is an
// empty std::optional.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace gnbv {

/// An error with a message as it is, or of words and values for fmt.
class SaidError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  template <typename... Values>
  explicit SaidError(fmt::format_string<Values...> words,
                     Values&&... values) requires(sizeof...(Values) > 0)
      : std::runtime_error(fmt::format(words, std::forward<Values>(values)...)) {}
};

/// The user's input cannot be used. The message names file, line, key and value.
class BadInput : public SaidError {
 public:
  using SaidError::SaidError;
};

/// The program is wrong, or a number became NaN. Caught only to report it.
class BrokenInvariant : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gnbv

/// Throws BrokenInvariant when `condition` is false, in release builds too. The rest is a message
/// for fmt.
#define GNBV_CHECK(condition, ...)                                                                \
  do {                                                                                            \
    if (!(condition)) {                                                                           \
      throw ::gnbv::BrokenInvariant(fmt::format("{}:{}: `{}` does not hold: {}", __FILE__,        \
                                                __LINE__, #condition, fmt::format(__VA_ARGS__))); \
    }                                                                                             \
  } while (false)
