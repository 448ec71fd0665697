// Ctrl-C as a question that a loop can ask.
#pragma once

#include <array>

namespace gnbv {

/// While it lives, Ctrl-C (or SIGTERM, or the SIGHUP of a terminal that goes) asks the work at hand
/// to stop, `asks` times; the next one kills. Signals that were ignored before stay so.
class InterruptGuard {
 public:
  explicit InterruptGuard(int asks = 1);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  static bool requested() { return requests() > 0; }
  /// How often it was asked for, up to `asks`.
  static int requests();

 private:
  std::array<void (*)(int), 3> before_{};
};

}  // namespace gnbv
