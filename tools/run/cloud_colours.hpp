// The colours of a run's cloud, from the frames that brought its points.
#pragma once

#include <mutex>
#include <span>
#include <vector>

#include "tools/run/frame_sight.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

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
