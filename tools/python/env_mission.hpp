// A mission as an environment: a thread of its own flies it and stops where it wants a view.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "bench/score/surface_reference.hpp"
#include "tools/mission/mission.hpp"
#include "tools/python/env_observation.hpp"

namespace gnbv {

/// What all missions of a scenario share; nothing in it changes.
struct EnvStage {
  /// `goal` is the share of the ceiling at which a mission ends; 0: never. Throws BadInput.
  EnvStage(const std::string& scenario_name, const std::vector<std::string>& overrides,
           double goal);

  const Scenario scenario;
  const World world;
  const RayScene scene;
  const SurfaceReference reference;
  const double ceiling;        // share of the surface that can be covered; 1 where no goal asks
  const double goal_coverage;  // share of the surface at which it ends; above 1: never
  const std::vector<double> scales;
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
  ViewPose pose;
  EnvObservation seen;
};

/// Waits end after this long, so that their callers can look for signals between them.
constexpr double kSlice_s = 0.05;

class EnvMission final : public MissionObserver {
 public:
  EnvMission(std::shared_ptr<const EnvStage> stage, std::shared_ptr<Permits> permits,
             bool with_candidates, bool with_top);
  ~EnvMission() override;
  EnvMission(const EnvMission&) = delete;
  EnvMission& operator=(const EnvMission&) = delete;

  // The thread is of the process that made the mission: in a forked child there is none, close()
  // has nothing to do, and the others throw std::runtime_error.

  /// Begins anew; wait() says when it wants a view. Requires that close() returned true.
  void begin(std::uint64_t seed);
  /// Requires a mission that waits for a view; throws std::runtime_error otherwise.
  void act(const ViewPose& view);
  /// Its state when it wants a view or is over; nothing while it flies on, after kSlice_s. Throws
  /// what the mission threw.
  const EnvState* wait();
  /// Tells the mission to end; whether it has, false after kSlice_s.
  bool close();

 private:
  enum class Turn { mission, agent, over };
  void check_process() const;
  void fly(Scenario scenario);
  std::optional<ViewPose> ask();
  void keep(const Belief& belief);
  void on_view(const ViewRecord& view, const Belief& belief) override;

  std::shared_ptr<const EnvStage> stage_;
  std::shared_ptr<Permits> permits_;
  bool with_candidates_;
  bool with_top_;
  std::unique_ptr<EnvObserver> observer_;

  std::mutex mutex_;
  std::condition_variable turned_;
  Turn turn_ = Turn::over;
  std::atomic<bool> is_closing_ = false;
  std::optional<ViewPose> action_;
  std::exception_ptr failure_;
  EnvState state_;
  std::function<double(const Belief&)> coverage_of_;
  std::size_t taken_ = 0;  // views
  std::unique_ptr<std::thread> thread_;
  const int process_;  // that made it
};

}  // namespace gnbv
