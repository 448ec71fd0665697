#include "tools/terminal/streams.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "sim/core/text.hpp"
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

std::size_t stdout_columns() {
  if (const char* const asked = std::getenv("COLUMNS")) {
    if (const auto columns = number_in<std::size_t>(asked)) return *columns;
  }
  winsize size{};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

std::size_t stderr_columns() {
  if (isatty(STDERR_FILENO) == 0) return 0;
  winsize size{};
  const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? size.ws_col : 80;
}

std::optional<std::string> StdinLines::next(const std::function<bool()>& should_stop) {
  std::size_t end = unread_.find('\n');
  while (end == std::string::npos && read_more(should_stop)) end = unread_.find('\n');
  if (should_stop() || (end == std::string::npos && unread_.empty())) return std::nullopt;
  std::string line = unread_.substr(0, end);
  unread_.erase(0, end == std::string::npos ? end : end + 1);
  return line;
}

/// Whether there was more.
bool StdinLines::read_more(const std::function<bool()>& should_stop) {
  constexpr int kAsk_ms = 200;  // a signal ends poll() at once, unless it came just before
  while (!should_stop()) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, kAsk_ms) <= 0) continue;
    std::array<char, 4096> block{};
    const ssize_t count = read(STDIN_FILENO, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    unread_.append(block.data(), static_cast<std::size_t>(count));
    return true;
  }
  return false;
}

}  // namespace gnbv
