// A mission as an environment: a thread of its own flies it and stops where it wants a view.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "bench/score/surface_reference.hpp"
#include "tools/mission/mission.hpp"
#include "tools/python/env_observation.hpp"
#include "tools/python/frame_arrays.hpp"

namespace gnbv {

/// Missions as they were after their profiles, so that it is not flown again. Of any thread.
class KeptProfiles {
 public:
  explicit KeptProfiles(std::size_t most) : most_(most) {}
  KeptMoment find(std::uint64_t key) const;
  /// Unless there are as many as may be.
  void keep(std::uint64_t key, const std::function<KeptMoment()>& made);

 private:
  std::size_t most_;
  mutable std::mutex mutex_;
  std::map<std::uint64_t, KeptMoment> kept_;
};

/// What all missions of a scenario share; nothing in it changes what they do.
struct EnvStage {
  /// `goal` is the share of the ceiling at which a mission ends; 0: never. Keeps the profile where
  /// no seed changes it, and else those of `seeds` seeds. Throws BadInput.
  EnvStage(const std::string& scenario_name, const std::vector<std::string>& overrides, double goal,
           std::size_t seeds);

  const Scenario scenario;
  const World world;
  const RayScene scene;
  const SurfaceReference reference;
  const double ceiling;        // share of the surface that can be covered; 1 where no goal asks
  const double goal_coverage;  // share of the surface at which it ends; above 1: never
  const std::vector<double> scales;
  const bool profile_differs;  // from seed to seed
  const std::unique_ptr<KeptProfiles> profiles;
};

/// How many missions may fly at a time; the others wait. What they do does not depend on it.
class Permits {
 public:
  explicit Permits(int count) : left_(count) {}
  void take();
  void give();

 private:
  std::mutex mutex_;
  std::condition_variable given_;
  int left_;
};

/// What an agent is shown beside the coarse map.
struct EnvWishes {
  bool candidates = false;
  bool top = false;  // top_view(), for pictures
  bool frames = false;
  bool colour = false;  // in them
  int crop = 0;         // edge of local_crop() in voxels; 0: none
};

struct EnvState {
  bool ended = false;
  GridGeometry grid;        // of `top`
  std::vector<float> top;   // top_view() of the map, where pictures are wanted
  std::string termination;  // of the mission, when it has ended
  std::string refused;      // why the latest action was no view that can be flown; "" it was flown
  double coverage = 0.0;    // share of the surface, at 0.05 m: the truth
  double entropy_nat = 0.0;
  std::size_t cloud_points = 0;
  double flown_m = 0.0;
  double time_s = 0.0;
  std::size_t views = 0;           // taken
  double first_entropy_nat = 0.0;  // after the first of them
  ViewPose pose;
  EnvObservation seen;
  std::vector<float> crop;
  std::shared_ptr<const KeptView> frames;       // of the latest view
  std::shared_ptr<const MissionResult> result;  // when it has ended
};

/// A mission that waited for a view or was over, to be flown on from there any number of times.
struct EnvMoment {
  std::uint64_t seed = 0;
  KeptMoment mission;             // none when it was over
  std::vector<ViewPose> refused;  // views that were given since
  EnvState state;
};

/// Waits end after this long, so that their callers can look for signals between them.
constexpr double kSlice_s = 0.05;

class EnvMission final : public MissionObserver {
 public:
  EnvMission(std::shared_ptr<const EnvStage> stage, std::shared_ptr<Permits> permits,
             const EnvWishes& wishes);
  ~EnvMission() override;
  EnvMission(const EnvMission&) = delete;
  EnvMission& operator=(const EnvMission&) = delete;

  // The thread is of the process that made the mission: in a forked child there is none, close()
  // has nothing to do, and the others throw std::runtime_error.

  /// Begins anew; wait() says when it wants a view. Requires that close() returned true.
  void begin(std::uint64_t seed);
  /// Begins where a mission of the same stage was.
  void begin(std::shared_ptr<const EnvMoment> from);
  /// As it is now. Requires a mission that waits for a view or is over; throws std::runtime_error
  /// otherwise, and where the vehicle touches something.
  std::shared_ptr<const EnvMoment> keep();
  /// Of a mission that is over, what `gnbv run` tells of one; "" otherwise.
  std::string result_sha256();
  /// Requires a mission that waits for a view; throws std::runtime_error otherwise.
  void act(const ViewPose& view);
  /// Its state when it wants a view or is over; nothing while it flies on, after kSlice_s. Throws
  /// what the mission threw.
  const EnvState* wait();
  const EnvStage& stage() const { return *stage_; }
  /// Tells the mission to end; whether it has, false after kSlice_s.
  bool close();

 private:
  enum class Turn { mission, agent, over };
  void check_process() const;
  void start(std::uint64_t seed);
  void fly(Scenario scenario);
  void on_pause(const MissionPause& pause);
  std::optional<ViewPose> ask();
  void observe(const Belief& belief);
  bool wants_colour() const override { return wishes_.colour; }
  void on_sensed(const SensedView& view) override {
    if (wishes_.frames) state_.frames = std::make_shared<const KeptView>(view);
  }
  void on_view(const ViewRecord& view, const Belief& belief) override;

  std::shared_ptr<const EnvStage> stage_;
  std::shared_ptr<Permits> permits_;
  const EnvWishes wishes_;
  EnvObserver observer_;

  std::mutex mutex_;
  std::condition_variable turned_;
  Turn turn_ = Turn::over;
  std::atomic<bool> is_closing_ = false;
  std::optional<ViewPose> action_;
  std::uint64_t seed_ = 0;
  std::shared_ptr<const EnvMoment> from_;
  std::size_t repeated_ = 0;          // of its refused views
  std::function<KeptMoment()> keep_;  // as the mission is at its decision
  std::vector<ViewPose> tried_;       // since then
  std::exception_ptr failure_;
  EnvState state_;
  std::function<double(const Belief&)> coverage_of_;
  std::unique_ptr<std::thread> thread_;
  const int process_;  // that made it
};

}  // namespace gnbv
