#include "tools/mission/view_pipe.hpp"

#include <fcntl.h>
#include <unistd.h>

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

/// What of the budgets is left; null where there is none.
Json left_json(const TerminationConfig& config, const ViewRecord& view) {
  const auto left = [](double budget, double spent) {
    return budget > 0.0 ? Json(budget - spent) : Json(nullptr);
  };
  return {{"views", config.max_iterations - view.iteration - 1},
          {"metres", left(config.max_distance_m, view.straight_m)},
          {"seconds", left(config.max_flight_time_s, view.time_s)}};
}

Json box_json(const Box3& box_m) {
  const Vec3 &a = box_m.min(), &b = box_m.max();
  return {{"min", {a.x(), a.y(), a.z()}}, {"max", {b.x(), b.y(), b.z()}}};
}

/// What a planner may know before it flies.
Json task_json(const Scenario& scenario) {
  Json cameras = Json::array();
  for (const CameraModel& model : camera_models(scenario)) {
    cameras.push_back({{"name", model.config.name},
                       {"width_px", model.config.width_px},
                       {"height_px", model.config.height_px},
                       {"fx_px", model.fx_px},
                       {"fy_px", model.fy_px},
                       {"cx_px", model.cx_px},
                       {"cy_px", model.cy_px},
                       {"has_lens", model.lens != nullptr},
                       {"range_min_m", model.config.range_min_m},
                       {"range_max_m", model.config.range_max_m}});
  }
  return {{"workspace_m", box_json(scenario.workspace_m)},
          {"collision_radius_m", scenario.planner.validity.collision_radius_m},
          {"resolution_m", scenario.planner.map.resolution_m},
          {"leaf_m", scenario.planner.cloud.leaf_m},
          {"cameras", std::move(cameras)}};
}

Json coverage_json(const SurfaceReference& reference, const Belief& belief) {
  const auto shares = coverage_at_all_sizes(reference.counted, belief.cloud.points_world_m());
  return {{"0.05", shares[0]}, {"0.10", shares[1]}, {"0.50", shares[2]}};
}

}  // namespace

SharedDepth::SharedDepth(std::size_t number)
    : path_(fmt::format("/dev/shm/gnbv-{}-{}.f32", getpid(), number)) {
  ::unlink(path_.c_str());  // what a killed process of that number left
  descriptor_ = open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC | O_NOFOLLOW, 0600);
}

SharedDepth::~SharedDepth() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(path_.c_str());
}

bool SharedDepth::write(std::span<const float> depth_m) {
  const auto bytes = std::as_bytes(depth_m);
  std::size_t done = 0;
  while (descriptor_ >= 0 && done < bytes.size()) {
    const ssize_t count =
        pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return descriptor_ >= 0;
}

ViewPipe::ViewPipe(const Scenario& scenario, RunDirectory& directory, bool keeps_frames,
                   const SurfaceReference* reference, std::function<std::string()> fault)
    : scenario_(scenario),
      directory_(directory),
      keeps_frames_(keeps_frames),
      reference_(reference),
      fault_(std::move(fault)),
      lines_("stdin"),
      on_sigpipe_(std::signal(SIGPIPE, SIG_IGN)) {
  for (std::size_t i = 0; fault_ && i < scenario.cameras.size(); ++i) {
    shared_.push_back(std::make_unique<SharedDepth>(i));
  }
}

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
    const auto camera = static_cast<std::size_t>(frame.camera);
    const bool is_shared = !shared_.empty() && shared_[camera]->write(frame.depth_m);
    frames_.push_back({camera, frame.T_world_camera, is_shared ? shared_[camera]->path() : ""});
  }
}

std::optional<ViewPose> ViewPipe::next(const std::function<bool()>& should_stop) {
  std::vector<ViewPose>& views = scenario_.planner.routes.views;
  while (views.size() < kMostUserViews) {
    const std::optional<std::string> line = input_.next(should_stop);
    if (!line) {
      const std::string fault = fault_ && !should_stop() ? fault_() : "";
      if (!fault.empty()) throw UserUtilityFailed(fault);
      return std::nullopt;
    }
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

/// Of those whose frames were not lost.
void ViewPipe::add_cameras(const ViewRecord& view, Json& answer) const {
  Json cameras = Json::array();
  for (const TakenFrame& frame : frames_) {
    const std::string& name = scenario_.cameras[frame.camera].name;
    Json camera = {{"name", name}};
    add_pose(frame.T_world_camera, camera);
    if (!frame.shared_depth.empty()) camera["depth_f32"] = frame.shared_depth;
    if (keeps_frames_) {
      const auto stem = directory_.path() / kFramesFolder /
                        frame_stem(static_cast<std::size_t>(view.iteration), name);
      camera["rgb"] = stem.string() + ".rgb.png";
      camera["depth"] = stem.string() + ".depth.png";
    }
    cameras.push_back(std::move(camera));
  }
  answer["cameras"] = std::move(cameras);
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
  add_cameras(view, answer);
  answer["points"] = view.cloud_points;
  answer["new_points"] = view.cloud_points - points_before_;
  answer["entropy_nat"] = view.entropy_nat;
  answer["flown_m"] = view.flown_m;
  answer["time_s"] = view.time_s;
  answer["left"] = left_json(scenario_.planner.termination, view);
  if (view.iteration == 0) answer["task"] = task_json(scenario_);
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
