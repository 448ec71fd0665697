// The mission as someone beside it would see it, view after view.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "tools/render/picture.hpp"

namespace gnbv {

/// Views 0, n, 2 n, ... and the last one. `every` 0 takes as many as come nearest to `about`.
std::vector<std::size_t> snapshot_iterations(std::size_t views, int every, std::size_t about);

/// Times since the mission began at which a film of so many images shows it: even steps from its
/// first view, or its take-off where no profile comes before, to its end.
std::vector<double> film_times_s(const RunRecord& record, std::size_t images);

/// Draws one run: its structure as a ghost, and what was flown and seen up to a time, beside what
/// the first camera saw last.
class Snapshots {
 public:
  /// The fixed camera of the options, or one behind and above the vehicle when `follows`. Throws
  /// BadInput for a run without views or cloud.
  Snapshots(RunSource& run, const PictureOptions& options, const RenderView& fixed, bool follows);

  /// At the moment of a view.
  Picture picture(std::size_t iteration, const RenderView& view) {
    return picture_at(run_.record().views[iteration].time_s, 0.0, view);
  }
  RenderView view(std::size_t iteration) const;

  /// At any time of the flight. `speed`: how many times faster than it was flown the film
  /// runs; 0 says nothing.
  Picture picture_at(double time_s, double speed, const RenderView& view);
  RenderView view_at(double time_s) const;

 private:
  std::size_t iteration_at(double time_s) const;  // of the last view no later
  Isometry T_world_body(double time_s) const;
  const Image& seen_by_camera(std::size_t iteration);

  RunSource& run_;
  PictureOptions options_;
  RenderView fixed_;
  bool follows_;
  DotsItem cloud_;                                        // at most a dot a pixel or so
  std::vector<std::size_t> points_;                       // of the whole cloud: which the dots are
  std::optional<std::pair<std::size_t, Image>> onboard_;  // the camera's last image, by iteration
};

/// How snapshots are framed: by structure and planned flight.
extern const PictureKind kSnapshotFraming;

}  // namespace gnbv
