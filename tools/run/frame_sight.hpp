// What a recorded frame shows of a point: where it projects, and whether the depth image agrees.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "sim/core/image.hpp"
#include "tools/run/frames_folder.hpp"

namespace gnbv {

/// Where a frame shows a point.
struct Sighting {
  double u_px = 0.0;  // the centre of the first pixel is at (0.5, 0.5)
  double v_px = 0.0;
  double z_m = 0.0;  // along the optical axis
};

/// A frame with its images.
class FrameSight {
 public:
  /// Reads both images. Throws BadInput naming the one that is damaged or not of the camera's size.
  FrameSight(const FrameRecord& record, std::size_t frame);

  /// Nothing when the point projects beside the image or the pixel it falls into does not show it:
  /// its depth differs by more than a surface at 80 degrees to the line of sight can have within
  /// half a pixel, `blur_m` and the image's own rounding.
  std::optional<Sighting> sees(const Vec3& p_world_m, double blur_m) const;

  const Image& colour() const { return colour_; }
  const GreyImage16& depth() const { return depth_; }  // in FrameCamera::depth_scale_m
  Rgb8 colour_at(const Sighting& sighting) const;

 private:
  FrameCamera camera_;
  Isometry T_camera_world_;
  Image colour_;
  GreyImage16 depth_;
};

/// Called from time to time with the share done, in [0, 1].
using ShareDone = std::function<void(double)>;

/// Calls `look` once for each frame with its images, on up to `threads` threads: a call writes only
/// what its own frame owns. `progress` is called from this thread alone.
void for_each_frame(const FrameRecord& record, int threads, const ShareDone& progress,
                    const std::function<void(std::size_t frame, const FrameSight& sight)>& look);

}  // namespace gnbv
