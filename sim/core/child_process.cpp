#include "sim/core/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>

namespace gnbv {
namespace {

using std::chrono::milliseconds;

void close_once(int& descriptor) {
  if (descriptor >= 0) ::close(descriptor);
  descriptor = -1;
}

/// All that the child needs after fork(), when it may no longer ask for memory.
struct Start {
  std::vector<char*> words;
  const char* program;
  const char* log;
  const ChildOptions& options;
  std::array<int, 3> pipes = {-1, -1, -1};  // its ends, by the stream's number
  int failed = -1;                          // where it tells why it could not start
};

void be_apart() {
  setpgid(0, 0);
  std::signal(SIGINT, SIG_DFL);  // ignored in what a script has behind '&'
  sigset_t blocked;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  sigprocmask(SIG_SETMASK, &blocked, nullptr);
}

/// Whether stream 0, 1 or 2 is what the options say.
bool set_stream(const Start& start, int stream, ChildStream kind) {
  if (kind == ChildStream::shared) return true;
  int from = start.pipes[static_cast<std::size_t>(stream)];
  if (kind == ChildStream::nothing) from = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (kind == ChildStream::log) {
    from = open(start.log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  }
  return from >= 0 && dup2(from, stream) >= 0;
}

[[noreturn]] void become(const Start& start, pid_t parent) {
  const ChildOptions& options = start.options;
  if (options.dies_with_us) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);  // it died before that
  }
  if (options.niceness != 0) setpriority(PRIO_PROCESS, 0, options.niceness);
  if (options.is_apart) be_apart();
  if (options.kept_open >= 0) fcntl(options.kept_open, F_SETFD, 0);
  if (set_stream(start, 0, options.in) && set_stream(start, 1, options.out) &&
      set_stream(start, 2, options.err)) {
    (options.program.empty() ? execvp : execv)(start.program, start.words.data());
  }
  const int why = errno;
  (void)!::write(start.failed, &why, sizeof why);
  _exit(127);
}

/// Where a launcher ignores SIGCHLD, nobody learns how a child ended.
void hear_of_children() {
  struct sigaction now {};
  sigaction(SIGCHLD, nullptr, &now);
  if (now.sa_handler == SIG_IGN) std::signal(SIGCHLD, SIG_DFL);
}

ChildEnd end_of(int status) {
  if (WIFSIGNALED(status)) return {.signal = WTERMSIG(status)};
  return {.exit_code = WEXITSTATUS(status)};
}

}  // namespace

std::string python_program() {
  const char* const asked = std::getenv("GNBV_PYTHON");
  return asked != nullptr && *asked != '\0' ? asked : "python3";
}

std::string ChildEnd::text() const {
  if (start_error != 0) return fmt::format("cannot be started: {}", std::strerror(start_error));
  if (signal != 0) return fmt::format("killed by signal {} ({})", signal, strsignal(signal));
  return fmt::format("exit code {}", exit_code);
}

ChildProcess::ChildProcess(const std::vector<std::string>& command, const ChildOptions& options) {
  hear_of_children();
  const std::string program = options.program.empty() ? command[0] : options.program.string();
  Start start{
      .words = {}, .program = program.c_str(), .log = options.log.c_str(), .options = options};
  for (const std::string& word : command) start.words.push_back(const_cast<char*>(word.c_str()));
  start.words.push_back(nullptr);
  std::array<int, 2> in = {-1, -1}, out = {-1, -1}, failed = {-1, -1};
  const bool hears = options.in == ChildStream::pipe;
  const bool speaks = options.out == ChildStream::pipe || options.err == ChildStream::pipe;
  const bool has_pipes =
      pipe2(failed.data(), O_CLOEXEC) == 0 &&
      (!hears || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, in.data()) == 0) &&
      (!speaks || pipe2(out.data(), O_CLOEXEC) == 0);
  to_child_ = in[0];
  from_child_ = out[0];
  start.pipes = {in[1], out[1], out[1]};
  start.failed = failed[1];
  const pid_t us = getpid();
  pid_ = has_pipes ? fork() : -1;
  if (pid_ == 0) become(start, us);
  int why = pid_ < 0 ? errno : 0;
  for (int* const end : {&in[1], &out[1], &failed[1]}) close_once(*end);
  // the pipe closes by itself when the program begins
  while (pid_ > 0 && ::read(failed[0], &why, sizeof why) < 0 && errno == EINTR) {
  }
  close_once(failed[0]);
  is_open_ = why == 0;
  if (is_open_) return;
  close_pipes();
  if (pid_ > 0) waitpid(pid_, nullptr, 0);
  end_ = ChildEnd{.start_error = why};
}

ChildProcess::~ChildProcess() {
  close_pipes();
  if (ended_within(milliseconds(1000))) return;
  send(SIGKILL);
  end();
}

void ChildProcess::write(std::string_view bytes) {
  while (is_open_ && !bytes.empty()) {
    const ssize_t written = ::send(to_child_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (written < 0 && errno == EINTR) continue;
    is_open_ = written > 0;
    if (is_open_) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void ChildProcess::read(char* bytes, std::size_t count) {
  std::memset(bytes, 0, count);
  while (is_open_ && count > 0) {
    const ssize_t got = ::read(from_child_, bytes, count);
    if (got < 0 && errno == EINTR) continue;
    is_open_ = got > 0;
    if (!is_open_) return;
    bytes += got;
    count -= static_cast<std::size_t>(got);
  }
}

bool ChildProcess::speaks_within(milliseconds patience) const {
  pollfd from{.fd = from_child_, .events = POLLIN, .revents = 0};
  return !is_open_ || ::poll(&from, 1, static_cast<int>(patience.count())) > 0;
}

std::string ChildProcess::read_line() {
  std::string line;
  char c = '\0';
  for (read(&c, 1); is_open_ && c != '\n'; read(&c, 1)) line += c;
  return line;
}

std::string ChildProcess::read_all() {
  std::string text;
  std::array<char, 4096> block{};
  while (is_open_) {
    const ssize_t got = ::read(from_child_, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    is_open_ = got > 0;
    if (is_open_) text.append(block.data(), static_cast<std::size_t>(got));
  }
  return text;
}

void ChildProcess::send(int signal) const {
  if (!end_) kill(pid_, signal);
}

std::optional<ChildEnd> ChildProcess::ended() {
  int status = 0;
  if (!end_ && waitpid(pid_, &status, WNOHANG) == pid_) end_ = end_of(status);
  return end_;
}

std::optional<ChildEnd> ChildProcess::ended_within(milliseconds patience) {
  const auto until = std::chrono::steady_clock::now() + patience;
  while (!ended() && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(milliseconds(2));
  }
  return end_;
}

ChildEnd ChildProcess::end() {
  close_pipes();
  int status = 0;
  while (!end_) {
    if (waitpid(pid_, &status, 0) == pid_)
      end_ = end_of(status);
    else if (errno != EINTR)
      end_ = ChildEnd{.exit_code = -1};  // somebody else waited for it
  }
  return *end_;
}

void ChildProcess::close_pipes() {
  is_open_ = false;
  close_once(to_child_);
  close_once(from_child_);
}

}  // namespace gnbv
