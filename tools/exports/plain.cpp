#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "planner/map/octomap_io.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/exports/export_folder.hpp"
#include "tools/exports/formats.hpp"
#include "tools/run/cloud_file.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_files.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kPlainReadme =
    R"(A gnbv run as plain files. What the run did not keep is not here.

Frames. World: east, north, up; metres. Body: x forward, y left, z up. Camera: optical frame, x
right, y down, z forward. A pose is of the named frame in the world: p_world = R(q) p + (x, y, z),
with the unit quaternion q = (qx, qy, qz, qw). Time is simulated seconds since the mission began.

trajectory.csv   true path of the body at 10 Hz; phase: profile, transfer, views
views.csv        a row for each view and camera (of a vehicle without cameras, for each view): where
                 body and camera were, why the view was chosen (sampler, utility and its terms), what
                 was known after it. pose: `believed` is the vehicle's own estimate when the frame
                 was taken, `planned` the view's goal, where no frame was kept. entropy_nat: of the whole map; straight_m, flown_m: since the
                 first view; image, depth: files here
intrinsics.json  of each camera: model, pixels, the centre of the first pixel at (0.5, 0.5);
                 distortion as OpenCV has it; T_body_camera row by row, of a camera on a gimbal
                 with the gimbal level; ranges along the optical axis, of a fisheye along the ray;
                 depth_scale_m: metres a step of its depth images
images/*.png     colour, sRGB, 8 bits
depth/*.png      16 bits, steps of depth_scale_m along the optical axis, 0 where there is none
cloud.ply        the model: x y z (float32, metres), red green blue (grey 128 where no frame shows
                 the point), view: iteration that brought the point, -1 for the profile, and one
                 more than the last iteration for what came after it
voxels.ply       centres of the map's occupied voxels (float32, metres)
map.json         edge of these voxels in metres; how many are occupied, free
scenario.yaml    the whole configuration; `gnbv run scenario.yaml` flies the mission again

In Python, without our code:

  views = pandas.read_csv("views.csv"); depth = imageio.imread("depth/000000_rgbd.png") * scale
  cloud = open3d.io.read_point_cloud("cloud.ply")
)";

std::string pose_header(std::string_view frame) {
  return fmt::format("{0}_x_m,{0}_y_m,{0}_z_m,{0}_qx,{0}_qy,{0}_qz,{0}_qw", frame);
}

std::string_view phase_at(const RunRecord& record, double time_s) {
  if (!record.profile_end_s || !record.views_begin_s) return "";
  if (time_s <= *record.profile_end_s) return "profile";
  return time_s < *record.views_begin_s ? "transfer" : "views";
}

std::string trajectory_text(const RunRecord& record) {
  std::string text = fmt::format("time_s,{},phase\n", pose_header("body"));
  for (const TrajectorySample& s : record.path) {
    text += fmt::format("{:.3f},{},{}\n", s.time_s, pose_text(s.T_world_body, ','),
                        phase_at(record, s.time_s));
  }
  return text;
}

/// The frame of a view and camera; null when none was kept.
const RecordedFrame* find_frame(const FrameRecord& frames, int iteration,
                                const std::string& camera) {
  const auto found = std::ranges::find_if(frames.frames, [&](const RecordedFrame& frame) {
    return frame.iteration == iteration && frames.cameras[frame.camera].name == camera;
  });
  return found == frames.frames.end() ? nullptr : &*found;
}

std::string view_row(const ViewRecord& view, const CameraModel& camera, const FrameRecord& frames) {
  const RecordedFrame* const frame = find_frame(frames, view.iteration, camera.config.name);
  const Isometry T_world_camera = frame != nullptr
                                      ? frame->T_world_camera
                                      : T_world_body(view.decision.view) * camera.T_body_camera;
  const std::string name = frame != nullptr ? image_name(frames, *frame) : "";
  return fmt::format("{},{},{},{},{},{},{},{}\n", view.iteration, camera.config.name,
                     frame != nullptr ? "believed" : "planned",
                     pose_text(T_world_camera * camera.T_body_camera.inverse(), ','),
                     pose_text(T_world_camera, ','), decision_cells(view),
                     name.empty() ? "" : "images/" + name, name.empty() ? "" : "depth/" + name);
}

std::string views_text(const RunRecord& record, const FrameRecord& frames) {
  std::string text = fmt::format("iteration,camera,pose,{},{},{},image,depth\n",
                                 pose_header("body"), pose_header("camera"), decision_header());
  for (const ViewRecord& view : record.views) {
    if (record.scenario.cameras.empty()) {
      text += fmt::format("{},,planned,{},,,,,,,,{},,\n", view.iteration,
                          pose_text(T_world_body(view.decision.view), ','), decision_cells(view));
    }
    for (const CameraConfig& config : record.scenario.cameras) {
      const CameraModel camera =
          turned(make_camera_model(config), view.decision.view.gimbal_pitch_rad);
      text += view_row(view, camera, frames);
    }
  }
  return text;
}

std::string intrinsics_text(const RunRecord& record, const FrameRecord& frames) {
  Json cameras = Json::array();
  for (const CameraConfig& config : record.scenario.cameras) {
    const CameraModel camera = make_camera_model(config);
    Json T_body_camera = Json::array();
    for (int r = 0; r < 4; ++r) {
      const Eigen::RowVector4d row = camera.T_body_camera.matrix().row(r);
      T_body_camera.push_back({row[0], row[1], row[2], row[3]});
    }
    cameras.push_back({{"name", config.name},
                       {"model", config.distortion.model == Distortion::none
                                     ? "pinhole"
                                     : distortion_name(config.distortion.model)},
                       {"width_px", config.width_px},
                       {"height_px", config.height_px},
                       {"fx_px", camera.fx_px},
                       {"fy_px", camera.fy_px},
                       {"cx_px", camera.cx_px},
                       {"cy_px", camera.cy_px},
                       {"range_min_m", config.range_min_m},
                       {"range_max_m", config.range_max_m},
                       {"T_body_camera", T_body_camera}});
    const auto seen = std::ranges::find(frames.cameras, config.name, &FrameCamera::name);
    if (config.skew_px != 0.0) cameras.back()["skew_px"] = config.skew_px;
    const std::vector<double> coefficients = coefficients_of(config.distortion);
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
      const bool is_fisheye = coefficients.size() == 4;
      cameras.back()[is_fisheye ? fmt::format("k{}", i + 1) : kCoefficients[i].first] =
          coefficients[i];
    }
    if (seen != frames.cameras.end()) cameras.back()["depth_scale_m"] = seen->depth_scale_m;
  }
  return Json{{"cameras", cameras}}.dump(2) + "\n";
}

void write_cloud(const RunCloud& cloud, const std::vector<Rgb8>& colours, const fs::path& path) {
  std::vector<std::int32_t> views;
  views.reserve(cloud.points_world_m.size());
  for (std::size_t i = 0; i < cloud.points_world_m.size(); ++i) views.push_back(cloud.view_of(i));
  write_cloud_ply(cloud.points_world_m, path, {.colours = colours, .views = views});
}

/// The centres of the occupied voxels, cubes apart, and how many voxels are free. Throws BadInput
/// for more than a map of the run's workspace has.
void write_map(const fs::path& octomap, const RunRecord& record, const fs::path& folder) {
  const OccupancyConfig& config = record.scenario.planner.map;
  const std::size_t most =
      GridGeometry(record.scenario.workspace_m, config.resolution_m).voxel_count();
  const OctomapLeaves map = read_octomap(octomap);
  std::vector<Vec3f> occupied_m;
  std::size_t voxels = 0;
  for (const OctomapLeaf& leaf : map.leaves) {
    const auto edge = static_cast<std::size_t>(leaf.edge_voxels);
    voxels += edge * edge * edge;
    if (voxels > most) throw BadInput("{}: holds more voxels than the workspace", octomap.string());
    if (!is_occupied(leaf, config)) continue;
    for (std::size_t i = 0; i < edge * edge * edge; ++i) {
      const Vec3 key(leaf.first[0] + static_cast<double>(i % edge),
                     leaf.first[1] + static_cast<double>(i / edge % edge),
                     leaf.first[2] + static_cast<double>(i / edge / edge));
      occupied_m.push_back((map.voxel_m * (key + Vec3::Constant(0.5))).cast<float>());
    }
  }
  write_cloud_ply(occupied_m, folder / "voxels.ply");
  const Json json = {{"voxel_m", map.voxel_m},
                     {"occupied_voxels", occupied_m.size()},
                     {"free_voxels", voxels - occupied_m.size()}};
  write_file_atomically(folder / "map.json", json.dump(2) + "\n");
}

}  // namespace

void write_plain(const RunRecord& record, const ExportParts& parts, const fs::path& folder) {
  const FrameRecord frames = parts.frames.value_or(FrameRecord{});
  if (!record.path.empty())
    write_file_atomically(folder / "trajectory.csv", trajectory_text(record));
  if (!record.views.empty())
    write_file_atomically(folder / "views.csv", views_text(record, frames));
  write_file_atomically(folder / "intrinsics.json", intrinsics_text(record, frames));
  write_file_atomically(folder / kScenarioFile, to_yaml(record.scenario));
  write_file_atomically(folder / "README.txt", kPlainReadme);
  link_images(frames, folder);
  if (parts.cloud) write_cloud(*parts.cloud, parts.colours, folder / kCloudFile);
  if (const auto map = RunFiles(record.folder).find(kMapOddsFile)) write_map(*map, record, folder);
}

}  // namespace gnbv
