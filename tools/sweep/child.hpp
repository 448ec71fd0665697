// A mission as a process of its own.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gnbv {

/// How a process ended: by a signal, or with an exit code.
struct ChildEnd {
  int signal = 0;  // 0: none
  int exit_code = 0;
};

/// Starts `program` with the words of the command, its name first; its output is appended to `log`
/// and it keeps `lock` open. It does not hear the terminal's Ctrl-C, nor SIGTERM, which a scheduler
/// sends to all processes of a job: who started it passes the first one on, as SIGINT, once. Throws
/// BadInput when it cannot be started.
pid_t start_child(const std::filesystem::path& program, const std::vector<std::string>& command,
                  const std::filesystem::path& log, int lock);

/// How the child ended; nothing while it runs.
std::optional<ChildEnd> end_of(pid_t child);

}  // namespace gnbv
