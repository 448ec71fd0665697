#include "tools/terminal/piped_command.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <system_error>

namespace gnbv {
namespace {

using std::chrono::milliseconds;

void need(bool is_done) {
  if (!is_done) throw std::system_error(errno, std::generic_category(), "a pipe");
}

/// The descriptor becomes the standard stream of that number.
void make_standard(int descriptor, int stream) {
  need(dup2(descriptor, stream) >= 0);
  ::close(descriptor);
}

}  // namespace

PipedCommand::PipedCommand(std::string command) : command_(std::move(command)) {
  std::array<int, 2> to_it{}, from_it{};
  need(pipe2(to_it.data(), O_CLOEXEC) == 0 && pipe2(from_it.data(), O_CLOEXEC) == 0);
  std::fflush(stdout);
  stdout_before_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  need(stdout_before_ >= 0);
  // it inherits our standard streams, so that these are its ends first and ours then
  make_standard(to_it[0], STDIN_FILENO);
  make_standard(from_it[1], STDOUT_FILENO);
  child_ = std::make_unique<ChildProcess>(std::vector<std::string>{"sh", "-c", "exec " + command_},
                                          ChildOptions{.in = ChildStream::shared});
  make_standard(from_it[0], STDIN_FILENO);
  make_standard(to_it[1], STDOUT_FILENO);
}

PipedCommand::~PipedCommand() {
  std::fflush(stdout);
  std::clearerr(stdout);  // it may not have listened any more
  dup2(stdout_before_, STDOUT_FILENO);
  ::close(stdout_before_);
  child_->ended_within(milliseconds(5000));  // it has read the end of its input
}

std::string PipedCommand::fault() {
  const auto end = child_->ended_within(milliseconds(1000));
  if (!end || end->is_success()) return "";
  return fmt::format("the planner `{}` ended before the mission: {}", command_, end->text());
}

}  // namespace gnbv
