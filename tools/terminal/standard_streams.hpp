// stdin, stdout and stderr, as a program finds them and leaves them.
#pragma once

namespace gnbv {

/// Call first. Gives those of descriptors 0 to 2 that are closed to nothing, so that no file gets
/// their number and is printed into: reading from such a stdin and printing to such a stdout fail,
/// stderr is lost. A pipe that nobody reads and a file that reaches its limit become errors.
void prepare_standard_streams();

/// Call last: whether all that was printed to stdout has got there. Says so when it has not. Who
/// stopped reading a pipe is left in peace: the signal ends the process, as usual.
bool flush_stdout();

}  // namespace gnbv
