// Ctrl-C as a question that a loop can ask.
#pragma once

namespace gnbv {

/// While it lives, the first Ctrl-C (or SIGTERM) asks the work at hand to stop and the second one
/// kills.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  static bool requested();
};

}  // namespace gnbv
