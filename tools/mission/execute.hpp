// One mission from the command line to its run directory.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "bench/score/mission_score.hpp"
#include "scenarios/scenario.hpp"
#include "tools/mission/reference.hpp"
#include "tools/mission/user_planner.hpp"
#include "tools/run/mission_result.hpp"
#include "tools/terminal/interrupt.hpp"

namespace gnbv {

/// What the command line may say about a mission beside its scenario.
struct MissionOptions {
  std::filesystem::path out;  // "" chooses a free folder under runs/
  int threads = 0;            // 0 = as many as the machine has
  bool resume = false;
  bool quiet = false;
  bool candidates = false;   // also write candidates.jsonl and beliefs.jsonl
  bool frames = false;       // also write frames/
  bool piped_views = false;  // views come on stdin, answers go to stdout: view_pipe.hpp
  bool coverage = false;     // which then tell the coverage
  std::function<std::string()> views_fault = {};  // why no more come, where that is a failure
  CeilingFrom ceiling = CeilingFrom::cache;
  const UserPlanner* planner = nullptr;  // asked for the views; the utility is `route`
  bool rounds_views = false;             // of a planner of the user's own: UserPlannerLink
  MissionObserver* observer = nullptr;   // told last
  std::function<void(double share_done, const std::string& note)> on_progress = {};  // may be empty
  std::function<bool()> should_stop = [] { return false; };  // asked as Ctrl-C is
};

/// `threads`, or as many as the machine has for 0.
int thread_count(int threads);

/// Throws BadInput when what a finished run flew around, or its rows, are not what its summary is
/// of any more.
void need_unchanged(const std::filesystem::path& run, const Scenario& scenario);

struct ExecutedMission {
  std::filesystem::path folder;
  MissionResult result;
  MissionScore score;
  double total_wall_s = 0.0;
  std::unique_ptr<const InterruptGuard> interrupt;  // it is all there: Ctrl-C loses no word of it
};

/// Checks everything that can be wrong with the input, flies the mission, scores it and writes the
/// run directory. Ctrl-C ends it after the view at hand, with a complete directory.
ExecutedMission execute_mission(const Scenario& scenario, const MissionOptions& options);

}  // namespace gnbv
