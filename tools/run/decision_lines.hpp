// Files with a JSON object a line, each of a decision, that grow while the mission flies.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/core/plan.hpp"
#include "planner/map/grid_geometry.hpp"
#include "tools/run/run_files.hpp"

namespace gnbv {

/// The whole lines of decisions whose first view comes before one.
struct LinesBefore {
  std::string text;
  std::size_t next_iteration = 1;  // of the decision after them, as far as lines of candidates tell
};

/// As an interrupted run left them. Throws as read_decision_lines().
LinesBefore lines_before(std::size_t iteration, const std::filesystem::path& run, const char* name);

using TakeDecision =
    std::function<void(std::size_t iteration, const nlohmann::ordered_json&, std::string_view row)>;

/// Hands over what each line of a run's file holds, of iterations before `end`; those alone that
/// begin with `beginning`. Returns whether there is any line. Throws BadInput naming file, line and
/// the command that writes it anew for whatever is damaged, or `take` refuses.
bool read_decision_lines(const std::filesystem::path& run, const char* name, std::size_t end,
                         std::string_view beginning, const TakeDecision& take);

/// Appends to part_of() a file, which finish() renames.
class DecisionLines {
 public:
  /// Begins with `kept`. Throws as refuse_to_write(), as all of it does.
  DecisionLines(const std::filesystem::path& file, const std::string& kept)
      : path_(file), part_(part_of(file), kept) {}
  void finish() const;

 protected:
  /// `lines` end with a line feed.
  void write_lines(const std::string& lines) { part_.write(lines); }

 private:
  std::filesystem::path path_;
  GrowingFile part_;
};

// ---- candidates_jsonl.cpp: why each view was chosen, and every other one was not

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

// ---- beliefs_jsonl.cpp: the voxels for whose sake each view was chosen, as they were believed
// before it

/// Voxels [first, first + length) of the map.
struct VoxelRun {
  VoxelIndex first = 0;
  std::uint32_t length = 0;

  bool operator==(const VoxelRun&) const = default;
};

/// Runs in ascending order, with gaps between them.
using VoxelRuns = std::vector<VoxelRun>;

/// Of ascending voxels, each once.
VoxelRuns runs_of(std::span<const VoxelIndex> voxels);
std::size_t voxel_count(const VoxelRuns& runs);

/// What a decision knew.
struct BelievedVoxels {
  VoxelRuns unknown = {};    // that the rays of its views cross (VoxelsInSight)
  VoxelRuns predicted = {};  // that they meet first
  VoxelRuns frontier = {};   // of all clusters that might be tried, where any was sampled around
  VoxelRuns looked_at = {};  // of them those of the clusters that its views are of
};

/// One JSON object a line and decision: `iteration` of its first view, and the four lists,
/// those without voxels left out: of each run the gap to the end of the one before (the first one's
/// to voxel 0), then its length. Voxels count along x first, then y, then z, through the lattice of
/// workspace and map.resolution_m. Written as candidates.jsonl is.
class BeliefsFile : public DecisionLines {
 public:
  /// What an interrupted run wrote of decisions before `first_iteration` is kept; an older
  /// program's run wrote none. Throws BadInput naming the file.
  BeliefsFile(const std::filesystem::path& folder, std::size_t first_iteration);

  void write(std::size_t iteration, const BelievedVoxels& voxels);
};

/// Of the first `iterations` iterations in their order; those that nothing is told of have no
/// voxels. Empty for a run that wrote none. Throws BadInput naming file and line of whatever is
/// damaged, as voxels from `voxels` on are.
std::vector<BelievedVoxels> read_beliefs(const std::filesystem::path& run, std::size_t iterations,
                                         std::size_t voxels);

}  // namespace gnbv
