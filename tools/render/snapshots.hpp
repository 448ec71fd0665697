// The mission as someone beside it would see it, view after view.
#pragma once

#include <vector>

#include "tools/render/picture.hpp"

namespace gnbv {

/// Views 0, n, 2 n, ... and the last one. `every` 0 takes as many as come nearest to `about`.
std::vector<std::size_t> snapshot_iterations(std::size_t views, int every, std::size_t about);

/// Draws one run: its structure as a ghost, and what was flown and seen up to a view.
class Snapshots {
 public:
  /// The fixed camera of the options, or one behind and above the vehicle when `follows`. Throws
  /// BadInput for a run without views or cloud.
  Snapshots(RunSource& run, const PictureOptions& options, const RenderView& fixed, bool follows);

  Picture picture(std::size_t iteration, const RenderView& view) const;
  RenderView view(std::size_t iteration) const;

 private:
  Isometry T_world_body(std::size_t iteration) const;

  RunSource& run_;
  PictureOptions options_;
  RenderView fixed_;
  bool follows_;
  DotsItem cloud_;                   // at most a dot a pixel or so
  std::vector<std::size_t> points_;  // of the whole cloud: which the dots are
};

/// How snapshots are framed: by structure and planned flight.
extern const PictureKind kSnapshotFraming;

}  // namespace gnbv
