// Words for the user, on stderr. What cannot be printed there is lost, and nothing else.
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "sim/core/error.hpp"

namespace gnbv {

/// What was asked for did not come about (exit code 1): a mission that ended in a collision. Is
/// said as the last word.
class CommandFailed : public SaidError {
 public:
  using SaidError::SaidError;
};

/// As it is, flushed.
void print_to_stderr(std::string_view text);

/// The line "gnbv: SENTENCE", folded where stderr is a terminal. Control bytes, as a damaged file
/// may hold them, are shown as \x1b.
void say(std::string_view sentence);

template <typename... Values>
void say(fmt::format_string<Values...> words, Values&&... values) requires(sizeof...(Values) > 0) {
  say(std::string_view(fmt::format(words, std::forward<Values>(values)...)));
}

}  // namespace gnbv
