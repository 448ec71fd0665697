#include "tools/sweep/slurm.hpp"

#include <fmt/format.h>

#include <charconv>
#include <utility>

#include "sim/core/child_process.hpp"
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

}  // namespace

std::optional<std::size_t> max_array_size() {
  ChildProcess scontrol({"scontrol", "show", "config"},
                        {.out = ChildStream::pipe, .err = ChildStream::nothing});
  const std::string config = scontrol.read_all();
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
  for (const auto& [option, text] : {std::pair("--slurm-args", options.arguments),
                                     std::pair("--out", full_path(options.folder))}) {
    if (text.find('\n') == std::string::npos) continue;
    throw BadInput("{}: has more than one line, and sbatch reads one", option);
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
      "{}first=$(( SLURM_ARRAY_TASK_ID * {} ))\n"
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
  fs::remove(said);
  ChildProcess sbatch({"sbatch", "--parsable", full_path(script)},
                      {.out = ChildStream::pipe, .err = ChildStream::log, .log = said});
  std::string id = sbatch.read_all();
  id.erase(id.find_last_not_of('\n') + 1);
  const ChildEnd end = sbatch.end();
  const std::string words = fs::exists(said) ? read_file(said) : "";
  fs::remove(said);
  if (end.start_error != 0) {
    throw BadInput("sbatch: not found on this machine; {} is written", script.string());
  }
  if (!end.is_success()) {
    throw BadInput("sbatch {}: {}", script.string(),
                   words.substr(0, words.find_last_not_of('\n') + 1));
  }
  print_to_stderr(printable(words));
  return id;
}

}  // namespace gnbv
