#include "tools/mission/view_pipe.hpp"

#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "planner/routes.hpp"
#include "sim/core/error.hpp"
#include "tools/run_files/file_names.hpp"
#include "tools/run_files/frames_folder.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

/// What of a path is no UTF-8 shows as the replacement character.
std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Also to nobody: who no longer listens ends the mission by closing stdin.
void tell(const Json& answer) {
  std::fputs(line_of(answer).c_str(), stdout);
  std::fflush(stdout);  // the other side waits for it
}

/// In the optical frame for a camera, else in the body's.
void add_pose(const Isometry& T_world, Json& json) {
  const Vec3 p = T_world.translation();
  const Eigen::Quaterniond q(T_world.linear());
  json["position_m"] = {p.x(), p.y(), p.z()};
  json["qx_qy_qz_qw"] = {q.x(), q.y(), q.z(), q.w()};
}

Json coverage_json(const SurfaceReference& reference, const Belief& belief) {
  const auto shares = coverage_at_all_sizes(reference.outside, belief.cloud.points_world_m());
  return {{"0.05", shares[0]}, {"0.10", shares[1]}, {"0.50", shares[2]}};
}

}  // namespace

ViewPipe::ViewPipe(const Scenario& scenario, RunDirectory& directory, bool keeps_frames,
                   const SurfaceReference* reference)
    : scenario_(scenario),
      directory_(directory),
      keeps_frames_(keeps_frames),
      reference_(reference),
      lines_("stdin"),
      on_sigpipe_(std::signal(SIGPIPE, SIG_IGN)) {}

ViewPipe::~ViewPipe() { std::signal(SIGPIPE, on_sigpipe_); }

void ViewPipe::connect(MissionHooks& hooks) {
  hooks.next_given = [this, should_stop = hooks.should_stop] { return next(should_stop); };
  hooks.on_refused = [this](std::size_t index, Rejection reason) { tell_refused(index, reason); };
  hooks.on_sensed = [this](const Isometry& T_world_body, std::span<const DepthFrame> frames) {
    T_world_body_ = T_world_body;
    frames_.clear();
    for (const DepthFrame& frame : frames) {
      frames_.push_back({static_cast<std::size_t>(frame.camera), frame.T_world_camera});
    }
  };
  hooks.on_view = [this, before = hooks.on_view](const ViewRecord& view) {
    before(view);
    view_ = view;
  };
  hooks.on_view_belief = [this, before = hooks.on_view_belief](const Belief& belief) {
    before(belief);
    tell_taken(belief);
  };
  hooks.on_profile_belief = [this, before = hooks.on_profile_belief](const Belief& belief) {
    before(belief);
    points_before_ = belief.cloud.points_world_m().size();
  };
}

std::optional<ViewPose> ViewPipe::next(const std::function<bool()>& should_stop) {
  std::vector<ViewPose>& views = scenario_.planner.routes.views;
  while (views.size() < kMostGivenViews) {
    const std::optional<std::string> line = input_.next(should_stop);
    if (!line) return std::nullopt;
    try {
      const std::optional<ViewPose> view = lines_.read(*line);
      if (!view) continue;
      views.push_back(*view);
      directory_.keep(scenario_);
      return view;
    } catch (const BadInput& error) {
      tell({{"event", "malformed"}, {"what", error.what()}});
    }
  }
  return std::nullopt;
}

void ViewPipe::tell_refused(std::size_t index, Rejection reason) {
  GNBV_CHECK(index == answered_, "view {} after {} answers", index, answered_);
  ++answered_;
  tell({{"event", "refused"}, {"view", index}, {"reason", name_of(reason)}});
}

void ViewPipe::tell_taken(const Belief& belief) {
  Json answer = {{"event", view_.iteration == 0 ? "start" : "flown"}};
  if (view_.iteration > 0) answer["view"] = answered_++;
  answer["iteration"] = view_.iteration;
  add_pose(T_world_body_, answer);
  answer["yaw_deg"] = rad_to_deg(yaw_of(T_world_body_));
  Json cameras = Json::array();
  for (const TakenFrame& frame : frames_) {
    const std::string& name = scenario_.cameras[frame.camera].name;
    Json camera = {{"name", name}};
    add_pose(frame.T_world_camera, camera);
    if (keeps_frames_) {
      const auto stem = directory_.path() / kFramesFolder /
                        frame_stem(static_cast<std::size_t>(view_.iteration), name);
      camera["rgb"] = stem.string() + ".rgb.png";
      camera["depth"] = stem.string() + ".depth.png";
    }
    cameras.push_back(std::move(camera));
  }
  answer["cameras"] = std::move(cameras);
  answer["points"] = view_.cloud_points;
  answer["new_points"] = view_.cloud_points - points_before_;
  answer["entropy_nat"] = view_.entropy_nat;
  answer["flown_m"] = view_.flown_m;
  answer["time_s"] = view_.time_s;
  if (reference_ != nullptr) answer["coverage"] = coverage_json(*reference_, belief);
  points_before_ = view_.cloud_points;
  tell(answer);
}

std::string pipe_end_line(const MissionResult& result, const std::string& folder) {
  const Json line = {{"event", "end"},
                     {"termination", name_of(result.termination)},
                     {"iterations", result.views.size()},
                     {"run", folder},
                     {"result_sha256", result_sha256(result)}};
  return line_of(line);
}

}  // namespace gnbv
