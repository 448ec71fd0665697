// Other programs as child processes: the one place that starts, feeds and ends them.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnbv {

/// What runs Python: GNBV_PYTHON, or python3.
std::string python_program();

/// How a child ended.
struct ChildEnd {
  int start_error = 0;  // errno's number where it never ran
  int signal = 0;       // that killed it
  int exit_code = 0;

  bool is_success() const { return start_error == 0 && signal == 0 && exit_code == 0; }
  /// "exit code 1", "killed by signal 9 (Killed)", "cannot be started: No such file or directory".
  std::string text() const;
};

/// What a standard stream of the child is: ours, /dev/null, a pipe to us, or appended to `log`.
enum class ChildStream { shared, nothing, pipe, log };

struct ChildOptions {
  ChildStream in = ChildStream::nothing;
  ChildStream out = ChildStream::shared;
  ChildStream err = ChildStream::shared;
  std::filesystem::path log = {};
  std::filesystem::path program = {};  // that is started; empty: the first word, by the PATH
  /// Killed by the kernel however the thread that started it ends, also where a subreaper adopts
  /// orphans. False: it goes on without us.
  bool dies_with_us = true;
  /// It does not hear the terminal's Ctrl-C, nor SIGTERM, which a scheduler sends to all processes
  /// of a job.
  bool is_apart = false;
  int kept_open = -1;  // a descriptor that it keeps
  int niceness = 0;    // 19: the lowest priority
};

/// Nothing throws: of a child that has ended, what is written is lost and what is read is zeros.
class ChildProcess {
 public:
  /// Starts the command, whose first word is the program's name. ended() says whether that failed.
  explicit ChildProcess(const std::vector<std::string>& command, const ChildOptions& options = {});
  /// Closes the pipes, waits a second for the end, and kills.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// errno's number when it could not be started.
  int start_error() const { return end_ ? end_->start_error : 0; }

  void write(std::string_view bytes);
  void read(char* bytes, std::size_t count);
  /// Whether something can be read by then, if only that nothing more will come.
  bool speaks_within(std::chrono::milliseconds patience) const;
  std::string read_line();  // without its line feed
  std::string read_all();   // up to the end of its output
  /// Whether all that was written and read so far has come across.
  bool is_open() const { return is_open_; }

  void send(int signal) const;
  /// How it ended; nothing while it runs.
  std::optional<ChildEnd> ended();
  /// The same, waiting for the end so long at most.
  std::optional<ChildEnd> ended_within(std::chrono::milliseconds patience);
  /// Closes the pipes and waits for the end: a child that reads sees that nothing more will come.
  ChildEnd end();

 private:
  void close_pipes();

  pid_t pid_ = -1;
  int to_child_ = -1;  // a socket: writing to a child that has ended raises no signal
  int from_child_ = -1;
  bool is_open_ = false;
  std::optional<ChildEnd> end_;
};

}  // namespace gnbv
