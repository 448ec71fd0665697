// What a recorded frame shows of a point: where it projects, and whether the depth image agrees;
// and the colours that the points of a run's cloud have by that.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "sim/core/image.hpp"
#include "tools/run/frames_folder.hpp"
#include "tools/run/run_record.hpp"

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

/// How far off the surface a point of the cloud may lie, as FrameSight::sees() wants it: points are
/// centroids of leaves.
double cloud_blur_m(const RunRecord& record);

/// Gathers the colours of some points, frame by frame. A point that a view brought has that of the
/// nearest frame of this view which shows it, a point of the profile, or from after the last view,
/// that of the nearest frame of all. Where cameras run in flight, whose frames are not kept, so has
/// a point that no frame of its view shows. A frame shows a point only if its depth agrees.
class CloudColours {
 public:
  /// `points`: indices into the cloud, ascending. Everything stays with the caller.
  CloudColours(const RunRecord& record, const RunCloud& cloud, const FrameRecord& frames,
               std::span<const std::size_t> points);

  /// Each frame once, from any thread.
  void look(std::size_t frame, const FrameSight& sight);

  /// A colour a point; `unseen` for one that no frame shows.
  std::vector<Rgb8> colours(const Rgb8& unseen) const;

 private:
  /// What a frame shows of a point. The least counts: those of the point's own view come first,
  /// then the nearest, then the first.
  struct Seen {
    std::size_t point = 0;  // into points_
    bool is_foreign = true;
    double z_m = 0.0;
    std::size_t frame = 0;
    Rgb8 rgb{};
  };
  static bool is_before(const Seen& a, const Seen& b);
  std::size_t view_of(std::size_t frame) const;

  const RunRecord& record_;
  const RunCloud& cloud_;
  const FrameRecord& frames_;
  std::span<const std::size_t> points_;
  double blur_m_ = 0.0;
  bool has_flight_frames_ = false;
  std::mutex mutex_;
  std::vector<Seen> best_;  // a point each
};

/// Of a point that no frame shows.
constexpr Rgb8 kNoColour = {128, 128, 128};

/// Of the whole cloud. No result depends on `threads`.
std::vector<Rgb8> colours_of_cloud(const RunRecord& record, const RunCloud& cloud,
                                   const FrameRecord& frames, int threads,
                                   const ShareDone& progress);

}  // namespace gnbv
