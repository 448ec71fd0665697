// `--views -`: another planner sends views on stdin and gets one JSON line on stdout for each.
// docs/guides/own-views.md says what the lines hold.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "bench/score/surface_reference.hpp"
#include "tools/mission/mission.hpp"
#include "tools/run/run_directory.hpp"
#include "tools/run/user_views.hpp"
#include "tools/terminal/streams.hpp"

namespace gnbv {

/// The latest depth frame of a camera, in memory that another process of this machine maps.
class SharedDepth {
 public:
  /// Named after this process and the number; gone with this object.
  explicit SharedDepth(std::size_t number);
  ~SharedDepth();
  SharedDepth(const SharedDepth&) = delete;
  SharedDepth& operator=(const SharedDepth&) = delete;

  /// (height, width) row-major float32 in metres, as DepthFrame has them: in the place of the frame
  /// before. Whether there is such memory here.
  bool write(std::span<const float> depth_m);
  /// A file that may be mapped or read.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
};

class ViewPipe final : public MissionObserver {
 public:
  /// `keeps_frames` and `reference` (may be null) say whether answers name images and tell the
  /// coverage. `fault` (may be empty) is asked when the lines end: a sentence fails the mission; of
  /// a command of this machine, which gets depth in shared memory. Everything referred to stays
  /// with the caller.
  ViewPipe(const Scenario& scenario, RunDirectory& directory, bool keeps_frames,
           const SurfaceReference* reference, std::function<std::string()> fault = {});
  ~ViewPipe() override;
  ViewPipe(const ViewPipe&) = delete;
  ViewPipe& operator=(const ViewPipe&) = delete;

  /// Lets the mission ask for views here and tell what became of them. `inputs` is good as long as
  /// this lives.
  void connect(MissionInputs& inputs);

  /// With all views that came.
  const Scenario& scenario() const { return scenario_; }

  void on_profile_belief(const Belief& belief) override;
  void on_sensed(const SensedView& view) override;
  void on_view(const ViewRecord& view, const Belief& belief) override;

 private:
  std::optional<ViewPose> next(const std::function<bool()>& should_stop);
  void tell_refused(std::size_t index, Rejection reason);
  void add_cameras(const ViewRecord& view, nlohmann::ordered_json& answer) const;

  Scenario scenario_;
  RunDirectory& directory_;
  bool keeps_frames_;
  const SurfaceReference* reference_;
  std::function<std::string()> fault_;
  StdinLines input_;
  ViewLines lines_;
  void (*on_sigpipe_)(int);   // as it was before
  std::size_t answered_ = 0;  // every given view is, in its order
  // of the view at hand
  Isometry T_world_body_ = Isometry::Identity();
  struct TakenFrame {
    std::size_t camera = 0;  // of the scenario
    Isometry T_world_camera = Isometry::Identity();
    std::string shared_depth = {};  // path; "": not shared
  };
  std::vector<TakenFrame> frames_;  // of the view at hand, without those that were lost
  std::vector<std::unique_ptr<SharedDepth>> shared_;  // by camera
  std::size_t points_before_ = 0;
};

/// The last line: how the mission ended, and where its run directory is.
std::string pipe_end_line(const MissionResult& result, const std::string& folder);

}  // namespace gnbv
