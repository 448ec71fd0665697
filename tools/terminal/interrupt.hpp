// Ctrl-C as a question that a loop can ask.
#pragma once

namespace gnbv {

/// While it lives, Ctrl-C (or SIGTERM, or the SIGHUP of a terminal that goes) asks the work at hand
/// to stop, `asks` times; the next one is for who heard it before, and so kills a program of ours.
/// Signals that were ignored before stay so.
///
/// Many may live at once, in threads, too: the first says how often is asked, what is asked is
/// asked of all, and the last gives the signals back. A forked child hears them as before.
class InterruptGuard {
 public:
  /// `asks` in a process of somebody else's, Python: once, and the second one is its own as well,
  /// so that it ends what runs in it.
  static constexpr int kGuest = 0;

  explicit InterruptGuard(int asks = 1);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  static bool requested() { return requests() > 0; }
  /// How often it was asked for, up to `asks`.
  static int requests();
};

}  // namespace gnbv
