// candidates.jsonl: why each view was chosen, and every other one was not.
#pragma once

#include <filesystem>
#include <optional>

#include "planner/core/plan.hpp"
#include "tools/run/decision_lines.hpp"

namespace gnbv {

/// One JSON object a line and candidate, in the order they were sampled: `iteration` of the first
/// view that the decision chose, pose (m, rad; the gimbal's pitch unless it is 0), sampler, scale
/// or cluster, path_m, in a burst `covers`, then either `rejected` with its reason or `utility`
/// with its terms, which a burst has of its views alone; `chosen` marks the views, in the order in
/// which they are flown. Appended to candidates.jsonl.part, which finish() renames.
class CandidatesFile : public DecisionLines {
 public:
  /// `first_iteration`: decisions from here on will be written; what an interrupted run wrote of
  /// earlier ones is kept. Throws BadInput naming the file.
  CandidatesFile(const std::filesystem::path& folder, std::size_t first_iteration);

  void write(std::size_t iteration, const Plan& plan);
};

/// The candidates of the decision whose first view is `iteration`, in the order they were sampled,
/// and which of them were chosen; `views` stay empty, and so do the points on their ways. Nothing
/// for a run that wrote no candidates, or had none to write. Throws BadInput naming file and line
/// of whatever is damaged, or a decision that the file does not hold, and the command that writes
/// it.
std::optional<Plan> read_candidates(const std::filesystem::path& run, std::size_t iteration);

/// The same of the first `iterations` iterations at once, in their order; those that are the
/// first view of no decision have no candidates. Empty for a run that wrote none. Throws BadInput
/// naming file and line of whatever is damaged.
std::vector<Plan> read_all_candidates(const std::filesystem::path& run, std::size_t iterations);

}  // namespace gnbv
