// A child process at the other end of two pipes.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gnbv {

/// What runs Python: GNBV_PYTHON, or python3.
std::string python_program();

/// Its stdin and stdout are ours, its stderr is shared. A child that reads ends when this does: its
/// stdin closes.
/// Nothing throws: after the child has ended, what is written is lost and what is read is zeros.
class ChildPipe {
 public:
  explicit ChildPipe(const std::vector<std::string>& command);
  ~ChildPipe();
  ChildPipe(const ChildPipe&) = delete;
  ChildPipe& operator=(const ChildPipe&) = delete;

  void write(std::string_view bytes);
  void write_number(std::int64_t number);
  void read(char* bytes, std::size_t count);
  std::int64_t read_number();
  /// Without its line feed.
  std::string read_line();
  bool is_open() const { return is_open_; }
  /// Waits for the end of the child: "exit code 1", "signal 9".
  std::string end();

 private:
  void close_pipes();

  pid_t pid_ = -1;
  int to_child_ = -1;
  int from_child_ = -1;
  bool is_open_ = false;
};

}  // namespace gnbv
