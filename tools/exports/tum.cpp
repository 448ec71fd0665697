#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/exports/export_folder.hpp"
#include "tools/exports/formats.hpp"
#include "tools/run/trajectory_tum.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTumReadme =
    R"(A gnbv run in the text formats of the TUM RGB-D benchmark.

trajectory.txt           true path of the body (x forward, y left, z up) in the world (ENU, metres)
                         at 10 Hz: time_s x y z qx qy qz qw, as `evo_traj tum` opens it
CAMERA/groundtruth.txt   true path of the camera (x right, y down, z forward), the same columns,
                         at 10 Hz and at every frame, of a camera on a gimbal at frames only; up to
                         0.1 s before the first sample of the path and after the last, where a view
                         may be, that sample holds
CAMERA/estimate.txt      where the vehicle believed the camera to be, at every frame;
                         `evo_ape tum groundtruth.txt estimate.txt` measures the difference
CAMERA/calibration.txt   fx fy cx cy width height in pixels, the centre of the first pixel at
                         (0.5, 0.5); a comment has skew and distortion where there are any
CAMERA/rgb.txt           time and name of every colour image
CAMERA/depth.txt         time and name of every depth image: 16 bits, {} steps a metre
                         (the benchmark's own have 5000), 0 where there is none or it is beyond {} m
CAMERA/associations.txt  both, matched: time rgb time depth

The folders of cameras are there for runs that were flown with --frames. Time is simulated and
begins with the mission.
)";

/// The camera's true poses: those of the path, and between them where frames were taken.
std::string groundtruth_text(const RunRecord& record, const Isometry& T_body_camera,
                             const std::vector<double>& frame_times_s) {
  std::string text = tum_text("optical frame in world ENU, true", {});
  const auto add = [&](double time_s, const std::optional<Isometry>& T_world_body) {
    if (T_world_body) text += tum_line(time_s, *T_world_body * T_body_camera);
  };
  auto frame = frame_times_s.begin();
  for (const TrajectorySample& sample : record.path) {
    for (; frame != frame_times_s.end() && *frame < sample.time_s; ++frame) {
      add(*frame, true_pose_at(record, *frame));
    }
    // a frame at the very time of a sample stands once
    if (frame != frame_times_s.end() && *frame == sample.time_s) ++frame;
    add(sample.time_s, sample.T_world_body);
  }
  // of the last view, after the last sample
  for (; frame != frame_times_s.end(); ++frame) add(*frame, true_pose_at(record, *frame));
  return text;
}

/// Of a camera on a gimbal: how it turned on the way stands in no file, so only where it looked.
std::string groundtruth_at_frames(const RunRecord& record, const CameraModel& camera,
                                  const FrameRecord& frames, std::size_t index) {
  std::string text = tum_text("optical frame in world ENU, true, where frames were taken", {});
  for (const RecordedFrame& frame : frames.frames) {
    const auto view = static_cast<std::size_t>(frame.iteration);
    const std::optional<Isometry> T_world_body = true_pose_at(record, frame.time_s);
    if (frame.camera != index || view >= record.views.size() || !T_world_body) continue;
    const double pitch_rad = record.views[view].decision.view.gimbal_pitch_rad;
    text += tum_line(frame.time_s, *T_world_body * turned(camera, pitch_rad).T_body_camera);
  }
  return text;
}

/// The camera as the scenario mounts it.
CameraModel camera_named(const RunRecord& record, std::string_view name) {
  const auto found = std::ranges::find(record.scenario.cameras, name, &CameraConfig::name);
  if (found != record.scenario.cameras.end()) return make_camera_model(*found);
  throw BadInput("{}: cameras.json names '{}', which scenario.yaml does not have",
                 (record.folder / kFramesFolder).string(), name);
}

/// The depth image with that many steps a metre; how many pixels are too far for it.
std::size_t write_depth(const FrameRecord& frames, std::size_t frame, double steps_per_m,
                        const fs::path& file) {
  const RecordedFrame& recorded = frames.frames[frame];
  const double factor = steps_per_m * frames.cameras[recorded.camera].depth_scale_m;
  if (std::abs(factor - 1.0) < 1e-9) {
    link_or_copy(recorded.depth, file);
    return 0;
  }
  std::size_t too_far = 0;
  GreyImage16 image = read_depth(frames, frame);
  for (std::uint16_t& value : image.values) {
    const double scaled = std::round(factor * value);
    too_far += scaled > 65535.0 ? 1 : 0;
    value = scaled > 65535.0 ? std::uint16_t{0} : static_cast<std::uint16_t>(scaled);
  }
  fs::create_directories(file.parent_path());
  write_png(image, file, Lasting::the_process);
  return too_far;
}

std::size_t write_camera(const RunRecord& record, const FrameRecord& frames, std::size_t camera,
                         double steps_per_m, const fs::path& folder) {
  std::size_t too_far = 0;
  std::string rgb = "# time_s file\n";
  std::string depth = rgb;
  std::string associations;
  std::string estimate = tum_text("optical frame in world ENU, believed", {});
  std::vector<double> times_s;
  for (std::size_t i = 0; i < frames.frames.size(); ++i) {
    const RecordedFrame& frame = frames.frames[i];
    if (frame.camera != camera) continue;
    const std::string name = fmt::format("{:.3f}.png", frame.time_s);
    rgb += fmt::format("{:.3f} rgb/{}\n", frame.time_s, name);
    depth += fmt::format("{:.3f} depth/{}\n", frame.time_s, name);
    associations +=
        fmt::format("{:.3f} rgb/{} {:.3f} depth/{}\n", frame.time_s, name, frame.time_s, name);
    estimate += tum_line(frame.time_s, frame.T_world_camera);
    times_s.push_back(frame.time_s);
    link_or_copy(frame.colour, folder / "rgb" / name);
    too_far += write_depth(frames, i, steps_per_m, folder / "depth" / name);
  }
  if (times_s.empty()) return 0;
  const FrameCamera& c = frames.cameras[camera];
  const CameraModel model = camera_named(record, c.name);
  std::string calibration = fmt::format("# fx fy cx cy width height\n{} {} {} {} {} {}\n", c.fx_px,
                                        c.fy_px, c.cx_px, c.cy_px, c.width_px, c.height_px);
  if (c.lens) {
    calibration += fmt::format("# skew {}; {}, coefficients in OpenCV's order: {}\n", c.skew_px(),
                               distortion_name(c.distortion()), fmt::join(c.coefficients(), " "));
  }
  write_file_atomically(folder / "calibration.txt", calibration);
  write_file_atomically(folder / "rgb.txt", rgb);
  write_file_atomically(folder / "depth.txt", depth);
  write_file_atomically(folder / "associations.txt", associations);
  write_file_atomically(folder / "estimate.txt", estimate);
  write_file_atomically(folder / "groundtruth.txt",
                        model.config.gimbal
                            ? groundtruth_at_frames(record, model, frames, camera)
                            : groundtruth_text(record, model.T_body_camera, times_s));
  return too_far;
}

}  // namespace

std::size_t write_tum(const RunRecord& record, const std::optional<FrameRecord>& frames,
                      double depth_steps_per_m, const fs::path& folder) {
  if (record.path.empty()) throw BadInput(record.missing.front());  // trajectory.tum
  write_file_atomically(folder / "trajectory.txt",
                        tum_text("body FLU in world ENU, true", record.path));
  std::size_t too_far = 0;
  for (std::size_t i = 0; frames && i < frames->cameras.size(); ++i) {
    too_far +=
        write_camera(record, *frames, i, depth_steps_per_m, folder / file_word(frames->cameras[i]));
  }
  write_file_atomically(folder / "README.txt",
                        fmt::format(fmt::runtime(kTumReadme), depth_steps_per_m,
                                    std::floor(65535.0 / depth_steps_per_m * 10.0) / 10.0));
  return too_far;
}

}  // namespace gnbv
