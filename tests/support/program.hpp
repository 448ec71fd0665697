// The gnbv program, run as its users run it. The test needs GNBV_PROGRAM, the path of it.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace gnbv {

struct Outcome {
  int exit_code = -1;
  std::string output;  // stdout, and of gnbv() stderr, too
};

/// A shell command: how it ends, and its stdout.
inline Outcome shell(const std::string& command) {
  Outcome outcome;
  FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) {
    outcome.output += buffer.data();
  }
  const int status = pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

inline Outcome gnbv(const std::string& arguments) {
  return shell(std::string(GNBV_PROGRAM) + " " + arguments + " 2>&1");
}

}  // namespace gnbv
