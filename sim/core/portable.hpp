// Mathematics whose digits do not depend on the processor.
#pragma once

#include <stdexcept>

namespace gnbv {

/// The C library computes other digits on this processor than on some others. No BadInput, which
/// many catch to say more: this one is for main().
class UnportableMathematics : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws UnportableMathematics unless sines, exponentials and their like have the digits that they
/// have without fused multiply-adds, as every x86-64 processor computes them.
void need_portable_mathematics();

/// Starts this program again, told not to fuse, with the words it was started with. Returns where
/// it was told so already, or cannot be started.
void restart_with_portable_mathematics(char** argv);

}  // namespace gnbv
