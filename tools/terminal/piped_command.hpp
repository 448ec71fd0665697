// Another program at the other end of this one's standard streams.
#pragma once

#include <memory>
#include <string>

#include "sim/core/child_process.hpp"

namespace gnbv {

/// Starts a command of the shell. What it prints is this program's stdin, what this one prints is
/// its stdin, until the end of this object: then stdout is what it was before, and the command has
/// ended.
class PipedCommand {
 public:
  explicit PipedCommand(std::string command);
  ~PipedCommand();
  PipedCommand(const PipedCommand&) = delete;
  PipedCommand& operator=(const PipedCommand&) = delete;

  /// How it failed, in a sentence, where it has ended by itself and not well; else "".
  std::string fault();

 private:
  std::string command_;
  int stdout_before_ = -1;
  std::unique_ptr<ChildProcess> child_;
};

}  // namespace gnbv
