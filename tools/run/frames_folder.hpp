// The frames/ folder of a run: what the cameras saw at each view, and from where.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"
#include "sim/core/image.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// Writes ITERATION_CAMERA.rgb.png (sRGB) and ITERATION_CAMERA.depth.png (16 bits, millimetres
/// along the optical axis, 0 where there is none) of each view, cameras.json (intrinsics in pixels,
/// pixel centres at half pixels; skew and distortion where there are any) and poses.csv, which
/// grows with the views (T_world_camera as believed: metres, unit quaternion; optical frame, world
/// ENU). The others appear by rename.
class FramesFolder {
 public:
  /// Makes the folder of the run and writes cameras.json. Throws BadInput naming it when that
  /// fails.
  FramesFolder(const std::filesystem::path& run, std::vector<CameraModel> cameras);

  void write(std::size_t iteration, double time_s, std::span<const DepthFrame> depth,
             std::span<const ColourFrame> colour);

 private:
  std::filesystem::path folder_;
  std::vector<CameraModel> cameras_;
  GrowingFile poses_;
};

/// The names of a view's images in the folder, without `.rgb.png` and `.depth.png`.
std::string frame_stem(std::size_t iteration, const std::string& camera);

/// Pixel (0, 0) is top left, its centre at (0.5, 0.5).
struct FrameCamera {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  double depth_scale_m = 0.001;           // metres a step of the depth image
  std::shared_ptr<const Lens> lens = {};  // nothing: a pinhole, neither skewed nor distorted

  Distortion distortion() const { return lens ? lens->distortion().model : Distortion::none; }
  double skew_px() const { return lens ? lens->pinhole().skew_px : 0.0; }
  std::vector<double> coefficients() const {
    return lens ? coefficients_of(lens->distortion()) : std::vector<double>{};
  }
};

struct RecordedFrame {
  int iteration = 0;
  std::size_t camera = 0;                          // into FrameRecord::cameras
  double time_s = 0.0;                             // since the start of the mission
  Isometry T_world_camera = Isometry::Identity();  // optical frame: x right, y down, z forward
  std::filesystem::path colour = {};               // PNG, sRGB
  std::filesystem::path depth = {};  // PNG, 16 bits along the optical axis, 0 where there is none
};

struct FrameRecord {
  std::vector<FrameCamera> cameras;
  std::vector<RecordedFrame> frames;  // as they were taken: by iteration, then by camera
};

/// Whether it holds a frame, or is damaged.
bool has_frames(const std::filesystem::path& run);

/// Of a run without frames: with the command that flies it again and keeps them, where one does.
std::string why_no_frames(const RunRecord& record);

/// Throws BadInput naming file and line of whatever is damaged or missing, and the command that
/// flies the mission once more and keeps its frames.
FrameRecord read_frames(const std::filesystem::path& run);

/// The images of a frame. Throw BadInput naming one that is damaged or not of its camera's size.
Image read_colour(const FrameRecord& record, std::size_t frame);
GreyImage16 read_depth(const FrameRecord& record, std::size_t frame);

}  // namespace gnbv
