#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/exports/export_folder.hpp"
#include "tools/exports/formats.hpp"
#include "tools/run/cloud_file.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kNerfstudioReadme =
    R"(A gnbv run as a nerfstudio data set, for example: ns-train depth-nerfacto --data .

transforms.json  camera to world (x right, y up, z back), world ENU in metres as in the run;
                 applied_transform is therefore the identity; intrinsics of each frame, with
                 distortion as OpenCV has it
images/          colour, PNG
depth/           16-bit PNG, along the optical axis, times depth_unit_scale_factor metres; 0 where
                 there is none. nerfstudio takes the factor from its dataparser option
                 --depth-unit-scale-factor: give that one where it is not the default, 0.001
points.ply       coloured points of the run's cloud in the same world, to begin from

Poses are those that the vehicle believed; `gnbv export --format tum` has the true ones, too.
)";

Json matrix_rows(const Eigen::Matrix4d& matrix, int rows) {
  Json json = Json::array();
  for (int r = 0; r < rows; ++r) {
    json.push_back({matrix(r, 0), matrix(r, 1), matrix(r, 2), matrix(r, 3)});
  }
  return json;
}

/// The axes of OpenGL's cameras: y and z of the optical frame turned around.
Eigen::Matrix4d opengl_pose(const Isometry& T_world_camera) {
  return T_world_camera.matrix() * Eigen::Vector4d(1, -1, -1, 1).asDiagonal();
}

/// Said once for a run with one camera, else of each frame.
Json distortion_of(const FrameCamera& camera) {
  const DistortionConfig d = camera.lens ? camera.lens->distortion() : DistortionConfig{};
  return {{"k1", d.k1}, {"k2", d.k2}, {"k3", d.k3}, {"k4", d.k4}, {"p1", d.p1}, {"p2", d.p2}};
}

/// One for all cameras; throws BadInput where there is none.
const char* camera_model(const FrameRecord& frames) {
  const auto is_fisheye = [](const FrameCamera& c) {
    return c.distortion() == Distortion::kannala_brandt;
  };
  for (const FrameCamera& c : frames.cameras) {
    need_no_skew(c, "nerfstudio");
    const DistortionConfig d = c.lens ? c.lens->distortion() : DistortionConfig{};
    if (!is_fisheye(c) && (d.k4 != 0.0 || d.k5 != 0.0 || d.k6 != 0.0)) {
      throw BadInput(
          "camera '{}': nerfstudio has no rational distortion (k4 to k6); --format colmap has",
          c.name);
    }
    if (is_fisheye(c) != is_fisheye(frames.cameras.front())) {
      throw BadInput(
          "cameras '{}' and '{}': transforms.json has one model for all, and only one of them is a "
          "fisheye",
          frames.cameras.front().name, c.name);
    }
  }
  return is_fisheye(frames.cameras.front()) ? "OPENCV_FISHEYE" : "OPENCV";
}

double common_depth_scale_m(const FrameRecord& frames) {
  const double scale_m = frames.cameras.front().depth_scale_m;
  for (const FrameCamera& c : frames.cameras) {
    if (c.depth_scale_m == scale_m) continue;
    throw BadInput(
        "cameras.json: depth_scale_m of {} is {}, of {} {}: transforms.json has one for all",
        frames.cameras.front().name, scale_m, c.name, c.depth_scale_m);
  }
  return scale_m;
}

}  // namespace

void write_nerfstudio(const FrameRecord& frames, const SparseModel& model, const fs::path& folder) {
  Json json = {{"camera_model", camera_model(frames)}};
  if (frames.cameras.size() == 1) json.update(distortion_of(frames.cameras[0]));
  json["applied_transform"] = matrix_rows(Eigen::Matrix4d::Identity(), 3);
  json["depth_unit_scale_factor"] = common_depth_scale_m(frames);
  json["ply_file_path"] = "points.ply";
  json["frames"] = Json::array();
  for (const RecordedFrame& frame : frames.frames) {
    const FrameCamera& c = frames.cameras[frame.camera];
    const std::string name = image_name(frames, frame);
    json["frames"].push_back(
        {{"file_path", "images/" + name},
         {"depth_file_path", "depth/" + name},
         {"w", c.width_px},
         {"h", c.height_px},
         {"fl_x", c.fx_px},
         {"fl_y", c.fy_px},
         {"cx", c.cx_px},
         {"cy", c.cy_px},
         {"transform_matrix", matrix_rows(opengl_pose(frame.T_world_camera), 4)}});
    if (frames.cameras.size() > 1) json["frames"].back().update(distortion_of(c));
  }
  link_images(frames, folder);
  write_cloud_ply(model.points_world_m, folder / "points.ply", {.colours = model.colours});
  write_file_atomically(folder / "transforms.json", json.dump(1) + "\n");
  write_file_atomically(folder / "README.txt", kNerfstudioReadme);
}

}  // namespace gnbv
