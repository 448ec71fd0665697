// Standard input, line by line, that a Ctrl-C can interrupt.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace gnbv {

class StdinLines {
 public:
  /// The next line without its end, waiting for it; nothing at the end of the input, or as soon as
  /// `should_stop` says so. A last line without its end counts.
  std::optional<std::string> next(const std::function<bool()>& should_stop);

 private:
  bool read_more(const std::function<bool()>& should_stop);

  std::string unread_;
};

}  // namespace gnbv
