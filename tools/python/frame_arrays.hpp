// What cameras saw, and the map from above, as Python gets them.
#pragma once

#include "sensors/camera_model.hpp"
#include "tools/mission/mission.hpp"
#include "tools/python/arrays.hpp"

namespace gnbv {

/// A SensedView that lasts.
struct KeptView {
  explicit KeptView(const SensedView& view)
      : iteration(view.iteration),
        time_s(view.time_s),
        depth(view.depth.begin(), view.depth.end()),
        colour(view.colour.begin(), view.colour.end()) {}

  std::size_t iteration;
  double time_s;
  std::vector<DepthFrame> depth;
  std::vector<ColourFrame> colour;
};

/// The fields of gnbv.Frame, a tuple a camera that saw.
nb::list frames_of(const KeptView& view, std::span<const CameraModel> cameras);

/// top_view() of the map into a dictionary, and the corners of what it shows.
void put_top(const GridGeometry& grid, std::vector<float> top, nb::dict& out);

/// run.frames.
void bind_frames(nb::module_& m);

}  // namespace gnbv
