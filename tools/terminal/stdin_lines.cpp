#include "tools/terminal/stdin_lines.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace gnbv {

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
