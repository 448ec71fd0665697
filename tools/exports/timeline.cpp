#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "sensors/camera_model.hpp"
#include "sim/core/embed.hpp"
#include "sim/core/file.hpp"
#include "sim/core/image.hpp"
#include "tools/exports/formats.hpp"
#include "tools/mission/python_script.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

GNBV_EMBED(recorded_run_py, GNBV_TIMELINE_FOLDER "/recorded_run.py");
GNBV_EMBED(to_rerun_py, GNBV_TIMELINE_FOLDER "/to_rerun.py");
GNBV_EMBED(to_mcap_py, GNBV_TIMELINE_FOLDER "/to_mcap.py");

/// Time, place and attitude: x y z qx qy qz qw.
Json pose_row(double time_s, const Isometry& T) {
  const Vec3 p = T.translation();
  const Eigen::Quaterniond q(T.linear());
  return {time_s, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

template <typename Camera>
Json camera_json(const Camera& camera, const std::string& name, int width_px, int height_px,
                 Json frames) {
  const auto& lens = camera.lens;
  const DistortionConfig distortion = lens ? lens->distortion() : DistortionConfig{};
  return {{"name", name},
          {"width_px", width_px},
          {"height_px", height_px},
          {"fx_px", camera.fx_px},
          {"fy_px", camera.fy_px},
          {"cx_px", camera.cx_px},
          {"cy_px", camera.cy_px},
          {"skew_px", lens ? lens->pinhole().skew_px : 0.0},
          {"distortion", distortion_name(distortion.model)},
          {"coefficients", coefficients_of(distortion)},
          {"frames", std::move(frames)}};
}

Json cameras_of_frames(const FrameRecord& record) {
  std::vector<Json> frames(record.cameras.size(), Json::array());
  for (const RecordedFrame& f : record.frames) {
    frames[f.camera].push_back({f.iteration, pose_row(f.time_s, f.T_world_camera),
                                fs::absolute(f.colour).string(), fs::absolute(f.depth).string()});
  }
  Json cameras = Json::array();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameCamera& c = record.cameras[i];
    cameras.push_back(camera_json(c, c.name, c.width_px, c.height_px, std::move(frames[i])));
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
      const Isometry T_world_camera = *T_world_body * at_view.T_body_camera;
      frames.push_back({view.iteration, pose_row(view.time_s, T_world_camera), nullptr, nullptr});
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

/// Times and values by name: of each view, and coverage of the profile, too.
Json plots_of(const RunRecord& record) {
  Json plots = Json::object();
  if (record.views.empty()) return plots;
  const auto add = [&](const std::string& name, double time_s, double value) {
    plots[name].push_back({time_s, value});
  };
  for (const ViewRecord& view : record.views) {
    add("utility", view.time_s, view.decision.score.value);
    add("entropy_nat", view.time_s, view.entropy_nat);
    add("density_points_per_voxel", view.time_s, view.density_points_per_voxel);
    add("cloud_points", view.time_s, static_cast<double>(view.cloud_points));
    add("flown_m", view.time_s, view.flown_m);
  }
  if (!record.figures) return plots;
  const CoverageCurve& curve = record.figures->curve;
  for (std::size_t i = 0; i < curve.seconds.size(); ++i) {
    // the curve's seconds count from the end of the profile, entry 0; entry 1 is the first view's
    const double time_s = record.views[0].time_s - curve.seconds[1] + curve.seconds[i];
    for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
      add("coverage/" + size_name(kCoverageSizes_m[size]), time_s, curve.coverage[i][size]);
    }
    for (const SizedCoverage& at : record.figures->more) {
      add("coverage/" + size_name(at.size_m), time_s, at.curve[i]);
    }
  }
  return plots;
}

/// Rows of numbers as they lie in memory, in a file that is only handed over: its path.
template <typename Row>
Json handed_over(const std::vector<Row>& rows, const fs::path& file) {
  write_file_atomically(file,
                        {reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(Row)},
                        Lasting::the_process);
  return fs::absolute(file).string();
}

Json structure_of(const TriangleMesh& mesh, const fs::path& folder) {
  std::vector<Rgb8> colours;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    const auto [r, g, b] = mean_colour(mesh, face);
    colours.push_back({srgb_byte(r), srgb_byte(g), srgb_byte(b)});
  }
  return {{"vertices", handed_over(mesh.vertices_m, folder / "vertices")},
          {"triangles", handed_over(mesh.faces, folder / "triangles")},
          {"colours", handed_over(colours, folder / "colours")}};
}

}  // namespace

std::string write_timeline(const RunRecord& record, const ExportParts& parts,
                           std::string_view format, const fs::path& folder) {
  const bool is_rerun = format == "rerun";
  const fs::path handed = folder / "handed_over";
  fs::create_directory(handed);
  const auto points = parts.cloud ? parts.cloud->points_world_m : std::vector<Vec3f>{};
  Json trajectory = Json::array();
  for (const TrajectorySample& sample : record.path) {
    trajectory.push_back(pose_row(sample.time_s, sample.T_world_body));
  }
  const std::string id = record.figures ? record.figures->result_sha256.substr(0, 32) : "";
  const Json scene = {
      {"format", format},
      {"name", run_title(record)},
      {"id", id.empty() ? record.folder.filename().string() : id},
      {"out", fs::absolute(folder / (is_rerun ? "run.rrd" : "run.mcap")).string()},
      {"structure", parts.structure ? structure_of(*parts.structure, handed) : Json(nullptr)},
      {"trajectory", std::move(trajectory)},
      {"plots", plots_of(record)},
      {"cameras", parts.frames ? cameras_of_frames(*parts.frames) : cameras_of_views(record)},
      {"points", handed_over(points, handed / "points")},
      {"growth", growth_of(record, parts.cloud)}};
  const Json written = ask_python(
      {.what = fmt::format("--format {}", format),
       .modules = {{"recorded_run", recorded_run_py()},
                   {fmt::format("to_{}", format), is_rerun ? to_rerun_py() : to_mcap_py()}},
       .entry = "recorded_run",
       .pip = is_rerun ? "numpy 'rerun-sdk>=0.28'"
                       : "numpy mcap mcap-protobuf-support foxglove-schemas-protobuf pillow"},
      scene);
  fs::remove_all(handed);
  std::string words;
  for (const auto& [kind, count] : written.items()) {
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", count.get<std::int64_t>(), kind);
  }
  const auto is_bent = [](const CameraConfig& c) { return c.distortion.model != Distortion::none; };
  if (is_rerun && std::ranges::any_of(record.scenario.cameras, is_bent)) {
    words += "; images as of pinholes, since Rerun knows no distortion";
  }
  return words;
}

}  // namespace gnbv
