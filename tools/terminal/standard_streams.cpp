#include "tools/terminal/standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

/// The lowest free descriptor is the one that is closed.
void open_if_closed(int descriptor, int flags) {
  if (fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) return;
  static_cast<void>(open("/dev/null", flags));
}

}  // namespace

void prepare_standard_streams() {
  open_if_closed(STDIN_FILENO, O_WRONLY);
  open_if_closed(STDOUT_FILENO, O_RDONLY);
  open_if_closed(STDERR_FILENO, O_WRONLY);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool flush_stdout() {
  errno = 0;
  const bool had_failed = std::ferror(stdout) != 0;
  if (had_failed) {  // what failed then fails again, and names its cause
    std::clearerr(stdout);
    std::fputc('\n', stdout);
  }
  const bool is_flushed = std::fflush(stdout) == 0;
  if (is_flushed && !had_failed) return true;
  if (errno == EPIPE) {
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  say("stdout: cannot write: {}", errno == 0 ? "lost in part" : std::strerror(errno));
  return false;
}

}  // namespace gnbv
