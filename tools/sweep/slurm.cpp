#include "tools/sweep/slurm.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

std::string full_path(const fs::path& path) {
  return fs::absolute(path).lexically_normal().string();
}

/// A path in an #SBATCH line: sbatch reads quotes as a shell does, and a % as a pattern.
std::string in_directive(const fs::path& path) {
  std::string out;
  for (const char c : full_path(path)) {
    if (c == '\\' || c == '"' || c == ' ' || c == '\'') out += '\\';
    out += c == '%' ? "%%" : std::string(1, c);
  }
  return out;
}

struct CommandOutput {
  int exit_code = -1;
  std::string text;
};

CommandOutput output_of(const std::string& command) {
  CommandOutput output;
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) {
    output.text += buffer.data();
  }
  const int status = pclose(pipe);
  if (WIFEXITED(status)) output.exit_code = WEXITSTATUS(status);
  while (!output.text.empty() && output.text.back() == '\n') output.text.pop_back();
  return output;
}

}  // namespace

std::optional<std::size_t> max_array_size() {
  const std::string config = output_of("scontrol show config 2>/dev/null").text;
  constexpr std::string_view kKey = "MaxArraySize";
  const std::size_t at = config.find(kKey);
  const std::size_t digit = config.find_first_of("0123456789\n", at);
  std::size_t size = 0;
  if (at == std::string::npos || digit == std::string::npos) return std::nullopt;
  std::from_chars(config.data() + digit, config.data() + config.size(), size);
  return size > 0 ? std::optional(size) : std::nullopt;
}

std::string batch_script(const SlurmOptions& options, std::size_t max_array_size) {
  GNBV_CHECK(options.cells > 0 && max_array_size > 0, "{} cells in arrays of {}", options.cells,
             max_array_size);
  if (options.arguments.find('\n') != std::string::npos) {
    throw BadInput("--slurm-args: has more than one line");
  }
  const std::size_t chunk = (options.cells + max_array_size - 1) / max_array_size;
  const std::size_t tasks = (options.cells + chunk - 1) / chunk;
  const std::string limit = options.limit > 0 ? fmt::format("%{}", options.limit) : "";
  const std::string extra =
      options.arguments.empty() ? "" : fmt::format("#SBATCH {}\n", options.arguments);
  const std::string last = chunk == 1
                               ? "$first"
                               : fmt::format("$(( first + {} < {} ? first + {} : {} ))", chunk - 1,
                                             options.cells, chunk - 1, options.cells - 1);
  return fmt::format(
      "#!/bin/bash\n"
      "# {} cells of a sweep in {} tasks; a requeued task goes on where it was.\n"
      "#SBATCH --job-name=gnbv-sweep\n"
      "#SBATCH --array=0-{}{}\n"
      "#SBATCH --cpus-per-task={}\n"
      "#SBATCH --requeue\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --output={}/slurm-%a.log\n"
      "{}"
      "first=$(( SLURM_ARRAY_TASK_ID * {} ))\n"
      "last={}\n"
      "echo \"cells $first-$last on $(hostname), job $SLURM_JOB_ID, restart "
      "${{SLURM_RESTART_COUNT:-0}}\"\n"
      "# exec: Slurm's signals reach the program itself\n"
      "exec {} sweep {} --out {} --threads {}{} --index \"$first-$last\"\n",
      options.cells, tasks, tasks - 1, limit, options.threads, in_directive(options.folder), extra,
      chunk, last, shell_word(options.program.string()), shell_word(full_path(options.sweep_file)),
      shell_word(full_path(options.folder)), options.threads,
      options.retry_failed ? " --retry-failed" : "");
}

std::string submit(const fs::path& script) {
  const fs::path said = script.string() + ".stderr";  // warnings are no part of the id
  const CommandOutput sent = output_of(fmt::format(
      "sbatch --parsable {} 2> {}", shell_word(full_path(script)), shell_word(full_path(said))));
  const std::string words = fs::exists(said) ? read_file(said) : "";
  fs::remove(said);
  if (sent.exit_code == 127) {
    throw BadInput(
        fmt::format("sbatch: not found on this machine; {} is written", script.string()));
  }
  if (sent.exit_code != 0) {
    throw BadInput(fmt::format("sbatch {}: {}", script.string(),
                               words.substr(0, words.find_last_not_of('\n') + 1)));
  }
  print_to_stderr(printable(words));
  return sent.text;
}

}  // namespace gnbv
