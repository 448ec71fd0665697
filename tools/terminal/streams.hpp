// stdin, stdout and stderr: as the program finds them and leaves them, how wide they are, and lines
// of the first.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace gnbv {

/// Call first. Gives those of descriptors 0 to 2 that are closed to nothing, so that no file gets
/// their number and is printed into: reading from such a stdin and printing to such a stdout fail,
/// stderr is lost. A pipe that nobody reads and a file that reaches its limit become errors.
void prepare_standard_streams();

/// Call last: whether all that was printed to stdout has got there. Says so when it has not. Who
/// stopped reading a pipe is left in peace: the signal ends the process, as usual.
bool flush_stdout();

/// Columns of the terminal that stdout is, or what the environment's COLUMNS asks for; 0 where
/// neither says so: files and pipes take lines of any length.
std::size_t stdout_columns();

/// Columns of the terminal that stderr is, 80 where it does not say so; 0 where it is none.
std::size_t stderr_columns();

/// Standard input, line by line, that a Ctrl-C can interrupt.
class StdinLines {
 public:
  /// The next line without its end, waiting for it; nothing at the end of the input, or as soon as
  /// `should_stop` says so. A last line without its end counts.
  std::optional<std::string> next(const std::function<bool()>& should_stop);

 private:
  bool read_more(const std::function<bool()>& should_stop);

  std::string unread_;
};

}  // namespace gnbv
