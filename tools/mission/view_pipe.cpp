#include "tools/mission/view_pipe.hpp"

#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/frames_folder.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

/// What of a path is no UTF-8 shows as the replacement character.
std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Also to nobody: who no longer listens ends the mission by closing stdin.
void tell_client(const Json& answer) {
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
  const auto shares = coverage_at_all_sizes(reference.counted, belief.cloud.points_world_m());
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

void ViewPipe::connect(MissionInputs& inputs) {
  inputs.observers.push_back(this);
  inputs.sources.next_view = [this, should_stop = inputs.should_stop] { return next(should_stop); };
  inputs.sources.on_refused = [this](std::size_t index, Rejection reason) {
    tell_refused(index, reason);
  };
}

void ViewPipe::on_profile_belief(const Belief& belief) {
  points_before_ = belief.cloud.points_world_m().size();
}

void ViewPipe::on_sensed(const SensedView& view) {
  T_world_body_ = view.T_world_body;
  frames_.clear();
  for (const DepthFrame& frame : view.depth) {
    frames_.push_back({static_cast<std::size_t>(frame.camera), frame.T_world_camera});
  }
}

std::optional<ViewPose> ViewPipe::next(const std::function<bool()>& should_stop) {
  std::vector<ViewPose>& views = scenario_.planner.routes.views;
  while (views.size() < kMostUserViews) {
    const std::optional<std::string> line = input_.next(should_stop);
    if (!line) return std::nullopt;
    try {
      const std::optional<ViewPose> view = lines_.read(*line);
      if (!view) continue;
      views.push_back(*view);
      directory_.keep(views);
      return view;
    } catch (const BadInput& error) {
      tell_client({{"event", "malformed"}, {"what", error.what()}});
    }
  }
  return std::nullopt;
}

void ViewPipe::tell_refused(std::size_t index, Rejection reason) {
  GNBV_CHECK(index == answered_, "view {} after {} answers", index, answered_);
  ++answered_;
  tell_client({{"event", "refused"}, {"view", index}, {"reason", name_of(reason)}});
}

void ViewPipe::on_view(const ViewRecord& view, const Belief& belief) {
  Json answer = {{"event", view.iteration == 0 ? "start" : "flown"}};
  if (view.iteration > 0) answer["view"] = answered_++;
  answer["iteration"] = view.iteration;
  add_pose(T_world_body_, answer);
  answer["yaw_deg"] = rad_to_deg(yaw_of(T_world_body_));
  Json cameras = Json::array();
  for (const TakenFrame& frame : frames_) {
    const std::string& name = scenario_.cameras[frame.camera].name;
    Json camera = {{"name", name}};
    add_pose(frame.T_world_camera, camera);
    if (keeps_frames_) {
      const auto stem = directory_.path() / kFramesFolder /
                        frame_stem(static_cast<std::size_t>(view.iteration), name);
      camera["rgb"] = stem.string() + ".rgb.png";
      camera["depth"] = stem.string() + ".depth.png";
    }
    cameras.push_back(std::move(camera));
  }
  answer["cameras"] = std::move(cameras);
  answer["points"] = view.cloud_points;
  answer["new_points"] = view.cloud_points - points_before_;
  answer["entropy_nat"] = view.entropy_nat;
  answer["flown_m"] = view.flown_m;
  answer["time_s"] = view.time_s;
  if (reference_ != nullptr) answer["coverage"] = coverage_json(*reference_, belief);
  points_before_ = view.cloud_points;
  tell_client(answer);
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
