#include "tools/live/live_child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr int kLeastPriority = 19;

/// In the child: becomes the server, with its standard output in `out`. Never returns.
[[noreturn]] void become_server(const std::string& run, const std::string& port, int out,
                                pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it died before that
  setpriority(PRIO_PROCESS, 0, kLeastPriority);
  setpgid(0, 0);  // Ctrl-C is for the mission
  dup2(out, STDOUT_FILENO);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDERR_FILENO);
  const std::array<const char*, 9> words = {
      "gnbv", "report", run.c_str(), "--live", port.c_str(), "--threads", "1", "--quiet", nullptr};
  execv("/proc/self/exe", const_cast<char* const*>(words.data()));
  _exit(127);
}

}  // namespace

LiveChild::LiveChild(const std::filesystem::path& run, int port) {
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), fmt::format("--live {}", port));
  }
  const std::string folder = run.string();
  const std::string number = std::to_string(port);
  const pid_t parent = getpid();
  child_ = fork();
  if (child_ == 0) become_server(folder, number, pipe_ends[1], parent);
  const int why = errno;
  close(pipe_ends[1]);
  if (child_ < 0) {
    close(pipe_ends[0]);
    throw std::system_error(why, std::generic_category(), fmt::format("--live {}", port));
  }
  char letter = 0;
  while (read(pipe_ends[0], &letter, 1) == 1 && letter != '\n') url_ += letter;
  close(pipe_ends[0]);
  if (url_.empty()) {
    waitpid(child_, nullptr, 0);
    throw BadInput(fmt::format(
        "--live {}: this port of 127.0.0.1 cannot be had: it is taken, or yours begin at 1024; 0 "
        "takes a free one",
        port));
  }
}

LiveChild::~LiveChild() {
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
}

}  // namespace gnbv
