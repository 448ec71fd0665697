#include "tools/mission/child_pipe.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

extern char** environ;

namespace gnbv {

std::string python_program() {
  const char* const asked = std::getenv("GNBV_PYTHON");
  return asked != nullptr && *asked != '\0' ? asked : "python3";
}

// a socket pair, so that writing to a child that has ended raises no signal
ChildPipe::ChildPipe(const std::vector<std::string>& command) {
  std::array<int, 2> in{}, out{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, in.data()) != 0) return;
  to_child_ = in[0];
  if (::pipe2(out.data(), O_CLOEXEC) != 0) {
    ::close(in[1]);
    return;
  }
  from_child_ = out[0];
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, in[1], 0);
  ::posix_spawn_file_actions_adddup2(&actions, out[1], 1);
  is_open_ = ::posix_spawnp(&pid_, arguments[0], &actions, nullptr, arguments.data(), environ) == 0;
  if (!is_open_) pid_ = -1;
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(in[1]);
  ::close(out[1]);
}

ChildPipe::~ChildPipe() { end(); }

void ChildPipe::write(std::string_view bytes) {
  while (is_open_ && !bytes.empty()) {
    const ssize_t written = ::send(to_child_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (written < 0 && errno == EINTR) continue;
    is_open_ = written > 0;
    if (is_open_) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void ChildPipe::write_number(std::int64_t number) {
  write({reinterpret_cast<const char*>(&number), sizeof number});
}

void ChildPipe::read(char* bytes, std::size_t count) {
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

std::int64_t ChildPipe::read_number() {
  std::int64_t number = 0;
  read(reinterpret_cast<char*>(&number), sizeof number);
  return number;
}

std::string ChildPipe::read_line() {
  std::string line;
  char c = '\0';
  for (read(&c, 1); is_open_ && c != '\n'; read(&c, 1)) line += c;
  return line;
}

void ChildPipe::close_pipes() {
  is_open_ = false;
  for (int* const pipe : {&to_child_, &from_child_}) {
    if (*pipe >= 0) ::close(*pipe);
    *pipe = -1;
  }
}

std::string ChildPipe::end() {
  close_pipes();
  if (pid_ < 0) return "cannot be started";
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                             : fmt::format("exit code {}", WEXITSTATUS(status));
}

}  // namespace gnbv
