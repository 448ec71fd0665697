// A run as other programs read it, a function a format. Poses of images are those the vehicle
// believed; the world is the run's own, ENU in metres.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"
#include "tools/frames/frame_sight.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

// ---- sparse_model.cpp: the cloud as structure from motion would leave it: points with colours,
// and the frames that show each of them

struct Observation {
  std::uint32_t point = 0;  // into SparseModel::points_world_m
  double u_px = 0.0;        // the centre of the first pixel is at (0.5, 0.5)
  double v_px = 0.0;
};

struct SparseModel {
  std::vector<Vec3f> points_world_m;
  std::vector<Rgb8> colours;                           // of the nearest frame that shows the point
  std::vector<std::vector<Observation>> observations;  // by frame, points ascending

  std::size_t observation_count() const;
};

struct SparseModelOptions {
  std::size_t max_points = 100'000;
  double blur_m = 0.0;  // how far from the surface a point may lie: half a leaf of the cloud
  int threads = 1;      // no result depends on it
  ShareDone progress = [](double) {};
};

/// Every n-th point, n the least that keeps to max_points, as far as two frames show it.
SparseModel make_sparse_model(std::span<const Vec3f> points_world_m, const FrameRecord& frames,
                              const SparseModelOptions& options);

// ---- the formats

/// What a run holds beside its record; each may be missing.
struct ExportParts {
  std::optional<FrameRecord> frames = {};
  std::optional<RunCloud> cloud = {};
  std::vector<Rgb8> colours = {};  // of the cloud's points; empty without frames
  std::optional<TriangleMesh> structure = {};
};

/// A COLMAP model with known poses (https://colmap.github.io/format.html):
/// sparse/0/{cameras,images,points3D}.txt, images/CAMERA_NUMBER.png and README.txt. Poses are from
/// world to camera (x right, y down, z forward); pixels are COLMAP's as they are ours, the centre
/// of the first one at (0.5, 0.5). Observations are projections, not detected features, so that
/// reprojection errors are 0.
void write_colmap(const FrameRecord& frames, const SparseModel& model,
                  const std::filesystem::path& folder);

/// A nerfstudio data set (https://docs.nerf.studio/quickstart/data_conventions.html):
/// transforms.json, images/NUMBER_CAMERA.png, depth/NUMBER_CAMERA.png, points.ply and README.txt.
/// Poses are from camera to world, the camera's x right, y up, z back. Intrinsics stand with each
/// frame, since cameras may differ. Throws BadInput for cameras whose depth images differ in scale:
/// the format knows one.
void write_nerfstudio(const FrameRecord& frames, const SparseModel& model,
                      const std::filesystem::path& folder);

/// CSV, JSON, PLY and PNG for whoever has none of our code: what there is of trajectory.csv,
/// views.csv, intrinsics.json, cloud.ply, voxels.ply (the map's occupied voxels), images/ and
/// depth/, and a README.txt that documents every file, frame and unit.
void write_plain(const RunRecord& record, const ExportParts& parts,
                 const std::filesystem::path& folder);

/// The text formats of the TUM RGB-D benchmark
/// (https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats): trajectory.txt, the true path
/// of the body as `evo_traj tum` opens it, README.txt, and for each camera that took frames CAMERA/
/// with rgb/, depth/, calibration.txt, rgb.txt, depth.txt, associations.txt, groundtruth.txt (true
/// poses of the camera) and estimate.txt (the poses the vehicle believed). Throws BadInput for a
/// run without trajectory.tum and for cameras that the scenario does not know. Depth has so many
/// steps a metre; what is too far for 16 bits is 0, "none". Returns how many pixels were.
std::size_t write_tum(const RunRecord& record, const std::optional<FrameRecord>& frames,
                      double depth_steps_per_m, const std::filesystem::path& folder);
/// Of the benchmark's own images, which its readers divide by.
constexpr double kTumDepthStepsPerM = 5000.0;

/// For viewers with a timeline, by Python: run.rrd (format "rerun") or run.mcap with Foxglove's
/// schemas ("mcap"), written in `python3`, or what GNBV_PYTHON names: structure, cloud as it grew,
/// path, cameras at the views with what they saw (without frames where they truly were, blind),
/// plots. Returns what was written, in words. Throws BadInput with the one line that installs what
/// is missing there, or with what went wrong.
std::string write_timeline(const RunRecord& record, const ExportParts& parts,
                           std::string_view format, const std::filesystem::path& folder);

}  // namespace gnbv
