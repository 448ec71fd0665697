// The planner for those who fly: give it cameras, a box and settings, feed it what the sensors
// measure, ask it for the next view. examples/onboard is a program that does so.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/config.hpp"

namespace gnbv {

/// A utility of your own. The planner calls it once for each candidate view, in one thread.
struct OnboardUtility {
  std::string name;
  std::function<double(const ViewStats&, const ViewPose&)> value;  // finite; the highest wins
  /// The fields of ViewStats that `value` reads, separated by blanks: the others are not counted
  /// where counting costs time.
  std::string reads;
};

struct OnboardSettings {
  Box3 workspace_m;  // in the world frame: ENU, z up, the ground near z = 0
  std::vector<CameraConfig> cameras;
  std::vector<LidarConfig> lidars = {};        // for a profile, or to look (LidarConfig::looks)
  PlannerConfig planner = {};                  // planner.utility.name chooses the planner
  std::optional<OnboardUtility> utility = {};  // instead of the one that `planner` names
  NoFly no_fly = {};
  TravelConfig travel = {};  // how fast the vehicle is; tours in seconds ask
  std::uint64_t seed = 0;    // of what a planner leaves to chance
  int threads = 1;           // no answer depends on it
  /// Asked several times a second while a view is planned, by any thread. Where it says yes,
  /// next_view() throws StopRequested.
  std::function<bool()> should_stop = {};
};

/// Plans one mission. A profile, if there is one, comes first; then a view is taken where the
/// vehicle is, the next one is asked for, flown to and taken, and so on.
class Onboard {
 public:
  /// Throws BadInput for settings without camera and LIDAR or without a box, or a planner that
  /// nobody knows.
  explicit Onboard(OnboardSettings settings);
  Onboard(Onboard&&) = delete;  // its planner refers to its model

  /// A profile that was measured now, or one that was saved: `profile.map` of a run. Throws
  /// BadInput for a file of another map.
  void add_profile(std::span<const LidarScan> sweeps);
  void load_profile(const std::filesystem::path& file);

  /// What cameras saw on the way to a view. DepthFrame::T_world_camera is where from.
  void add_frames(std::span<const DepthFrame> frames);
  /// The same of LIDARs that look.
  void add_looks(std::span<const LidarScan> sweeps);
  /// A view that was taken from `pose`: one frame a camera, one sweep a LIDAR that looks.
  void add_view(const ViewPose& pose, std::span<const DepthFrame> frames,
                std::span<const LidarScan> sweeps = {});

  /// Where to take the next view, and the points on the way there; nothing when the mission is
  /// over. Requires a view since the last call.
  std::optional<Decision> next_view();
  /// Why the mission is over, once it is.
  Termination end() const { return end_; }

  const Belief& belief() const { return belief_; }
  const History& history() const { return history_; }

 private:
  void begin_from_profile();

  const PlannerConfig config_;
  const PlannerModel model_;
  std::unique_ptr<Planner> planner_;
  Scratch scratch_;
  Belief belief_;
  History history_;
  ViewPose current_;
  Decision flown_to_;  // the view that is taken next
  Termination end_ = Termination::no_valid_view;
};

}  // namespace gnbv
