#include "tools/exports/timeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "sensors/camera_model.hpp"
#include "sim/core/embed.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tools/mission/python_script.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

GNBV_EMBED(recorded_run_py, GNBV_TIMELINE_FOLDER "/recorded_run.py");
GNBV_EMBED(to_rerun_py, GNBV_TIMELINE_FOLDER "/to_rerun.py");
GNBV_EMBED(to_mcap_py, GNBV_TIMELINE_FOLDER "/to_mcap.py");

/// View, time, place and attitude of the optical frame, names of the images.
Json frame_json(int view, double time_s, const Isometry& T_world_camera,
                const std::string& colour = {}, const std::string& depth = {}) {
  const Vec3 p = T_world_camera.translation();
  const Eigen::Quaterniond q(T_world_camera.linear());
  return {view, time_s, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(), colour, depth};
}

template <typename Camera>
Json camera_json(const Camera& camera, const std::string& name, int width_px, int height_px,
                 Json frames) {
  return {{"name", name},          {"width_px", width_px},       {"height_px", height_px},
          {"fx_px", camera.fx_px}, {"fy_px", camera.fy_px},      {"cx_px", camera.cx_px},
          {"cy_px", camera.cy_px}, {"frames", std::move(frames)}};
}

Json cameras_of_frames(const FrameRecord& record) {
  Json cameras = Json::array();
  for (std::size_t i = 0; i < record.cameras.size(); ++i) {
    const FrameCamera& camera = record.cameras[i];
    Json frames = Json::array();
    for (const RecordedFrame& frame : record.frames) {
      if (frame.camera != i) continue;
      frames.push_back(frame_json(frame.iteration, frame.time_s, frame.T_world_camera,
                                  frame.colour.filename().string(),
                                  frame.depth.filename().string()));
    }
    cameras.push_back(
        camera_json(camera, camera.name, camera.width_px, camera.height_px, std::move(frames)));
  }
  return cameras;
}

/// Where the scenario's cameras truly were at the views.
Json cameras_of_views(const RunRecord& record) {
  Json cameras = Json::array();
  for (const CameraConfig& config : record.scenario.cameras) {
    const CameraModel camera = make_camera_model(config);
    Json frames = Json::array();
    for (const ViewRecord& view : record.views) {
      const std::optional<Isometry> T_world_body = true_pose_at(record, view.time_s);
      if (!T_world_body) continue;
      const CameraModel at_view = turned(camera, view.decision.view.gimbal_pitch_rad);
      frames.push_back(
          frame_json(view.iteration, view.time_s, *T_world_body * at_view.T_body_camera));
    }
    cameras.push_back(
        camera_json(camera, config.name, config.width_px, config.height_px, std::move(frames)));
  }
  return cameras;
}

/// View, time and the number of points by then.
Json growth_of(const RunRecord& record, const std::optional<RunCloud>& cloud) {
  Json growth = Json::array();
  if (!cloud) return growth;
  growth.push_back({-1, record.profile_end_s.value_or(0.0), cloud->profile_points});
  for (std::size_t i = 0; i < record.views.size(); ++i) {
    growth.push_back({record.views[i].iteration, record.views[i].time_s, cloud->view_points[i]});
  }
  if (record.views.empty() || record.path.empty()) return growth;
  if (cloud->points_world_m.size() > cloud->view_points.back()) {  // after the last view, in flight
    growth.push_back({static_cast<int>(record.views.size()),
                      std::max(record.path.back().time_s, record.views.back().time_s),
                      cloud->points_world_m.size()});
  }
  return growth;
}

std::string words_of(const Json& written) {
  std::string words;
  for (const auto& [kind, count] : written.items()) {
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", count.get<std::int64_t>(), kind);
  }
  return words;
}

}  // namespace

std::string write_timeline(const RunRecord& record, const TimelineParts& parts,
                           std::string_view format, const fs::path& folder) {
  const fs::path structure = folder / "structure.ply";  // only handed over
  if (parts.structure) write_mesh(*parts.structure, structure);
  const std::string id = record.figures ? record.figures->result_sha256.substr(0, 32) : "";
  const Json scene = {
      {"format", format},
      {"name", run_title(record)},
      {"id", id.empty() ? record.folder.filename().string() : id},
      {"run", fs::absolute(record.folder).string()},
      {"out", fs::absolute(folder / (format == "rerun" ? "run.rrd" : "run.mcap")).string()},
      {"structure", parts.structure ? fs::absolute(structure).string() : ""},
      {"cameras", parts.frames ? cameras_of_frames(*parts.frames) : cameras_of_views(record)},
      {"cloud", growth_of(record, parts.cloud)}};
  const bool is_rerun = format == "rerun";
  const Json written = ask_python(
      {.what = fmt::format("--format {}", format),
       .modules = {{"recorded_run", recorded_run_py()},
                   {fmt::format("to_{}", format), is_rerun ? to_rerun_py() : to_mcap_py()}},
       .entry = "recorded_run",
       .pip = is_rerun ? "numpy rerun-sdk"
                       : "numpy mcap mcap-protobuf-support foxglove-schemas-protobuf pillow"},
      scene);
  fs::remove(structure);
  return words_of(written);
}

}  // namespace gnbv
