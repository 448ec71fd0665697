// A sweep as a job array of Slurm.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace gnbv {

struct SlurmOptions {
  std::filesystem::path program{};  // gnbv
  std::filesystem::path sweep_file{};
  std::filesystem::path folder{};  // of the sweep
  std::size_t cells = 0;
  int threads = 1;  // of a mission: cpus-per-task
  int limit = 0;    // tasks at a time; 0 = as many as the cluster gives
  bool retry_failed = false;
  std::string arguments{};  // further options of sbatch, as its command line takes them
};

/// Slurm's default for the length of an array, where the cluster's own is not known.
constexpr std::size_t kMaxArraySize = 1001;

/// MaxArraySize of the cluster, as `scontrol show config` says; nothing without an answer.
std::optional<std::size_t> max_array_size();

/// The batch script: tasks 0..M-1, each flying one cell or, where there are more cells than an
/// array may have tasks, a run of them. Throws BadInput for arguments of more than one line.
std::string batch_script(const SlurmOptions& options, std::size_t max_array_size);

/// Submits the script; the id of the job. What sbatch warns of goes to stderr; throws BadInput with
/// what it says against the script.
std::string submit(const std::filesystem::path& script);

}  // namespace gnbv
