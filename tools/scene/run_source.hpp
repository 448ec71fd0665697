// All that pictures of one run are made of, read or flown again when it is first asked for.
#pragma once

#include <functional>
#include <future>
#include <optional>

#include "bench/score/surface_reference.hpp"
#include "tools/mission/replay.hpp"
#include "tools/run/run_record.hpp"
#include "tools/run/tour_files.hpp"

namespace gnbv {

/// Told while a mission is flown again.
using SourceProgress = std::function<void(double share_done, const std::string& note)>;

class RunSource {
 public:
  /// Reads the run's record. Throws BadInput as read_run().
  RunSource(const std::filesystem::path& folder, int threads, SourceProgress on_progress);
  /// A record from elsewhere, with its structure.
  RunSource(RunRecord record, World world);
  RunSource(const RunSource&) = delete;  // a flight ahead holds on to it
  RunSource& operator=(const RunSource&) = delete;

  const RunRecord& record() const { return record_; }
  int threads() const { return threads_; }

  /// The structure and the ground that the scenario names. Throw BadInput when they cannot be had.
  const World& world();
  const RayScene& scene();
  /// Throws BadInput as read_run_cloud().
  const RunCloud& cloud();
  /// Of a tour. Throws BadInput as read_plans().
  const std::vector<MadePlan>& plans();
  /// What coverage is measured against.
  const SurfaceReference& reference();

  /// The profile after 1, 3 and all waypoints (Fig. 4: all are 8), each once. Throws BadInput for a
  /// run that flew none.
  const std::vector<ProfileStage>& profile();
  /// What was believed after a view. Throws BadInput as replay().
  const Belief& belief_after(std::size_t iteration);
  /// The decision that chose a view, perhaps before the view before: its candidates are those of
  /// candidates.jsonl where the run has one, or else planned again. Throws BadInput as replay().
  const ReplayedDecision& decision(std::size_t iteration);

  /// Lets go of what is large and can be had again: everything but record, structure and what was
  /// expected and not asked for yet.
  void forget();

  /// What will be asked for, so that it comes from one flight; of any view its decision.
  void expect(const ReplayRequest& request);
  /// Begins that flight now, beside whatever else is drawn; who asks for its results waits for it.
  void fly_ahead();

 private:
  RecordedMission mission();
  ReplayRequest lacking() const;
  void keep(const ReplayRequest& request, Replayed again);
  void land();                           // waits for the flight ahead
  void fly_again(bool is_for_decision);  // for all that is expected and not there

  RunRecord record_;
  int threads_ = 1;
  SourceProgress on_progress_ = [](double, const std::string&) {};
  std::optional<World> world_;
  std::optional<RayScene> scene_;
  std::optional<RunCloud> cloud_;
  std::optional<std::vector<MadePlan>> plans_;
  std::optional<SurfaceReference> reference_;
  ReplayRequest expected_ = {.waypoints = {1, 3}};
  ReplayRequest known_ =
      {};  // what `again_` holds: of beliefs and decisions the one last asked for
  Replayed again_ = {};
  ReplayRequest asked_ahead_;
  std::future<Replayed> ahead_;  // last: ends before what it reads
};

}  // namespace gnbv
