#pragma once

#include <stdexcept>

namespace gnbv {

/// What was asked for did not come about (exit code 1): a mission that ended in a collision.
class CommandFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gnbv
